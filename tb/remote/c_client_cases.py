# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The C client of remote nodes through `verican bridge --socketcand` (RN-93). Run by ctest with
VERICAN_BINARY=build/release/verican and VERICAN_GOLDEN_CLIENT, the program of
guest/golden_client.cpp.
"""
import os
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tb/socketcan"), str(ROOT / "tb/socketcan/uml")]

# ruff: noqa: E402  (the path must be set first)
import remote as vectors
from socketcand_bridge import PATIENCE, Bridge


class CClient(unittest.TestCase):
    """The golden vectors on the RTL."""

    def test_vectors_through_socketcand(self):
        """Each life of each profile on a bus of its own."""
        for profile in vectors.FEATURES:
            for i, life in enumerate(vectors.LIVES):
                with self.subTest(profile=profile, life=i):
                    self.run_life(profile, i, life)

    def run_life(self, profile, i, life):
        """The client is content, and its frames are on the bus in their order."""
        environment = dict(os.environ, VERICAN_VECTORS=str(vectors.VECTORS), VERICAN_LIFE=str(i),
                           VERICAN_PROFILE=profile)
        with Bridge("--fast", "--errors", "none", scenario=vectors.scenario(profile, life),
                    clients=2) as bridge:
            done = subprocess.run(
                [os.environ["VERICAN_GOLDEN_CLIENT"]], stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, check=False,
                env=environment | {"VERICAN_SOCKETCAND": str(bridge.port)})
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn(vectors.CONTENT["c"], done.stdout)
            bridge.stop()
            log = pathlib.Path(bridge.log).read_text(encoding="ascii")
        self.assertIsNone(vectors.missing_frame(log, life, profile))


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What keeps the cluster of private_slurm.py from starting: only a missing program is a reason to
skip a test."""
import tempfile
import unittest
from pathlib import Path

from private_slurm import Failed, Impossible, PrivateSlurm


class ClusterSetUp(unittest.TestCase):
    """With a munged of this test's, in place of the real programs."""

    def start(self, munged, **options):
        """Sets a cluster up whose only program is a munged of these lines, if there are any."""
        with tempfile.TemporaryDirectory(prefix="verican-munged-") as folder:
            if munged:
                program = Path(folder) / "munged"
                program.write_text(f"#!/bin/sh\n{munged}\n", encoding="utf-8")
                program.chmod(0o755)
            cluster = PrivateSlurm(cpus=1, **options)
            cluster.environment["PATH"] = folder
            with cluster:
                self.fail("a cluster without Slurm")

    def test_a_program_that_is_not_installed(self):
        with self.assertRaisesRegex(Impossible, "munged is not installed"):
            self.start(None)

    def test_a_daemon_that_ends(self):
        with self.assertRaisesRegex(Failed, "ended: munged; munged.log: no key"):
            self.start("echo no key; exit 1")

    def test_a_daemon_that_does_not_answer(self):
        with self.assertRaisesRegex(Failed, "munged: not in time"):
            self.start("exec /bin/sleep 60", patience=0.5)

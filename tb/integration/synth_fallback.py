#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""tools/synth.sh measures a block at which abc9 stops with plain abc, and says so."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

import design

# Yosys, but for what a netlist that abc9 cannot order makes of it.
STOPPING = """#!/bin/sh
case "$*" in
  *"synth_ice40 -abc9"*"{top}"*)
    echo "ERROR: ABC: execution of command failed: return code 134." >&2
    exit 1 ;;
esac
exec {yosys} "$@"
"""


class SynthFallback(unittest.TestCase):
    """A small block with Yosys as it is and with one whose abc9 stops."""

    def synth(self, stops_at):
        """What is said, and the page; `stops_at`: the top at which abc9 stops."""
        with tempfile.TemporaryDirectory() as name:
            fake = Path(name) / "yosys"
            fake.write_text(STOPPING.format(yosys=shutil.which("yosys"), top=stops_at))
            fake.chmod(0o755)
            page = Path(name) / "page.md"
            environment = os.environ | {
                "PATH": f"{name}:{os.environ['PATH']}", "BLOCKS": "can_fault", "SEEDS": "1",
                "OUT": f"{name}/out", "PAGE": str(page)}
            code, said = design.run("tools/synth.sh", env=environment)
            self.assertEqual(code, 0, said)
            return said, page.read_text(encoding="utf-8")

    def test_where_abc9_stops_plain_abc_is_taken(self):
        """That between shift registers, for the clock rate; of the bare block nothing is said."""
        said, page = self.synth("-top area_wrap")
        self.assertRegex(said, r"abc9 stops at \S+/can_fault/ice40_wrapped; plain abc instead: "
                               "ERROR: ABC: execution of command failed")
        self.assertEqual(said.count("abc9"), 1, said)
        self.assertIn("abc9 stopped at the protocol engine `can_fault`: Fmax with plain abc.", page)


if __name__ == "__main__":
    unittest.main()

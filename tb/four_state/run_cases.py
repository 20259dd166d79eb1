# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""run.py with a recorder that records too little."""
import argparse
import tempfile
import unittest
from pathlib import Path

import run
from devices import DEVICES, LEAST_CLOCKS


class ShortRecordings(unittest.TestCase):
    """The bench is none: nothing comes so far as to be played."""

    def replay(self, rows):
        """Plays a recording of so many rows."""
        with tempfile.TemporaryDirectory(prefix="verican-replay-") as folder:
            device = DEVICES["ahb"]
            program = Path(folder) / "tb/four_state" / device.recorder
            program.parent.mkdir(parents=True)
            program.write_text(f'#!/bin/sh\nyes row | head -n {rows} >"$3"\n', encoding="utf-8")
            program.chmod(0o755)
            args = argparse.Namespace(build=folder, device=device, clocks=400_000, most=0)
            return run.replay(args, "registers", 16, f"{folder}/no_bench.vvp", folder)

    def test_an_empty_recording_is_no_success(self):
        with self.assertRaisesRegex(run.ReplayError, "registers: 0 clocks recorded"):
            self.replay(0)

    def test_a_recording_that_ends_early_is_no_success(self):
        least = LEAST_CLOCKS["registers"]
        with self.assertRaisesRegex(run.ReplayError, f"not {least} or more"):
            self.replay(least - 1)
        with self.assertRaisesRegex(run.ReplayError, "vvp failed"):
            self.replay(least)

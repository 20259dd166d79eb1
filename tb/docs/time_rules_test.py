#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""tools/time_rules.py: a test or proof that a rule names and that is none is found."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
sys.dont_write_bytecode = True
# ruff: noqa: E402  (the path must be set first)
import time_rules


class Names(unittest.TestCase):
    """Lines of rules beside two tests and a proof."""

    def unknown(self, shown_by):
        """What is said of a rule with these words behind *Test:*."""
        line = f'- <a id="tm-99"></a>**[TM-99](x)** MCR.FEN is 1. *Test:* {shown_by}'
        return list(time_rules.unknown_names(line, {"Bus.Idle", "Bus.Off", "Bus.*"}, {"clock"}))

    def test_those_that_exist(self):
        self.assertEqual(self.unknown("Bus.Idle, .Off: 3 x 5 frames; proof `time.clock`."), [])
        self.assertEqual(self.unknown("Bus.*; `make synth`."), [])

    def test_those_that_do_not(self):
        self.assertEqual(self.unknown("Bus.Idle, .On; Car.Off, Car.*."),
                         [f"TM-99: no test {name}" for name in ("Bus.On", "Car.Off", "Car.*")])
        self.assertEqual(self.unknown("proof `time.space`."), ["TM-99: no proof time.space"])

    def test_there_are_some(self):
        self.assertGreater(len(time_rules.tests()), 1000)
        self.assertIn("stamp", time_rules.proofs())


if __name__ == "__main__":
    unittest.main()

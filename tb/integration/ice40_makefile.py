#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""constraints/ice40/can.mk, as its head says to run it, makes a bitstream in time for 12 MHz."""

import re
import tempfile
import unittest
from pathlib import Path

import design


class Ice40Makefile(unittest.TestCase):
    """Its default build but for the number of buffers, in a folder of its own."""

    def test_makes_a_bitstream(self):
        with tempfile.TemporaryDirectory() as name:
            code, text = design.run("make", "-s", "-f", "constraints/ice40/can.mk", f"OUT={name}",
                                    "NUMMB=16")
            self.assertEqual(code, 0, text)
            image = (Path(name) / "can_ahb_16.bin").read_bytes()
            self.assertIn(bytes.fromhex("7EAA997E"), image[:300], "the preamble of iCE40 images")
            log = (Path(name) / "can_ahb_16.log").read_text(encoding="utf-8")
            rates = re.findall(r"Max frequency for clock .*: ([\d.]+) MHz", log)
            self.assertTrue(rates, log[-2000:])
            self.assertGreater(float(rates[-1]), 12.0)

    def test_another_number_of_buffers_is_another_build(self):
        """Nothing that is there already is taken for it."""
        with tempfile.TemporaryDirectory() as name:
            asked = ("make", "-f", "constraints/ice40/can.mk", f"OUT={name}")
            targets = {}
            for size in (16, 64):
                code, text = design.run(*asked, f"NUMMB={size}", "-n")
                self.assertEqual(code, 0, text)
                self.assertIn(f"-chparam NumMb {size};", text)
                targets[size] = set(re.findall(r"\S+\.(?:json|asc|bin)\b", text))
                self.assertEqual(len(targets[size]), 3, text)
            self.assertEqual(targets[16] & targets[64], set())


if __name__ == "__main__":
    unittest.main()

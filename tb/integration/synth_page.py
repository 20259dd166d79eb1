#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The table of buses that make synth writes (tools/synth/report.py): limits of PK-11."""

import sys
import unittest

import design

sys.path.insert(0, str(design.ROOT / "tools/synth"))
import report  # pylint: disable=wrong-import-position


def table(**blocks):
    """Rows of the table for blocks with (VersaTiles, MHz)."""
    rows = report.buses({name: {"tiles": tiles, "fmax": fmax, "alone": tiles % 100}
                         for name, (tiles, fmax) in blocks.items()})
    return [row for row in rows if row.startswith("| ") and not row.startswith("| bus")]


class SynthPage(unittest.TestCase):
    """Limits of PK-11: tiles over can_ahb, and 3 % of its clock rate."""

    def test_at_the_limits_nothing_is_missed(self):
        rows = table(can_ahb_32=(4000, 100.0), can_apb_32=(4040, 97.1), can_axil_32=(4130, 97.1),
                     can_wb_32=(4040, 97.1), can_wb_pipelined_32=(4090, 97.1))
        self.assertEqual(len(rows), 4)
        self.assertNotIn("missed", "".join(rows))
        self.assertIn("| +40 | +40 (40) | -2.9 % (-3 %)", rows[0])

    def test_beyond_them_it_is_said_which(self):
        rows = table(can_ahb_32=(4000, 100.0), can_apb_32=(4041, 110.0), can_axil_32=(4131, 97.1),
                     can_wb_32=(4041, 97.1), can_wb_pipelined_32=(4091, 97.1))
        self.assertEqual(["missed" in row for row in rows], [True] * 4)
        self.assertIn("| APB | 32 | +41 | +41 (40, missed) | +10.0 % (-3 %) |", rows[0])
        slow = table(can_ahb_32=(4000, 100.0), can_wb_32=(3990, 96.9))
        self.assertEqual(slow, ["| Wishbone classic | 32 | +90 | -10 (40) "
                                "| -3.1 % (-3 %, missed) |"])

    def test_builds_are_compared_with_their_own_size(self):
        self.assertEqual(table(can_ahb_64=(4000, 100.0), can_apb_32=(9000, 1.0)), [])


if __name__ == "__main__":
    unittest.main()

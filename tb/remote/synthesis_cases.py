# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""docs/synthesis.md, which `make synth` writes, has the node without a processor (RN-85). Run by
ctest: python3 -m unittest synthesis_cases.Page.test_profiles
"""
import pathlib
import unittest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/synthesis.md"


class Page(unittest.TestCase):
    """RN-85: its profiles stand beside the engine, with the same figures."""

    def test_profiles(self):
        """Cells, RAM blocks, clock rate and tiles of each profile that is RTL."""
        lines = PAGE.read_text(encoding="utf-8").splitlines()
        columns = next(line for line in lines if "LUT4" in line).count("|")
        for profile in "small", "standard":
            rows = [line for line in lines if f"`can_remote`, profile {profile} |" in line]
            self.assertEqual(len(rows), 1, profile)
            self.assertEqual(rows[0].count("|"), columns)
            cells, *_, clock, tiles, _, _ = [cell.strip() for cell in rows[0].split("|")[2:-1]]
            self.assertRegex(cells, r"^\d+$")
            self.assertRegex(clock, r"^[\d.]+ MHz")
            self.assertRegex(tiles, r"^\d+ \(\d+ \+ \d+\)$")
        self.assertTrue(any("protocol engine `can_core`" in line for line in lines))

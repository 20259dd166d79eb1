# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What `make synth` writes into docs/synthesis.md has the node without a processor (RN-85). Run by
ctest: python3 -m unittest synthesis_cases.Page.test_profiles
"""
import pathlib
import subprocess
import sys
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/synth"))
import report  # pylint: disable=wrong-import-position

PROFILES = "small", "standard", "full"


def figures(directory):
    """In place of what Yosys and nextpnr say of a block: figures that tell which block it is."""
    seed = len(directory.name)
    return {"lut4": 100 + seed, "ff": 200 + seed, "carry": seed, "bram": 8, "fmax": 70.0 + seed,
            "fmax_all": [70.0 + seed], "tiles": 500 + 2 * seed, "lut3": 300 + seed,
            "tile_ff": 200 + seed, "blocks": 8, "plain": []}


def row_of(page, block):
    """The cells of the row of a block, without its title."""
    rows = [line for line in page.splitlines() if line.startswith(f"| {block} |")]
    if len(rows) != 1:
        raise AssertionError(f"{len(rows)} rows of {block}")
    return [cell.strip() for cell in rows[0].split("|")[2:-1]]


class Page(unittest.TestCase):
    """RN-85: its profiles stand beside the engine, with the same figures."""

    def test_profiles(self):
        """The page of given figures has those of each profile in its row."""
        blocks = ["can_core", *(f"remote_{profile}" for profile in PROFILES)]
        with (mock.patch.object(report, "measurement", figures),
              mock.patch.object(report, "by_module", lambda path: []),
              mock.patch.object(report, "version", lambda command: "any")):
            page = report.page(pathlib.Path("out"), blocks)
        titles = ["protocol engine `can_core`",
                  *(f"node without a processor `can_remote`, profile {p}" for p in PROFILES)]
        for block, title in zip(blocks, titles, strict=True):
            n = len(block)
            self.assertEqual(row_of(page, title), [
                f"{100 + n}", f"{200 + n}", f"{n}", "8", f"{70 + n}.0 MHz ({70 + n}.0)",
                f"{500 + 2 * n} ({300 + n} + {200 + n})", f"{(500 + 2 * n) / 115.2:.1f} %",
                "8 of 24"])

    def test_profiles_are_measured(self):
        """make synth takes them from the list that the simulator builds."""
        text = (ROOT / "tools/synth.sh").read_text(encoding="utf-8")
        function = text[text.index("profiles() {"):]
        listed = subprocess.run(
            ["bash", "-c", function[:function.index("\n}\n") + 3] + "profiles"], cwd=ROOT,
            check=True, capture_output=True, text=True).stdout
        self.assertEqual({line.split()[0] for line in listed.splitlines()}, set(PROFILES))

    def test_committed_page(self):
        """It has cells, RAM blocks, clock rate and tiles of each profile."""
        page = (ROOT / "docs/synthesis.md").read_text(encoding="utf-8")
        for profile in PROFILES:
            cells, *_, clock, tiles, _, _ = row_of(
                page, f"node without a processor `can_remote`, profile {profile}")
            self.assertRegex(cells, r"^\d+$")
            self.assertRegex(clock, r"^[\d.]+ MHz")
            self.assertRegex(tiles, r"^\d+ \(\d+ \+ \d+\)$")
        row_of(page, "protocol engine `can_core`")

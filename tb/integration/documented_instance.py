#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The instance of can_ahb that the pages print, copied into a user's top, has no warning."""

import re
import tempfile
import unittest
from pathlib import Path

import design

PAGES = ("README.md", "docs/integration.md")
BLOCK = re.compile(r"^```systemverilog\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def instance_on(page):
    """The block of the page that holds an instance of can_ahb."""
    text = (design.ROOT / page).read_text(encoding="utf-8")
    blocks = [block for block in BLOCK.findall(text) if "can_ahb" in block]
    if len(blocks) != 1:
        raise AssertionError(f"{page}: {len(blocks)} blocks with an instance of can_ahb, not one")
    return blocks[0]


class DocumentedInstance(unittest.TestCase):
    """Each page, in a folder of its own."""

    def check(self, *command):
        for page in PAGES:
            with self.subTest(page=page), tempfile.TemporaryDirectory() as name:
                block = instance_on(page)
                declared = "logic [31:0] can_rdata;" in block
                top = Path(name) / "user_top.sv"
                top.write_text(design.user_top(block, "" if declared else design.DECLARATIONS),
                               encoding="utf-8")
                code, text = design.run(*command, *design.rtl_files(), top)
                self.assertEqual((code, text), (0, ""))

    def test_verilator_has_no_warning(self):
        """All warnings on, no waiver but the core's own."""
        self.check("verilator", "--lint-only", "-Wall", "--top-module", "user_top", "rtl/lint.vlt")

    def test_yosys_reads_it(self):
        """And finds every port."""
        self.check("yosys", "-q", "-f", "verilog -sv", "-p", "hierarchy -check -top user_top")


if __name__ == "__main__":
    unittest.main()

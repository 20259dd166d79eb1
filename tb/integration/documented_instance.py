#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The instances that the pages print, copied into a user's top, have no warning."""

import re
import tempfile
import unittest
from pathlib import Path

import design
import wrappers

PAGES = ("README.md", "docs/integration.md")
BLOCK = re.compile(r"^```systemverilog\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def instance_on(page, module="can_ahb"):
    """The block of the page that holds an instance of the module."""
    text = (design.ROOT / page).read_text(encoding="utf-8")
    blocks = [block for block in BLOCK.findall(text) if module in block]
    if len(blocks) != 1:
        raise AssertionError(f"{page}: {len(blocks)} blocks with an instance of {module}, not one")
    return blocks[0]


def top_around(module, block):
    """A user's top whose ports are those of the bus, by the names that the block gives them."""
    names = dict(re.findall(r"\.(\w+)\((\w+)\)", block))
    ports = [f"{direction} logic {width} {names.get(name, name)}"
             for direction, width, name in wrappers.bus_ports(module)]
    ports += ["output logic can_irq", "input logic can_rxd", "output logic can_txd"]
    return f"module user_top (\n  {f',{chr(10)}  '.join(ports)}\n);\n{block}endmodule\n"


# A user's top around the node without a processor of docs/remote.md.
REMOTE_TOP = """module user_top (
  input  logic clk_i, input logic rst_ni, input logic usr_req, input logic usr_we,
  input  logic [3:0] usr_be, input logic [9:0] usr_addr, input logic [31:0] usr_wdata,
  output logic usr_ready, output logic [31:0] usr_rdata, output logic apply, output logic safe,
  input  logic can_rxd, output logic can_txd
);
"""

# And around the clock without a processor of docs/time.md.
CLOCK_TOP = """module user_top (
  input  logic clk_i, input logic rst_ni, output logic pps, output logic [1:0] time_state,
  output logic [31:0] time_offset, input logic can_rxd, output logic can_txd
);
"""


class DocumentedInstance(unittest.TestCase):
    """Each page, in a folder of its own."""

    def check(self, *command):
        for page in PAGES:
            with self.subTest(page=page):
                block = instance_on(page)
                declared = "logic [31:0] can_rdata;" in block
                self.check_top(command, design.user_top(block, "" if declared
                                                        else design.DECLARATIONS))
        for module in set(wrappers.BUSES) - {"can_ahb"}:
            with self.subTest(module=module):
                self.check_top(command, top_around(module, instance_on(PAGES[1], module + " ")))
        node = instance_on("docs/remote.md", "can_remote ")
        self.check_top(command, f"{REMOTE_TOP}{node}endmodule\n")
        clock = instance_on("docs/time.md", "can_time_node ")
        self.check_top(command, f"{CLOCK_TOP}{clock}endmodule\n")

    def check_top(self, command, text):
        with tempfile.TemporaryDirectory() as name:
            top = Path(name) / "user_top.sv"
            top.write_text(text, encoding="utf-8")
            self.assertEqual(design.run(*command, *design.rtl_files(), top), (0, ""))

    def test_verilator_has_no_warning(self):
        """All warnings on, no waiver but the core's own."""
        self.check("verilator", "--lint-only", "-Wall", "--top-module", "user_top", "rtl/lint.vlt")

    def test_yosys_reads_it(self):
        """And finds every port."""
        self.check("yosys", "-q", "-f", "verilog -sv", "-p", "hierarchy -check -top user_top")


if __name__ == "__main__":
    unittest.main()

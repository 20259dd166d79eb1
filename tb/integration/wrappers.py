#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The bus wrappers differ by their bus alone: same parameters, and same ports behind those of the
bus, in the same order, around an instance of can_top and nothing else (PK-10)."""

import re
import unittest

import design

PARAMETER = re.compile(r"^\s*parameter\s+(.*?)(\w+)\s*=\s*([^,\n]+?),?\s*$", re.MULTILINE)
PORT = re.compile(r"^\s*(input|output)\s+logic\s*(\[.*?\])?\s*(\w+),?\s*(?://.*)?$", re.MULTILINE)
INSTANCE = re.compile(r"^\s*(\w+)\s+(?:#\(|(?:u_)\w+\s*\()", re.MULTILINE)
# The ports of each bus, in order: inputs, behind ">" outputs, behind "<" inputs again. There
# are no others (PK-26).
BUSES = {
    "can_ahb": """hclk hresetn hsel haddr[31:0] htrans[1:0] hwrite hsize[2:0] hburst[2:0] hprot[3:0]
                  hready hwdata[31:0] > hrdata[31:0] hreadyout hresp""",
    "can_apb": """pclk presetn psel penable paddr[31:0] pprot[2:0] pwrite pstrb[3:0] pwdata[31:0]
                  > pready prdata[31:0] pslverr""",
    "can_axil": """aclk aresetn awaddr[31:0] awprot[2:0] awvalid > awready
                   < wdata[31:0] wstrb[3:0] wvalid > wready bresp[1:0] bvalid < bready
                   araddr[31:0] arprot[2:0] arvalid > arready rdata[31:0] rresp[1:0] rvalid
                   < rready""",
    "can_wb": """wb_clk_i wb_rst_i wb_cyc_i wb_stb_i wb_we_i wb_adr_i[31:2] wb_sel_i[3:0]
                 wb_dat_i[31:0] > wb_dat_o[31:0] wb_ack_o wb_err_o wb_stall_o"""}
# Which parameter is the bus's own.
OWN = {"can_ahb": "CheckHprot", "can_apb": "CheckProt", "can_axil": "CheckProt",
       "can_wb": "Pipelined"}
FIRST_COMMON = "irq_o"
# Outputs of a bus that depend on inputs of the same clock, and on which (PK-18); data of APB, AHB
# and Wishbone may, but need not.
AT_ONCE = {"can_ahb": {}, "can_apb": {"pslverr": {"psel", "penable"}}, "can_axil": {},
           "can_wb": {"wb_ack_o": {"wb_cyc_i", "wb_stb_i"}, "wb_err_o": {"wb_cyc_i", "wb_stb_i"},
                      "wb_stall_o": {"wb_cyc_i", "wb_stb_i"}}}


def source(name):
    """The text of a wrapper."""
    return (design.ROOT / f"rtl/host/{name}.sv").read_text(encoding="utf-8")


def parameters(name):
    """(type, name, default) of each, in order."""
    return [(kind.strip(), word, value) for kind, word, value in PARAMETER.findall(source(name))]


def ports(name):
    """(direction, range, name) of each, in order."""
    header = source(name).split("\n) (\n")[1].split("\n);\n")[0]
    found = PORT.findall(header)
    lines = [line for line in header.splitlines() if line.strip()]
    if len(found) != len(lines):
        raise AssertionError(f"{name}: {len(lines)} lines of ports, {len(found)} understood")
    return found


def common(name):
    """The ports that are not of the bus."""
    all_ports = ports(name)
    return all_ports[[port[2] for port in all_ports].index(FIRST_COMMON):]


def bus_ports(name):
    """The others."""
    return ports(name)[:-len(common(name))]


def listed(text):
    """What a list of BUSES says, in the form of bus_ports()."""
    found, direction = [], "input"
    for word in text.split():
        if word in "<>":
            direction = "output" if word == ">" else "input"
        else:
            name, bracket, wide = word.partition("[")
            found.append((direction, bracket + wide, name))
    return found


def sources_of(netlist, output):
    """The input ports that an output depends on without a flip-flop between."""
    drivers = {}
    for cell in netlist["cells"].values():
        if "ff" in cell["type"] or cell["type"].startswith("$mem"):
            continue
        inputs = [bit for pin, bits in cell["connections"].items()
                  if cell["port_directions"][pin] == "input" for bit in bits]
        for pin, bits in cell["connections"].items():
            if cell["port_directions"][pin] == "output":
                drivers.update(dict.fromkeys(bits, inputs))
    seen, open_ = set(), list(netlist["ports"][output]["bits"])
    while open_:
        bit = open_.pop()
        if bit not in seen:
            seen.add(bit)
            open_ += drivers.get(bit, [])
    return {name for name, port in netlist["ports"].items()
            if port["direction"] == "input" and seen.intersection(port["bits"])}


class Wrappers(unittest.TestCase):
    maxDiff = None

    def test_list_is_complete(self):
        names = [line.rsplit("/", 1)[1] for line in design.rtl_files() if "rtl/host/" in line]
        around = [name[:-3] for name in names
                  if re.search(r"^\s*can_top\s+#?\(", source(name[:-3]), re.MULTILINE)]
        self.assertEqual(around, list(BUSES))

    def test_parameters_are_the_same(self):
        wanted = parameters("can_ahb")
        self.assertEqual(len(wanted), len(re.findall(r"\bparameter\b", source("can_ahb"))))
        for name, own in OWN.items():
            with self.subTest(name):
                mine = parameters(name)
                self.assertEqual([kind for kind, word, _ in mine if word == own], ["int"])
                self.assertEqual([p for p in mine if p[1] != own],
                                 [p for p in wanted if p[1] != OWN["can_ahb"]])
                self.assertEqual([p[1] for p in mine].index(own),
                                 [p[1] for p in wanted].index(OWN["can_ahb"]))
                self.assertEqual(mine[[p[1] for p in mine].index(own)][2], "0")

    def test_ports_are_the_same_but_for_the_bus(self):
        wanted = common("can_ahb")
        self.assertEqual(wanted[-1][2], "trace_o")
        for name in BUSES:
            with self.subTest(name):
                self.assertEqual(common(name), wanted)

    def test_other_ports_are_the_bus(self):
        for name, text in BUSES.items():
            with self.subTest(name):
                self.assertEqual(bus_ports(name), listed(text))

    def test_nothing_but_bus_logic(self):
        for name in BUSES:
            with self.subTest(name):
                self.assertLessEqual(len(source(name).splitlines()), 150)
                instances = [word for word in INSTANCE.findall(source(name))
                             if word not in ("module",) and not word.endswith(("_32", "_1"))]
                self.assertEqual(instances, ["can_top"])

    def test_other_ports_go_straight_to_the_core(self):
        """Of the netlist, flat: one net with the port of can_top."""
        for name in BUSES:
            netlist = design.netlist(name)
            for _, _, port in common(name):
                with self.subTest(name, port=port):
                    self.assertEqual(netlist["netnames"][f"u_top.{port}"]["bits"],
                                     netlist["ports"][port]["bits"])

    def test_answers_do_not_depend_on_what_is_asked_in_the_same_clock(self):
        for name in BUSES:
            netlist = design.netlist(name)
            for direction, _, port in bus_ports(name):
                if direction == "output":
                    with self.subTest(name, port=port):
                        self.assertEqual(sources_of(netlist, port), AT_ONCE[name].get(port, set()))


if __name__ == "__main__":
    unittest.main()

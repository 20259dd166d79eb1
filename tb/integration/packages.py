#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What tools/package.py writes for other tools' packagers: ports and parameters are those that
Yosys elaborates, the Verilog shells equal their wrappers, IP-XACT says what the SVD file says, and
the vendors' scripts, run in tclsh with the tools' commands recorded, name what is there.
IPXACT_XSD=folder with Accellera's 1685-2014 schema: the components are checked against it, too."""

import json
import os
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

import yaml

import design

sys.path.insert(0, str(design.ROOT / "tools"))
sys.dont_write_bytecode = True
# ruff: noqa: E402  (the path must be set first)
from pack import wrappers as source

SPACE = "{http://www.accellera.org/XMLSchema/IPXACT/1685-2014}"
# Names of signals as the bus definitions have them, where case counts: of the AMBA buses by Arm,
# of Wishbone by Kactus2.
SIGNALS = {
    "ahb": "HCLK HRESETn HSELx HADDR HTRANS HWRITE HSIZE HBURST HPROT HREADY HWDATA HRDATA "
           "HREADYOUT HRESP",
    "apb": "PCLK PRESETn PSELx PENABLE PADDR PPROT PWRITE PSTRB PWDATA PREADY PRDATA PSLVERR",
    "axil": "ACLK ARESETn AWADDR AWPROT AWVALID AWREADY WDATA WSTRB WVALID WREADY BRESP BVALID "
            "BREADY ARADDR ARPROT ARVALID ARREADY RDATA RRESP RVALID RREADY",
    "wb": "clk rst cyc stb we adr sel dat_ms dat_sm ack err stall"}
# The abstraction definitions of these.
ABSTRACTIONS = {"ahb": "AHBLite_rtl", "apb": "APB4_rtl", "axil": "AXI4-Lite_rtl",
                "wb": "wishbone.absDef"}
# Any command that a script uses and Tcl lacks is recorded; ipx's questions return what was asked.
RECORDERS = """\
proc unknown {name args} {
  puts "RECORD\\t$name\\t[join $args \\t]"
  return "<$name>"
}
rename package {}
"""


def addressed(port):
    """The width that a port has in a package whose addresses are those of the window."""
    return source.PACKAGED["RegionBits"] if port.name in ("awaddr", "araddr") else port.width


def setUpModule():
    """One set of packages for all tests."""
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    # As in the archive: beside the sources.
    Case.out = Path(folder.name)
    for name in ("rtl", "sw"):
        (Case.out / name).symlink_to(design.ROOT / name)
    code, text = design.run(design.ROOT / "tools/package.py", folder.name)
    if code != 0:
        raise AssertionError(text)
    Case.wrappers = {wrapper.bus: wrapper for wrapper in source.wrappers()}


class Case(unittest.TestCase):
    """What the tests share."""
    maxDiff = None
    out, wrappers = None, {}

    def records(self, script):
        """The commands of a script, each a list of words."""
        runner = self.out / "recorders.tcl"
        runner.write_text(RECORDERS + f"source {{{self.out / script}}}\n", encoding="utf-8")
        code, text = design.run("tclsh", runner)
        self.assertEqual(code, 0, text)
        lines = [line.split("\t") for line in text.splitlines()]
        self.assertEqual({words[0] for words in lines}, {"RECORD"}, text)
        return [words[1:] for words in lines]

    def assert_sources(self, paths):
        """Paths below the root of the packages that are the RTL in its order."""
        names = [str(Path(path).relative_to(self.out)) for path in paths]
        self.assertEqual(names, design.rtl_files())


class Place(Case):
    """The scripts take the RTL from beside them."""

    def test_without_the_rtl_it_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            code, text = design.run(design.ROOT / "tools/package.py", folder)
            self.assertEqual(code, 0, text)
            self.assertIn(f"they take the RTL from {folder}/rtl, which is not there", text)
            (Path(folder) / "rtl").symlink_to(design.ROOT / "rtl")
            code, text = design.run(design.ROOT / "tools/package.py", folder)
            self.assertEqual((code, text), (0, f"15 files in {folder}\n"))


class Wrappers(Case):
    """tools/pack/wrappers.py reads the interfaces as Yosys does."""

    def test_ports_and_parameters_are_those_of_the_rtl(self):
        self.assertIn("ahb", self.wrappers)
        design.read_once(design.rtl_files(), [
            f"blackbox can_top; hierarchy -top {wrapper.module}; proc; "
            f"write_json {self.out}/{wrapper.module}.json" for wrapper in self.wrappers.values()])
        for bus, wrapper in self.wrappers.items():
            text = (self.out / f"{wrapper.module}.json").read_text(encoding="utf-8")
            module = json.loads(text)["modules"][wrapper.module]
            seen = {name: (port["direction"], len(port["bits"]), port.get("offset", 0))
                    for name, port in module["ports"].items()}
            self.assertEqual({port.name: (port.direction, port.width, port.low)
                              for port in wrapper.ports}, seen, bus)
            values = module["parameter_default_values"]
            self.assertEqual({entry.name: entry.number for entry in wrapper.parameters},
                             {name: int(value, 2) for name, value in values.items()})

    def test_what_is_not_of_the_bus_is_the_same(self):
        common = [[(port.name, port.direction, port.width) for port in wrapper.common_ports]
                  for wrapper in self.wrappers.values()]
        self.assertTrue(all(ports == common[0] for ports in common))
        own = {"CheckHprot", "CheckProt", "Pipelined"}
        parameters = [[(p.name, p.default) for p in wrapper.parameters if p.name not in own]
                      for wrapper in self.wrappers.values()]
        self.assertTrue(all(entry == parameters[0] for entry in parameters))


class Versions(Case):
    """PK-85: the guide's table of both."""

    def test_guide_ends_with_this_version_and_xversion(self):
        guide = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (in development|\d+\.\d+\.\d+) \| (\d+\.\d+) \| ", guide,
                          re.MULTILINE)
        table = yaml.safe_load((design.ROOT / "sw/registers.yaml").read_text(encoding="utf-8"))
        word, = (entry for entry in table["registers"] if entry["name"] == "XVERSION")
        now = ".".join(str(field["reset"]) for field in word["fields"])
        self.assertEqual(rows[-1], (source.version(), now))
        numbers = [tuple(map(int, register.split("."))) for _, register in rows]
        self.assertEqual(numbers, sorted(numbers))


class Files(Case):
    """Lists and shells."""

    def test_list_is_in_an_order_that_can_be_read_file_by_file(self):
        names = (self.out / "lists/can_root.f").read_text(encoding="utf-8").split()
        self.assertEqual(names, design.rtl_files())
        script = "; ".join(f"read_verilog -sv {name}" for name in names)
        code, text = design.run("yosys", "-q", "-p", script)
        self.assertEqual(code, 0, text)
        absolute = (self.out / "lists/can_abs.f").read_text(encoding="utf-8").split()
        self.assertEqual([name.removeprefix("${VERICAN_ROOT}/") for name in absolute], names)
        probe = self.out / "probe.tcl"
        probe.write_text(f"source {{{self.out}/lists/can_files.tcl}}\n"
                         "foreach file $verican_files {puts $file}\n", encoding="utf-8")
        code, text = design.run("tclsh", probe)
        self.assertEqual(code, 0, text)
        self.assert_sources(text.split())

    def test_shells_are_verilog_2001_and_equal_their_wrappers(self):
        for wrapper in self.wrappers.values():
            code, text = design.run(
                "verilator", "--lint-only", "-Wall", "+1364-2001ext+v", "--top-module",
                f"{wrapper.module}_v", "-GNumMb=16", "rtl/lint.vlt", *design.rtl_files(),
                self.shell(wrapper))
            self.assertEqual((code, text), (0, ""))
        self.write_netlists()
        for wrapper in self.wrappers.values():
            with self.subTest(wrapper.module):
                self.assert_equal_netlists(wrapper)

    def test_shell_for_quartus_has_no_more_addresses_than_the_window(self):
        """All else is as of can_axil."""
        wrapper = self.wrappers["axil"]
        top, netlist = f"{wrapper.module}_window", self.out / "window.json"
        shell = self.out / f"verilog/{top}.v"
        self.assertEqual(design.run(
            "verilator", "--lint-only", "-Wall", "+1364-2001ext+v", "--top-module", top,
            "-GNumMb=16", "rtl/lint.vlt", *design.rtl_files(), shell), (0, ""))
        design.read_once([*design.rtl_files(), shell], [
            f"hierarchy -top {top}; proc; write_json {netlist}"])
        module = json.loads(netlist.read_text(encoding="utf-8"))["modules"][top]
        core, = module["cells"].values()
        for port in wrapper.ports:
            mine = module["ports"][port.name]
            self.assertEqual((mine["direction"], len(mine["bits"])),
                             (port.direction, addressed(port)))
            self.assertEqual(core["connections"][port.name],
                             mine["bits"] + ["0"] * (port.width - addressed(port)))
        self.assertRegex(shell.read_text(encoding="utf-8"), r"\.RegionBits\(13\)")

    def shell(self, wrapper):
        """The Verilog file around it."""
        return self.out / f"verilog/{wrapper.module}_v.v"

    def netlist(self, wrapper, side):
        """File of a netlist: `side` is gold, the wrapper, or gate, its shell."""
        return self.out / f"{wrapper.module}_{side}.il"

    def write_netlists(self):
        """Shells and wrappers around a core that is a black box, with the instance's name gone."""
        sides = [(wrapper, side, wrapper.module + ("_v" if side == "gate" else ""))
                 for wrapper in self.wrappers.values() for side in ("gold", "gate")]
        design.read_once(
            [*design.rtl_files(), *map(self.shell, self.wrappers.values())],
            [f"hierarchy -top {top}; proc; blackbox *can_top*; flatten; opt_clean -purge; "
             f"rename {top} {side}; write_rtlil {self.netlist(wrapper, side)}"
             for wrapper, side, top in sides])
        for wrapper, side, _ in sides:
            path = self.netlist(wrapper, side)
            path.write_text(path.read_text(encoding="utf-8").replace("\\u_can.", "\\"),
                            encoding="utf-8")

    def assert_equal_netlists(self, wrapper):
        """One of the pairs."""
        code, text = design.run("yosys", "-q", "-p", (
            f"read_rtlil {self.netlist(wrapper, 'gold')}; design -stash gold; "
            f"read_rtlil {self.netlist(wrapper, 'gate')}; "
            "design -copy-from gold -as gold gold; equiv_make gold gate equiv; "
            "hierarchy -top equiv; async2sync; equiv_struct; equiv_simple; equiv_induct; "
            "equiv_status -assert"))
        self.assertEqual(code, 0, text)


class IpXact(Case):
    """The components."""

    def tree(self, wrapper):
        return ET.parse(self.out / f"ipxact/{wrapper.module}.xml").getroot()

    def test_they_follow_the_schema(self):
        for wrapper in self.wrappers.values():
            code, text = design.run(
                "xmllint", "--noout", "--relaxng", design.ROOT / "tools/pack/ipxact.rng",
                self.out / f"ipxact/{wrapper.module}.xml")
            self.assertEqual(code, 0, text)

    def test_they_follow_accelleras_schema(self):
        folder = os.environ.get("IPXACT_XSD")
        if not folder:
            self.skipTest("IPXACT_XSD is not set: not checked against Accellera's schema")
        for wrapper in self.wrappers.values():
            code, text = design.run("xmllint", "--noout", "--nonet", "--schema",
                                    Path(folder) / "index.xsd",
                                    self.out / f"ipxact/{wrapper.module}.xml")
            self.assertEqual(code, 0, text)

    def test_registers_are_those_of_the_svd_file(self):
        described = svd_registers()
        for wrapper in self.wrappers.values():
            self.assertEqual(xact_registers(self.tree(wrapper)), described)

    def test_what_the_core_changes_is_volatile(self):
        """PK-60: a model of the registers must not expect there what was written last."""
        for wrapper in self.wrappers.values():
            told = {(register.findtext(f"{SPACE}name"), field.findtext(f"{SPACE}name")):
                    field.findtext(f"{SPACE}volatile") == "true"
                    for register in self.tree(wrapper).iter(f"{SPACE}register")
                    for field in register.iter(f"{SPACE}field")}
            for name in ("TIMER", "ECR", "ESR1", "IFLAG1", "IFLAG2", "ESR2", "CRCR", "RXFIR",
                         "CS", "ID", "DATA0", "DATA1", "STAMPLO_63"):
                fields = {told[key] for key in told if key[0] == name}
                self.assertEqual(fields, {True}, name)
            for name in ("CTRL1", "CTRL2", "RXGMASK", "IMASK1", "IMASK2", "RXFGMASK", "RXIMR",
                         "XID", "XVERSION", "XCONFIG", "XCTRL", "TCAP", "TINCN", "TCMP"):
                fields = {told[key] for key in told if key[0] == name}
                self.assertEqual(fields, {False}, name)
            changed = {name for register, name in told if told[register, name]
                       and register == "MCR"}
            self.assertEqual(changed, {"NOT_RDY", "SOFT_RST", "FRZ_ACK", "LPM_ACK"})

    def test_descriptions_are_sentences(self):
        for wrapper in self.wrappers.values():
            told = {entry.findtext(f"{SPACE}name"): entry.findtext(f"{SPACE}description")
                    for entry in self.tree(wrapper).iter(f"{SPACE}register")}
            self.assertEqual(told["TIMER"],
                             "Free-running timer. A read unlocks the buffer that was locked.")
            self.assertRegex(told["IMASK2"], r"\(only if NumMb > 32\)$")
            self.assertEqual([name for name, text in told.items() if ".." in text], [])

    def test_signals_have_the_names_of_the_bus_definitions(self):
        for bus, wrapper in self.wrappers.items():
            root = self.tree(wrapper)
            names = [pair.text for pair in root.iterfind(f".//{SPACE}logicalPort/{SPACE}name")]
            self.assertEqual(set(names), set(SIGNALS[bus].split()))
            self.assertEqual({entry.get("name") for entry in root.iter(f"{SPACE}abstractionRef")},
                             {ABSTRACTIONS[bus]})

    def test_data_of_wishbone_go_the_way_that_their_names_say(self):
        root = self.tree(self.wrappers["wb"])
        pairs = {pair.findtext(f"{SPACE}logicalPort/{SPACE}name"):
                 pair.findtext(f"{SPACE}physicalPort/{SPACE}name")
                 for pair in root.iter(f"{SPACE}portMap")}
        self.assertEqual((pairs["dat_ms"], pairs["dat_sm"]), ("wb_dat_i", "wb_dat_o"))

    def test_clock_and_reset_of_wishbone_are_of_its_system(self):
        system, slave = self.tree(self.wrappers["wb"]).iter(f"{SPACE}busInterface")
        self.assertEqual(system.findtext(f"{SPACE}system/{SPACE}group"), "ClockSink")
        names = [name.text for name in system.iterfind(f".//{SPACE}logicalPort/{SPACE}name")]
        self.assertEqual(names, ["clk", "rst"])
        self.assertIsNotNone(slave.find(f"{SPACE}slave"))

    def test_ports_and_maps_are_those_of_the_wrapper(self):
        for wrapper in self.wrappers.values():
            root = self.tree(wrapper)
            self.assertEqual([xact_port(port) for port in root.iter(f"{SPACE}port")],
                             [(port.name, port.direction, port.width, port.low)
                              for port in wrapper.ports])
            pairs = [(pair.findtext(f"{SPACE}logicalPort/{SPACE}name"),
                      pair.findtext(f"{SPACE}physicalPort/{SPACE}name"))
                     for pair in root.iter(f"{SPACE}portMap")]
            self.assertEqual([name for _, name in pairs],
                             [port.name for port in wrapper.bus_ports])
            self.assertEqual(len({name for name, _ in pairs}), len(pairs))
            named = {entry.get("parameterId"): entry.findtext(f"{SPACE}value")
                     for entry in root.iter(f"{SPACE}parameter")}
            self.assertEqual(set(named), {entry.name for entry in wrapper.parameters})
            size = root.findtext(f".//{SPACE}addressBlock/{SPACE}range")
            self.assertEqual(1 << int(named["RegionBits"]), int(size.removeprefix("'h"), 16))
            files = [file.findtext(f"{SPACE}name") for file in root.iter(f"{SPACE}file")]
            self.assertEqual(files, [f"../{name}" for name in design.rtl_files()])


def xact_port(port):
    """Name, direction, width and lowest bit of a port of an IP-XACT component."""
    high, low = (int(port.findtext(f".//{SPACE}vector/{SPACE}{end}", "0"))
                 for end in ("left", "right"))
    return (port.findtext(f"{SPACE}name"), port.findtext(f"{SPACE}wire/{SPACE}direction") + "put",
            high - low + 1, low)


def rows(entry, tags, number):
    """The addresses of an entry that may be repeated, relative to what holds it. `tags`: number,
    offset and distance."""
    count, offset, step = (entry.findtext(tag) for tag in tags)
    return [number(offset) + n * number(step or "0") for n in range(number(count or "1"))]


def svd_registers():
    """(address, name of field) -> (lowest bit, highest bit, access, reset, effect of a write, of a
    read), alternate views left out."""
    found = {}

    def visit(parent, base):
        for cluster in parent.findall("cluster"):
            for address in rows(cluster, ("dim", "addressOffset", "dimIncrement"),
                                lambda text: int(text, 0)):
                visit(cluster, base + address)
        for register in parent.findall("register"):
            if register.find("alternateRegister") is not None:
                continue
            for address in rows(register, ("dim", "addressOffset", "dimIncrement"),
                                lambda text: int(text, 0)):
                for field in register.iter("field"):
                    low, high = int(field.findtext("lsb")), int(field.findtext("msb"))
                    reset = int(register.findtext("resetValue"), 0) >> low
                    found[base + address, field.findtext("name")] = (
                        low, high, field.findtext("access"), reset & (2 << high - low) - 1,
                        field.findtext("modifiedWriteValues"), field.findtext("readAction"))
    visit(ET.parse(design.ROOT / "sw/verican.svd").getroot().find(".//registers"), 0)
    return found


def xact_registers(root):
    """The same of an IP-XACT component."""
    found = {}

    def number(text):
        return int(text[2:], 16) if text.startswith("'h") else int(text)

    def visit(parent, base):
        for group in parent.findall(f"{SPACE}registerFile"):
            for address in rows(group, (f"{SPACE}dim", f"{SPACE}addressOffset", f"{SPACE}range"),
                                number):
                visit(group, base + address)
        for register in parent.findall(f"{SPACE}register"):
            offset = number(register.findtext(f"{SPACE}addressOffset"))
            for row in range(number(register.findtext(f"{SPACE}dim", "1"))):
                for field in register.iter(f"{SPACE}field"):
                    low = number(field.findtext(f"{SPACE}bitOffset"))
                    width = number(field.findtext(f"{SPACE}bitWidth"))
                    reset = field.findtext(f"{SPACE}resets/{SPACE}reset/{SPACE}value")
                    found[base + offset + 4 * row, field.findtext(f"{SPACE}name")] = (
                        low, low + width - 1, field.findtext(f"{SPACE}access"), number(reset),
                        field.findtext(f"{SPACE}modifiedWriteValue"),
                        field.findtext(f"{SPACE}readAction"))
    visit(root.find(f".//{SPACE}addressBlock"), 0)
    return found


class Vendors(Case):
    """The scripts for Vivado, Quartus and Libero."""

    def test_vivado(self):
        wrapper = self.wrappers["axil"]
        done = self.records("fpga/vivado/package.tcl")
        files, = (words[2].split() for words in done if words[0] == "add_files")
        self.assertEqual(Path(files[-1]), self.out / f"verilog/{wrapper.module}_v.v")
        self.assertTrue(Path(files[-1]).is_file())
        self.assert_sources(files[:-1])
        self.assertIn(["set_property", "top", f"{wrapper.module}_v", "<current_fileset>"], done)
        asked = [words[1] for words in done if words[0] == "ipx::get_user_parameters"]
        self.assertEqual(asked, [entry.name for entry in wrapper.parameters])
        self.assertEqual(done[-1][0], "ipx::save_core")

    def test_vivado_knows_the_ports_of_the_bus(self):
        wrapper, done = self.wrappers["axil"], self.records("fpga/vivado/package.tcl")
        names = [port.name for port in wrapper.bus_ports[2:]]
        self.assertEqual([words[2] for words in done if words[1] == "physical_name"], names)
        self.assertEqual([words[1] for words in done if words[0] == "ipx::add_port_map"],
                         [name.upper() for name in names])
        self.assertEqual([words[1] for words in done if words[0] == "ipx::infer_bus_interface"],
                         [wrapper.clock, wrapper.reset, "irq_o"])

    def test_vivado_knows_map_clock_and_reset_of_the_bus(self):
        """Or nothing can be given an address, and no design with it is valid."""
        wrapper, done = self.wrappers["axil"], self.records("fpga/vivado/package.tcl")
        bus, core = "<ipx::get_bus_interfaces>", "<ipx::current_core>"
        for words in (["ipx::add_bus_interface", "s", core],
                      ["set_property", "slave_memory_map_ref", "registers", bus],
                      ["ipx::associate_bus_interfaces", "-busif", "s", "-clock", wrapper.clock,
                       core],
                      ["ipx::associate_bus_interfaces", "-clock", wrapper.clock, "-reset",
                       wrapper.reset, core]):
            self.assertIn(words, done)
        self.assertIn(["ipx::get_bus_interfaces", "s", "-of_objects", core], done)
        before = [words[:2] for words in done]
        self.assertLess(before.index(["ipx::add_memory_map", "registers"]),
                        before.index(["set_property", "slave_memory_map_ref"]))

    def test_vivado_gives_the_core_no_more_than_its_window(self):
        done = self.records("fpga/vivado/package.tcl")
        window = 1 << source.PACKAGED["RegionBits"]
        self.assertIn(["set_property", "range", str(window), "<ipx::add_address_block>"], done)
        asked = done.index(["ipx::get_user_parameters", "RegionBits", "-of_objects",
                            "<ipx::current_core>"])
        self.assertEqual(done[asked + 1][:3],
                         ["set_property", "value", str(source.PACKAGED["RegionBits"])])

    def test_vivado_sets_no_value_that_it_has_read_itself(self):
        """It has read the defaults, and wants those of vectors (TimeInc) as bits or hexadecimal."""
        done = self.records("fpga/vivado/package.tcl")
        changed = {name: str(value) for name, value in source.PACKAGED.items()}
        of = {}
        for before, words in zip(done, done[1:]):
            if words[:2] == ["set_property", "value"]:
                of[before[1]] = words[2]
        self.assertEqual(of, {"PROTOCOL": "AXI4LITE", **changed})

    def test_quartus(self):
        wrapper = self.wrappers["axil"]
        done = self.records("fpga/quartus/can_hw.tcl")
        *sources, top = [words[-1] for words in done if words[0] == "add_fileset_file"]
        self.assert_sources(sources)
        self.assertTrue(Path(top).is_file())
        self.assertIn(["set_fileset_property", "rtl", "TOP_LEVEL", Path(top).stem], done)
        added = [words[1:] for words in done if words[0] == "add_parameter"]
        for name, kind, value in added:
            self.assertEqual(kind == "STD_LOGIC_VECTOR", value.startswith("0x"), name)
        parameters = {name: int(value, 0) for name, _, value in added}
        self.assertEqual(parameters, {entry.name: entry.number for entry in wrapper.parameters
                                      if entry.name != "RegionBits"})
        ports = {words[2]: (words[4].lower(), int(words[5])) for words in done
                 if words[0] == "add_interface_port"}
        self.assertEqual(ports, {port.name: (port.direction, addressed(port))
                                 for port in wrapper.ports})
        svd, = (words[3] for words in done if "CMSIS_SVD_FILE" in words)
        self.assertTrue(Path(svd).is_file())

    def test_libero(self):
        done = self.records("fpga/libero/hdl_core.tcl")
        self.assert_sources([words[2] for words in done if words[0] == "create_links"])
        made = [words for words in done if words[0] == "create_hdl_core"]
        self.assertEqual({words[4] for words in made},
                         {f"can_{bus}" for bus in ("ahb", "apb") if bus in self.wrappers})
        for words in made:
            self.assertTrue(Path(words[2]).is_file())
            bus = words[4].removeprefix("can_")
            mapped = [entry[-1] for entry in done
                      if entry[:3] == ["hdl_core_assign_bif_signal", "-hdl_core_name", words[4]]]
            ports = [port.name for port in self.wrappers[bus].bus_ports[2:]]
            self.assertEqual(mapped, [name for name in ports if name not in ("pstrb", "pprot")])

    def test_heads_say_that_they_were_not_run(self):
        for name in ("vivado/package.tcl", "quartus/can_hw.tcl", "libero/hdl_core.tcl"):
            head = (self.out / "fpga" / name).read_text(encoding="utf-8")[:700]
            self.assertRegex(head, r"Not run by \w+")


if __name__ == "__main__":
    unittest.main()

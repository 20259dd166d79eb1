#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The constraints of the families say what they should, of ports and flip-flops that are there: for
the core alone, as they are committed, and for an instance in a design. Files in Tcl run in tclsh
with the tools' commands recorded; of the others every line must be one that is known. What the
vendors' tools do with them is not tested; iCE40: ice40_makefile.py."""

import fnmatch
import re
import sys
import tempfile
import unittest
from pathlib import Path

import design

sys.path.insert(0, str(design.ROOT / "tools"))
sys.dont_write_bytecode = True
# ruff: noqa: E402  (the path must be set first)
import constraints
from pack import shell, wrappers

FOLDER = design.ROOT / "constraints"
RECORDERS = """\
proc unknown {name args} {puts "RECORD\\t$name\\t[join $args \\t]"}
foreach kind {ports cells regs registers} {
  proc get_$kind pattern "return \\"$kind \\$pattern\\""
}
"""
TCL = (".sdc", ".pdc", ".xdc", ".tcl")
# Files that nextpnr reads, and all that it knows of the commands of such a file: it stops at any
# other, and at a set_false_path without -to, or whose -to is no pin of a placed cell.
NEXTPNR = {"nexus/can_nextpnr.pdc": {"create_clock", "ldc_set_port"},
           "gatemate/can.sdc": {"create_clock"}}
QUOTED = r'"([^"]+)"'
# Lines of the formats that are no Tcl: what they say, as words.
LPF = {r"FREQUENCY PORT {q} ([\d.]+) MHZ ;": ("clock",),
       r"BLOCK PATH FROM PORT {q} TO CELL {q} ;": ("false",),
       r"BLOCK PATH FROM PORT {q} ;": ("false",),
       r"MAXDELAY FROM CELL {q} TO PORT {q} 15.000 ns ;": ("bound",),
       r"IOBUF PORT {q} IO_TYPE=LVCMOS33 PULLMODE=UP( \w+=\w+)+ ;": ("pull",)}
CST = {r"IO_PORT {q} IO_TYPE=LVCMOS33 PULL_MODE=UP( \w+=\w+)+;": ("pull",)}
CCF = {r'NET {q} Loc = "IO_[NEWS][ABC]_[AB][0-8]" \| SCHMITT_TRIGGER=true \| PULLUP=true;':
       ("pull",), r'NET {q} Loc = "IO_[NEWS][ABC]_[AB][0-8]" \| \w+=\w+;': ("pin",)}


class Facts:
    """What a family's files say."""

    def __init__(self):
        self.clock, self.false, self.bound, self.pulls, self.pins = [], [], [], set(), set()

    def lines(self, text, forms):
        """Of a format with one statement a line."""
        for line in text.splitlines():
            if not line or line.startswith(("#", "//")):
                continue
            for form, (what,) in forms.items():
                match = re.fullmatch(form.replace("{q}", QUOTED), line)
                if match:
                    self.take(what, match.groups())
                    break
            else:
                raise AssertionError(f"no line of this format: {line}")

    def take(self, what, words):
        """One of a line's forms."""
        if what == "clock":
            self.clock.append((words[0], 1000 / float(words[1])))
        elif what == "false":
            self.false.append((words[0], words[1] if len(words) > 1 else None))
        elif what == "bound":
            self.bound.append((words[0], words[1], 15.0))
        else:
            (self.pulls if what == "pull" else self.pins).add(words[0])

    def command(self, name, words):
        """A command of a tool, as it was recorded."""
        of = {word: words[at + 1].split(maxsplit=1)[-1] for at, word in enumerate(words[:-1])
              if word.startswith("-")}
        last = words[-1].split(maxsplit=1)[-1]
        if name == "create_clock":
            self.clock.append((last, float(of["-period"])))
        elif name == "set_false_path":
            self.false.append((of["-from"], of.get("-to")))
        elif name == "set_max_delay":
            self.bound.append((of["-from"], of["-to"],
                               float(next(word for word in words if re.match(r"\d", word)))))
        elif name == "set_io":
            port = of.get("-port_name", words[0])
            self.pins.add(port)
            if of["-RES_PULL"] == "Up":
                self.pulls.add(port)
        elif name == "ldc_set_port":
            if "PULLMODE=UP" in words[words.index("-iobuf") + 1].split():
                self.pulls.add(last)
        elif name == "set_property":
            if words[:2] == ["PULLTYPE", "PULLUP"]:
                self.pulls.add(last)
            elif words[0] == "IOB":
                self.pins.add(last)
            else:
                assert words[:2] == ["IOSTANDARD", "LVCMOS33"], words
        elif name == "set_instance_assignment":
            if (of["-name"], words[2]) == ("WEAK_PULL_UP_RESISTOR", "ON"):
                self.pulls.add(words[-1])
            self.pins.add(words[-1])
        else:
            raise AssertionError(f"no command of a tool: {name}")

    # What Efinity's Interface Designer calls `design`.
    def create_input_gpio(self, port):
        self.pins.add(port)

    create_output_gpio = create_input_gpio

    def set_property(self, port, name, value):
        """Efinity's."""
        assert port in self.pins
        if (name, value) == ("PULL_OPTION", "WEAK_PULLUP"):
            self.pulls.add(port)


def commands(path):
    """Name and words of each command of a file in Tcl."""
    with tempfile.NamedTemporaryFile("w", suffix=".tcl") as file:
        file.write(f"{RECORDERS}source {{{path}}}\n")
        file.flush()
        code, out = design.run("tclsh", file.name)
    if code != 0:
        raise AssertionError(f"{path}: {out}")
    for line in out.splitlines():
        mark, name, *words = line.split("\t")
        assert mark == "RECORD", line
        yield name, words


def facts_of(*paths):
    """The facts of files."""
    facts = Facts()
    for path in paths:
        text = path.read_text(encoding="utf-8")
        if path.suffix in TCL:
            for name, words in commands(path):
                facts.command(name, words)
        elif path.suffix == ".py":
            exec(compile(text, path, "exec"), {"design": facts})  # pylint: disable=exec-used
        else:
            facts.lines(text, {".lpf": LPF, ".cst": CST, ".ccf": CCF}[path.suffix])
    return facts


def flip_flop(netlist, pattern, suffix=""):
    """D and Q, of one bit each, of the one flip-flop whose name, with what the tool puts behind it,
    a pattern fits."""
    wanted = re.sub(r"[/|]", ".", pattern)
    bits = {tuple(net["bits"]) for name, net in netlist["netnames"].items()
            if fnmatch.fnmatchcase(name + suffix, wanted)}
    found = [(cell["connections"]["D"], cell["connections"]["Q"])
             for cell in netlist["cells"].values() if cell["type"].startswith(("$adff", "$dff"))
             and tuple(cell["connections"]["Q"]) in bits]
    if len(found) != 1 or len(found[0][1]) != 1:
        raise AssertionError(f"{pattern}: {len(found)} flip-flops")
    return found[0]


class Constraints(unittest.TestCase):
    """All families, for a design."""

    def hold(self, folder, place, netlist):
        ports = {name: port["bits"] for name, port in netlist["ports"].items()}
        for family in constraints.FAMILIES:
            with self.subTest(family=family):
                facts = facts_of(*sorted(path for path in (folder / family).glob("can*.*")
                                         if "nextpnr" not in path.name))
                behind = "_reg" if family == "xilinx" else ""
                self.assertEqual(facts.clock, [(place.clock, 1000 / place.mhz)])
                if family == "gatemate":   # its timing is for nextpnr
                    self.assertIn(place.rx, facts.pulls)
                    continue
                (rx, sync), (reset, _) = facts.false
                self.assertEqual((rx, reset), (place.rx, place.reset))
                self.assertEqual(facts.false[1][1], None)
                self.assertEqual(flip_flop(netlist, sync, behind)[0], ports[rx],
                                 "D of can_sync's first")
                (sent, tx, bound), = facts.bound
                self.assertEqual((tx, bound), (place.tx, 15.0))
                self.assertEqual(flip_flop(netlist, sent, behind)[1], ports[tx], "Q at the pin")
                self.assertIn(place.rx, facts.pulls)
                for port in (facts.pulls | facts.pins | {place.clock, reset}) - {sent}:
                    self.assertIn(port, ports)

    def test_the_core_alone(self):
        self.hold(FOLDER, constraints.Place(), design.netlist("can_ahb"))

    def test_an_instance_in_a_design(self):
        with tempfile.TemporaryDirectory() as name:
            top = Path(name) / "user_top.sv"
            top.write_text(design.user_top(), encoding="utf-8")
            options = ("--instance", "u_can", "--mhz", 16, "--clock", "hclk", "--reset", "hresetn",
                       "--rx", "can_rxd", "--tx", "can_txd")
            code, text = design.run("tools/constraints.py", name, *options)
            self.assertEqual((code, text), (0, ""))
            place = constraints.Place("u_can", 16, rx="can_rxd", tx="can_txd")
            self.hold(Path(name), place, design.netlist("user_top", (top,)))

    def test_committed_files_are_what_the_tool_writes(self):
        for name, text in constraints.render(constraints.Place()).items():
            self.assertEqual((FOLDER / name).read_text(encoding="utf-8"), text, name)
            self.assertRegex(text[:700], r"Not run in the vendor's tool")

    def test_nextpnr_knows_the_commands_of_its_files(self):
        place = constraints.Place()
        guide = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        for name, known in NEXTPNR.items():
            with self.subTest(name):
                path = FOLDER / name
                self.assertLessEqual({command for command, _ in commands(path)}, known)
                facts = facts_of(path)
                self.assertEqual(facts.clock, [(place.clock, 1000 / place.mhz)])
                self.assertEqual(place.rx in facts.pulls, "ldc_set_port" in known)
                row, = re.findall(rf"^.*\(\.\./constraints/{path.parent.name}\).*$", guide, re.M)
                self.assertRegex(row, rf"`{re.escape(path.name)}` for nextpnr")

    def test_guide_says_where_the_core_is_in_a_shell(self):
        """The flip-flops are found below the core, not below what is around it."""
        guide = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        for wrapper in wrappers.wrappers():
            core, = re.findall(r"^  \) (\w+) \($", shell.render(wrapper), re.M)
            self.assertIn(f"`{core}` of its shell", guide)

    def test_every_family_is_there(self):
        folders = {path.name for path in FOLDER.iterdir()}
        self.assertEqual(folders, {*constraints.FAMILIES, "ice40"})
        self.assertEqual(len(folders), 10)
        table = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        for name in folders:
            self.assertTrue(f"](../constraints/{name})" in table, f"no {name} in the guide's table")

    def test_nothing_but_what_was_asked_for(self):
        text = "".join(constraints.render(constraints.Place(mhz=0, reset="")).values())
        self.assertNotRegex(text, r"create_clock|FREQUENCY|hresetn|hclk")

    def test_vivado_finds_registers_and_not_the_logic_in_front_of_them(self):
        text = constraints.render(constraints.Place())["xilinx/can.xdc"]
        cells = re.findall(r"get_cells \{(.*?)\}", text)
        self.assertEqual(len(cells), 3)
        for pattern in cells:
            register = pattern.removesuffix("_reg*")
            self.assertTrue(fnmatch.fnmatchcase(f"{register}_reg", pattern))
            self.assertFalse(fnmatch.fnmatchcase(f"{register}_i_1", pattern), pattern)

    def refused(self, words, *options):
        """The tool says so and writes nothing."""
        with tempfile.TemporaryDirectory() as name:
            code, text = design.run("tools/constraints.py", name, *options)
            self.assertEqual((code, list(Path(name).iterdir())), (1, []), text)
            self.assertIn(words, text)

    def test_one_port_for_two_things_is_refused(self):
        for options, words in ((("--rx", "can_tx_o"), "--rx and --tx are both 'can_tx_o'"),
                               (("--tx", "hclk"), "--clock and --tx are both 'hclk'"),
                               (("--rx", "hresetn"), "--reset and --rx are both 'hresetn'"),
                               (("--clock", "hresetn"), "--clock and --reset are both")):
            with self.subTest(options):
                self.refused(words, *options)

    def test_an_instance_wants_the_ports_of_its_design(self):
        ports = {"--rx": "a", "--tx": "b", "--reset": "", "--clock": "c"}
        for left_out in ports:
            with self.subTest(left_out):
                given = [word for pair in ports.items() if pair[0] != left_out for word in pair]
                self.refused(f"--instance needs {left_out}, too", "--instance", "u_can", *given)
        with tempfile.TemporaryDirectory() as name:
            self.assertEqual(design.run(
                "tools/constraints.py", name, "--instance", "u_can", "--mhz", 0, "--reset", "",
                "--rx", "a", "--tx", "b"), (0, ""))

    def test_a_clock_that_is_too_slow_is_told(self):
        with tempfile.TemporaryDirectory() as name:
            code, text = design.run("tools/constraints.py", name, "--mhz", 4)
            self.assertEqual(code, 1)
            self.assertIn("--mhz 4: 8 to 1000 are allowed", text)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The LiteX module: with a stand-in for the few names of migen and LiteX that it imports, which
records the instance, and compares its ports and parameters with can_wb. A design in another folder
uses it. LITEX=folders of migen and LiteX, separated by colons: a SoC without CPU is elaborated by
LiteX itself and its result linted."""

import ast
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import types
import unittest
from pathlib import Path

import design

sys.dont_write_bytecode = True
sys.path[:0] = [str(design.ROOT / "tools"), str(design.ROOT / "sw/litex")]
# ruff: noqa: E402  (the path must be set first)
from pack import wrappers as source

# What csr.json of a SoC holds, as far as it is looked at.
SOC = {"memories": {"controller0": {"base": 0xF0040000, "size": 0x2000},
                    "main_ram": {"base": 0x40000000, "size": 0x10000000}},
       "constants": {"controller0_verican": 1, "controller0_interrupt": 5,
                     "controller0_verican_num_mb": 64, "controller0_verican_fifo": 1,
                     "controller0_verican_own_masks": 1, "config_clock_frequency": 50000000}}
USER = Path(__file__).with_name("litex_user.py")


class Net:
    """A signal: anything is part of it."""

    def __init__(self, name=""):
        self.name = name

    def __getattr__(self, name):
        return Net(f"{self.name}.{name}")


class Submodules:
    """`self.submodules.x = module` makes it `self.x`, too."""

    def __init__(self, owner):
        object.__setattr__(self, "owner", owner)

    def __setattr__(self, name, module):
        setattr(self.owner, name, module)


class Module:
    """What migen's Module is here."""

    def __new__(cls, *_, **__):
        made = object.__new__(cls)
        made.submodules, made.specials = Submodules(made), []
        return made


class Specials(list):
    """`+=` of one instance."""

    def __iadd__(self, other):
        self.append(other)
        return self


def instance(of, **ports):
    """Records an instance."""
    return Specials([types.SimpleNamespace(of=of, ports=ports)])


def stand_ins():
    """The modules that the package imports."""
    migen = types.ModuleType("migen")
    migen.Module, migen.Instance, migen.Signal = Module, instance, Net
    migen.ClockSignal, migen.ResetSignal = (lambda: Net("clk")), (lambda: Net("rst"))
    modules = {"migen": migen}
    for name in ("litex", "litex.soc", "litex.soc.integration", "litex.soc.integration.soc",
                 "litex.soc.interconnect", "litex.soc.interconnect.wishbone"):
        modules[name] = types.ModuleType(name)
    modules["litex.soc.interconnect"].wishbone = modules["litex.soc.interconnect.wishbone"]
    modules["litex.soc.interconnect.wishbone"].Interface = \
        lambda data_width, adr_width: Net(f"bus{data_width}_{adr_width}")
    modules["litex.soc.integration.soc"].SoCRegion = types.SimpleNamespace
    return modules


class Platform:
    """Takes sources."""

    def __init__(self):
        self.sources = []

    def add_source(self, path):
        self.sources.append(path)


class Soc(Module):
    """Records what is added to it."""

    def __init__(self):
        self.platform, self.slaves, self.constants = Platform(), [], {}
        self.interrupts = []
        self.bus = types.SimpleNamespace(add_slave=lambda *words: self.slaves.append(words))
        self.irq = types.SimpleNamespace(
            enabled=True, add=lambda name, use_loc_if_exists: self.interrupts.append(name))

    def add_constant(self, name, value):
        self.constants[name] = value


class StandIn(unittest.TestCase):
    """The module beside records of migen's and LiteX' names."""

    @classmethod
    def setUpClass(cls):
        sys.modules.update(stand_ins())
        import verican  # pylint: disable=import-outside-toplevel
        from verican import dts  # pylint: disable=import-outside-toplevel
        cls.verican, cls.dts = verican, dts
        cls.wrapper = next(w for w in source.wrappers() if w.bus == "wb")
        cls.pads = types.SimpleNamespace(tx=Net("tx"), rx=Net("rx"))

    def instance(self, **options):
        core = self.verican.VeriCAN(Platform(), self.pads, **options)
        made, = core.specials
        return core, made

    def test_ports_are_those_of_the_wrapper(self):
        _, made = self.instance()
        self.assertEqual(made.of, self.wrapper.module)
        directions = {"i": "input", "o": "output"}
        ports = {port.name: port.direction for port in self.wrapper.ports}
        used = {name[2:]: directions[name[0]] for name in made.ports if name[0] in "io"}
        self.assertEqual(used, {name: ports.get(name) for name in used})
        inputs = {name for name, direction in ports.items() if direction == "input"}
        self.assertEqual(inputs - set(used), set(), "inputs that nobody drives")
        self.assertEqual({"wb_dat_o", "wb_ack_o", "wb_err_o", "irq_o", "can_tx_o"} - set(used),
                         set())

    def test_parameters_are_those_of_the_profile(self):
        known = {entry.name for entry in self.wrapper.parameters}
        for profile in ("small", "standard", "full"):
            text = design.run("tools/profiles.py", profile)[1]
            wanted = {name: int(value) for name, value in
                      (word.split("=") for word in text.split())}
            _, made = self.instance(profile=profile)
            set_ = {name[2:]: value for name, value in made.ports.items() if name[0] == "p"}
            self.assertLessEqual(set(set_), known)
            self.assertEqual(set_, {**wanted, "RegionBits": 13})
            _, made = self.instance(profile=profile, num_mb=64)
            self.assertEqual(made.ports["p_NumMb"], 64)

    def test_sources_are_the_list(self):
        core = Platform()
        self.verican.VeriCAN(core, self.pads)
        self.assertEqual([str(Path(path).relative_to(design.ROOT)) for path in core.sources],
                         design.rtl_files())

    def test_gowins_tool_is_told_the_language(self):
        for chosen, wanted in (({}, "sysv2017"), ({"verilog_std": "sysv2020"}, "sysv2020")):
            board = Platform()
            board.toolchain = type("GowinToolchain", (), {"options": chosen})()
            self.verican.VeriCAN(board, self.pads)
            self.assertEqual(board.toolchain.options, {"verilog_std": wanted})

    def test_it_joins_a_soc(self):
        soc = Soc()
        self.verican.VeriCAN.add_to(soc, "controller0", self.pads, 0xF0040000)
        (name, bus, region), = soc.slaves
        self.assertEqual((name, bus.name), ("controller0", "bus32_30"))
        self.assertEqual(vars(region), {"origin": 0xF0040000, "size": 0x2000, "cached": False})
        self.assertEqual(soc.interrupts, ["controller0"])
        self.assertTrue(hasattr(soc.controller0.ev, "irq"))

    def test_its_constants_are_what_it_has(self):
        features = [next(iter(line.split("=")))
                    for line in design.run("tools/profiles.py", "--features")[1].split()]
        known = {f"c0_verican_{snake}": feature for feature, snake in (
            (name, re.sub("([a-z])([A-Z])", r"\1_\2", name).lower())
            for name in features if name not in ("TimeUnit", "TimeSync"))}
        for profile, buffers, lacks in (("full", 64, set()), ("standard", 32, {"Fifo", "Status"}),
                                        ("small", 16, set(known.values()))):
            soc = Soc()
            self.verican.VeriCAN.add_to(soc, "c0", self.pads, 0, profile=profile)
            has = {name: int(feature not in lacks) for name, feature in known.items()}
            self.assertEqual(soc.constants,
                             {"c0_verican": 1, "c0_verican_num_mb": buffers, **has})

    def node_of(self, **options):
        """The node of a core that was added so."""
        soc = Soc()
        self.verican.VeriCAN.add_to(soc, "c0", self.pads, 0, **options)
        constants = {**soc.constants, "c0_interrupt": 5, "config_clock_frequency": 50000000}
        return self.dts.node({"memories": {"c0": {"base": 0}}, "constants": constants}, "c0")

    def test_no_node_for_a_core_that_linux_cannot_drive(self):
        for options, words in (({"profile": "small"}, "NumMb = 64, Fifo = 1, OwnMasks = 1"),
                               ({"profile": "standard", "num_mb": 64}, "needs Fifo = 1"),
                               ({"profile": "full", "num_mb": 32}, "needs NumMb = 64")):
            with self.subTest(options), self.assertRaisesRegex(ValueError, words):
                self.node_of(**options)
        self.assertIn("fsl,ls1021ar2-flexcan", self.node_of(profile="full"))
        old = {**SOC, "constants": {name: value for name, value in SOC["constants"].items()
                                    if not name.startswith("controller0_verican_")}}
        with self.assertRaisesRegex(ValueError, "controller0 is no core for Linux"):
            self.dts.nodes(old)

    def test_interrupts_of_an_aplic_have_flags(self):
        for memory, label in (("aplic_s", "intc_s"), ("aplic_m", "intc_m")):
            soc = {**SOC, "memories": {**SOC["memories"], memory: {"base": 0xC000000}}}
            text = self.dts.nodes(soc)
            self.assertIn("interrupts = <5 0x4>;", text)
            self.assertIn(f"interrupt-parent = <&{label}>;", text)
            self.compiles(text)
        self.assertIn("interrupt-parent = <&other>;", self.dts.nodes(SOC, "other"))

    def test_bad_input_is_told(self):
        for options, words in (({"profile": "tiny"}, "small, standard, full"),
                               ({"num_mb": 17}, "16, 32 or 64")):
            with self.assertRaisesRegex(ValueError, words):
                self.instance(**options)
        with self.assertRaisesRegex(FileNotFoundError, "can.f"):
            self.instance(rtl="/nowhere")
        with self.assertRaisesRegex(ValueError, "ctucanfd"):
            self.verican.VeriCAN.add_to(Soc(), "can0", self.pads, 0)
        with self.assertRaisesRegex(ValueError, "multiple of 0x2000"):
            self.verican.VeriCAN.add_to(Soc(), "c0", self.pads, 0x1000)

    def test_a_design_elsewhere_takes_it(self):
        with tempfile.TemporaryDirectory() as name:
            shutil.copy(USER, Path(name) / "user.py")
            space = {}
            exec(compile((Path(name) / "user.py").read_text(encoding="utf-8"), "user.py", "exec"),
                 space)  # pylint: disable=exec-used
            soc = Soc()
            soc.platform.request = lambda _: self.pads
            space["add_can"](soc)
            self.assertEqual([words[0] for words in soc.slaves], ["controller0"])

    def test_device_tree_node_compiles(self):
        text = self.dts.nodes(SOC)
        for words in ('"verican,can-1.0", "fsl,ls1021ar2-flexcan"', "reg = <0xf0040000 0x1000>",
                      "interrupts = <5>", "clock-frequency = <50000000>"):
            self.assertIn(words, text)
        self.assertEqual(text.count("compatible"), 1)
        with self.assertRaisesRegex(ValueError, "no VeriCAN"):
            self.dts.nodes({"memories": {}, "constants": {}})
        self.compiles(text)

    def compiles(self, text):
        """dtc takes it."""
        done = subprocess.run(["dtc", "-@", "-I", "dts", "-O", "dtb", "-o", "/dev/null"],
                              input=text, text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_lines_of_the_guide_for_litexs_own_tool(self):
        """As they stand there, in a function with the names that LiteX' has."""
        guide = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        lines = re.search(r"^    from verican\.dts import node.*?\n\n", guide, re.DOTALL | re.M)[0]
        names = {"d": SOC, "dts": "", "generate_dts_intc": lambda d: "intc0"}
        exec(textwrap.dedent(lines), names)  # pylint: disable=exec-used
        self.assertEqual(names["dts"].count("can@f0040000"), 1)
        self.assertNotIn("main_ram", names["dts"])
        self.compiles("/dts-v1/;\n/ {\n intc0: i {};\n soc {\n" + names["dts"] + " };\n};\n")


class Imports(unittest.TestCase):
    """What the package needs beside it."""

    def test_it_needs_no_more_than_what_comes_with_litex(self):
        """setup.py of LiteX names migen and three that are not used here; no PyYAML."""
        allowed = {*sys.stdlib_module_names, "migen", "litex", "verican"}
        files = sorted((design.ROOT / "sw/litex/verican").glob("*.py"))
        self.assertGreaterEqual(len(files), 3)
        for path in files:
            for entry in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                names = [alias.name for alias in entry.names] if isinstance(entry, ast.Import) \
                    else [entry.module] if isinstance(entry, ast.ImportFrom) else []
                more = {name.split(".")[0] for name in names} - allowed
                self.assertEqual(more, set(), path.name)


class LiteX(unittest.TestCase):
    """LiteX itself."""

    def test_litex_elaborates_a_soc(self):
        folders = os.environ.get("LITEX")
        if not folders:
            self.skipTest("LITEX is not set: the module is tested beside a stand-in for LiteX")
        with tempfile.TemporaryDirectory() as name:
            shutil.copy(USER, Path(name) / "user.py")
            path = ":".join([str(design.ROOT / "sw/litex"), folders])
            code, text = design.run("/usr/bin/python3", "-B", "user.py", "build", cwd=name,
                                    env={**os.environ, "PYTHONPATH": path})
            self.assertEqual(code, 0, text)
            top, = Path(name).glob("build/**/*.v")
            self.assertRegex(top.read_text(encoding="utf-8"), r"\bcan_wb #\(")
            code, text = design.run("yosys", "-q", "-p", (
                f"read_verilog -sv {' '.join(design.rtl_files())}; read_verilog {top}; "
                f"hierarchy -check -top {top.stem}; proc; check -assert"))
            self.assertEqual(code, 0, re.sub(r"Warning: .*\n", "", text))
            csr, = Path(name).glob("build/csr.json")
            self.assertIn("controller0_verican",
                          json.loads(csr.read_text(encoding="utf-8"))["constants"])


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""can.core: what it says of the RTL is so, its targets work in a folder of their own as FuseSoC
runs them, and a design that depends on it keeps its own top and parameters. With FUSESOC=program
in the environment FuseSoC itself runs the same."""

import os
import re
import shlex
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

import design

sys.path.insert(0, str(design.ROOT / "tools"))
# ruff: noqa: E402  (the path must be set first)
import core_check
from pack import wrappers as source

# What Verilator writes is compiled in a third of the time so; the simulation takes a second.
FAST = "OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0"
CONDITION = re.compile(r"is_toplevel\? \((\w+)\)")
USER_CORE = """\
CAPI=2:
name: ::user:0
filesets:
  rtl: {files: [user_top.sv], file_type: systemVerilogSource, depend: ["verican:ip:can"]}
targets:
  default: {filesets: [rtl], toplevel: user_top}
  lint:
    filesets: [rtl]
    toplevel: user_top
    flow: lint
    flow_options: {tool: verilator, verilator_options: [-Wall]}
  sim:
    filesets: [rtl]
    toplevel: user_top
    flow: sim
    flow_options: {tool: icarus, iverilog_options: [-g2012]}
"""


def description():
    """can.core as YAML."""
    first, _, rest = (design.ROOT / "can.core").read_text(encoding="utf-8").partition("\n")
    if first != "CAPI=2:":
        raise AssertionError(f"can.core begins with {first}, not with CAPI=2:")
    return yaml.safe_load(rest)


def files_of(core):
    """Verilator's configuration files and the sources of the core, in their order."""
    waivers, sources = [], []
    for entry in core["filesets"]["rtl"]["files"]:
        if isinstance(entry, dict):
            (name, options), = entry.items()
            (waivers if options == {"file_type": "vlt"} else sources).append(name)
        else:
            sources.append(entry)
    return waivers, sources


def chosen(entries, is_toplevel):
    """A list of FuseSoC's with its conditions decided."""
    entries = [entries] if isinstance(entries, str) else entries
    names = []
    for entry in entries:
        condition = CONDITION.fullmatch(entry)
        if not condition:
            names.append(entry)
        elif is_toplevel:
            names.append(condition[1])
    return names


class CoreDescription(unittest.TestCase):
    """The file itself, and the tools' commands that it leads to."""

    maxDiff = None

    def setUp(self):
        self.core = description()
        self.waivers, self.sources = files_of(self.core)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = Path(folder.name)

    def export(self):
        """Copies the listed files, and nothing else, to where a tool will run."""
        for name in self.waivers + self.sources:
            target = self.work / "src/verican_ip_can" / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(design.ROOT / name, target)
        (self.work / "user_top.sv").write_text(design.user_top(), encoding="utf-8")

    def listed(self, names):
        return [f"src/verican_ip_can/{name}" for name in names]

    def lint(self, tops, parameters, *more):
        options = self.core["targets"]["lint"]["flow_options"]
        self.assertEqual(options["tool"], "verilator")
        command = ["verilator", "--lint-only", *options["verilator_options"]]
        command += [word for top in tops for word in ("--top-module", top)]
        command += [f"-G{name}={value}" for name, value in parameters.items()]
        return design.run(*command, *self.listed(self.waivers), *self.listed(self.sources), *more,
                          cwd=self.work)

    def test_files_are_those_of_the_list(self):
        self.assertEqual(self.sources, design.rtl_files())
        self.assertEqual(self.waivers, ["rtl/lint.vlt"])

    def test_version_is_the_projects(self):
        cmake = (design.ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"project\(verican VERSION ([\d.]+)", cmake)[1]
        self.assertEqual(self.core["name"], f"verican:ip:can:{version}")

    def test_licence_is_that_of_the_rtl(self):
        """PK-50; docs/integration.md says which FuseSoC knows the key."""
        top = (design.ROOT / "rtl/host/can_ahb.sv").read_text(encoding="utf-8")
        self.assertEqual(self.core.get("license"),
                         re.search(r"SPDX-License-Identifier: (\S+)", top)[1])
        page = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        self.assertIn("`license:`, so it needs FuseSoC 2.4.4 or newer", page)

    def test_parameters_are_those_of_the_top(self):
        """But those that not every tool takes as a number on its command line."""
        rtl = next(wrapper for wrapper in source.wrappers() if wrapper.bus == "ahb").parameters
        self.assertEqual(list(self.core["parameters"]),
                         [entry.name for entry in rtl if entry.width <= 32])
        text = (design.ROOT / "can.core").read_text(encoding="utf-8")
        for entry in rtl:
            if entry.width > 32:
                self.assertIn(f"{entry.name} is not here", text)
        for name, options in self.core["parameters"].items():
            kind = options["datatype"], options["paramtype"]
            self.assertEqual(kind, ("int", "vlogparam"), name)
            self.assertNotIn("default", options, "the RTL has the defaults")

    def test_it_is_as_fusesoc_wants_it(self):
        self.assertEqual(core_check.Check(design.ROOT).run(), [])

    def test_checker_sees_what_is_wrong(self):
        self.export()
        text = (design.ROOT / "can.core").read_text(encoding="utf-8")
        for old, new, what in (
                ("flow: lint", "flow: lnit", "unknown flow lnit"),
                ("rtl/can_core.sv", "rtl/can_cor.sv", "rtl/can_cor.sv: no such file"),
                ('"is_toplevel? (can_ahb)"', '"can_ahb"', "can_ahb holds in designs"),
                ("filesets: [rtl, smoke]", "filesets: [rtl, smok]", "no file set smok"),
                ("NumMb=16", "NumMb=x", "NumMb=x: no number"),
                ("paramtype: vlogparam", "paramtype: vlogparam\n    default: 1", "no key"),
                ('"is_toplevel? (Wake)"', '"is_toplevel? (Wak)"', "no parameter Wak")):
            self.assertIn(old, text)
            (self.work / "can.core").write_text(text.replace(old, new), encoding="utf-8")
            for name in ("rtl", "tb", "examples"):
                if not (self.work / name).exists():
                    (self.work / name).symlink_to(design.ROOT / name)
            self.assertIn(what, "\n".join(core_check.Check(self.work).run()))

    def test_simulation_passes_in_verilator(self):
        self.export()
        target = self.core["targets"]["sim"]
        options = target["flow_options"]
        self.assertEqual((options["tool"], options["mode"]), ("verilator", "binary"))
        for name in self.core["filesets"]["smoke"]["files"]:
            shutil.copy(design.ROOT / name, self.work)
        code, text = design.run(
            "verilator", "--binary", *options["verilator_options"], "-O0", "-MAKEFLAGS", FAST,
            "--Mdir", "obj",
            "--top-module", target["toplevel"], *self.listed(self.waivers),
            *self.listed(self.sources), *sorted(self.work.glob("*smoke*.v")), cwd=self.work)
        self.assertEqual(code, 0, text)
        code, text = design.run(self.work / "obj/Vcan_smoke")
        self.assertEqual((code, text.splitlines()[0]), (0, "smoke: passed"), text)

    def test_top_and_parameters_are_its_own(self):
        for name, target in self.core["targets"].items():
            if target["toplevel"] in ("can_smoke", "can_hx8k"):  # designs of their own
                continue
            self.assertEqual(chosen(target["toplevel"], True), ["can_ahb"], name)
            names = [entry.partition("=")[0] for entry in chosen(target["parameters"], True)]
            self.assertEqual(names, list(self.core["parameters"]))
            self.assertEqual(chosen(target["toplevel"], False), [], name)
            if name == "default":  # what a design that depends on the core gets
                self.assertEqual(chosen(target["parameters"], False), [])

    def test_profiles_are_those_of_the_file(self):
        """PK-45: a target of each kind sets what the profile names, and nothing else."""
        profiles = yaml.safe_load((design.ROOT / "sw/profiles.yaml").read_text(encoding="utf-8"))
        for name, profile in profiles["profiles"].items():
            for kind in ("lint", "synth_ice40"):
                target = self.core["targets"][f"{kind}_{name}"]
                values = dict(entry.split("=") for entry in target["parameters"] if "=" in entry)
                self.assertEqual({key: int(value) for key, value in values.items()},
                                 profile["parameters"], name)
                self.assertEqual(target["flow"], self.core["targets"][kind]["flow"])

    def test_board_target_is_what_the_script_builds(self):
        """As make hx8k: the same files and options. FuseSoC makes the bitstream (FUSESOC)."""
        self.export()
        target, files = self.core["targets"]["hx8k"], self.core["filesets"]["hx8k"]["files"]
        sources = [name for name in files if isinstance(name, str)]
        (pins, kind), = files[-1].items()
        self.assertEqual((pins, kind), ("examples/hx8k/hx8k.pcf", {"file_type": "PCF"}))
        script = " ".join((design.ROOT / "tools/hx8k.sh").read_text(encoding="utf-8").split())
        for words in (f"rtl+=({' '.join(sources)})", f"--pcf {pins}",
                      " ".join(target["flow_options"]["nextpnr_options"]),
                      f"-top {target['toplevel']}"):
            self.assertIn(words, script)
        (self.work / "examples").symlink_to(design.ROOT / "examples")
        self.assertEqual(design.run(
            "verilator", "--lint-only", "-Wall", "--top-module", target["toplevel"],
            *self.listed(self.waivers), *self.listed(self.sources),
            *sources, cwd=self.work), (0, ""))

    def test_lint_target_is_clean_elsewhere(self):
        self.export()
        follower = {"TimeUnit": 1, "TimeSync": 1, "SyncCtrl": 0x1F460131, "SyncId": 0x80000001,
                    "SyncDelay": 0xFFFFFF}
        for parameters in ({}, {"NumMb": 16}, follower):
            self.assertEqual(self.lint(["can_ahb"], parameters), (0, ""), parameters)
        code, text = self.lint(["can_ahb"], {"NumMb": 17})
        self.assertNotEqual(code, 0)
        self.assertIn("NumMb_must_be_16_32_or_64", text)

    def test_dependent_design_has_its_own_top(self):
        self.export()
        target = self.core["targets"]["default"]
        tops = chosen(target["toplevel"], False) + ["user_top"]
        parameters = dict.fromkeys(chosen(target["parameters"], False), 64)
        self.assertEqual(self.lint(tops, parameters, "user_top.sv"), (0, ""))

    def fusesoc(self, *words):
        program = os.environ.get("FUSESOC")
        if not program:
            self.skipTest("FUSESOC=program is not set: can.core is checked without FuseSoC")
        (self.work / "user.core").write_text(USER_CORE, encoding="utf-8")
        (self.work / "user_top.sv").write_text(design.user_top(), encoding="utf-8")
        shutil.copy(design.ROOT / "can.core", self.work)
        for folder in ("rtl", "tb", "examples"):
            (self.work / folder).symlink_to(design.ROOT / folder)
        code, text = design.run(*shlex.split(program), "--cores-root", ".", "run", *words,
                                cwd=self.work)
        self.assertEqual(code, 0, text)
        return text

    def test_fusesoc_lints_it(self):
        self.assertNotIn("Warning", self.fusesoc("--target", "lint", "verican:ip:can"))

    def test_fusesoc_takes_what_the_guide_says_of_its_options(self):
        guide = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        options = re.findall(r"`(--\w+=[^`]+)`", guide.split("## FuseSoC")[1].split("\n## ")[0])
        self.assertEqual(len(options), 2, options)
        self.fusesoc("--setup", "--target", "synth_ice40", "verican:ip:can", *options)
        script, = self.work.glob("build/**/edalize_yosys_procs.tcl")
        text = script.read_text(encoding="utf-8")
        self.assertIn("chparam -set SyncId 2147483649 ", text)
        self.assertRegex(text, "synth_ice40 .*-noabc9")

    def test_fusesoc_simulates_it(self):
        self.assertIn("smoke: passed", self.fusesoc("--target", "sim", "verican:ip:can"))

    def test_fusesoc_synthesises_it(self):
        self.assertIn("SB_RAM40", self.fusesoc("--target", "synth_ice40", "verican:ip:can"))

    def test_fusesoc_makes_the_boards_bitstream(self):
        self.fusesoc("--target", "hx8k", "verican:ip:can")
        image, = self.work.glob("build/**/*.bin")
        self.assertIn(bytes.fromhex("7EAA997E"), image.read_bytes()[:300])
        # Names differ, and so do the bits from those of make hx8k.
        self.assertGreater(image.stat().st_size, 100_000)

    def test_fusesoc_passes_a_parameter(self):
        self.fusesoc("--target", "lint", "verican:ip:can", "--NumMb", "16")
        files = list(self.work.glob("build/**/*.vc"))
        self.assertEqual(len(files), 1)
        self.assertIn("-GNumMb=16", files[0].read_text(encoding="utf-8"))

    def test_fusesoc_passes_a_profile(self):
        self.assertNotIn("Warning", self.fusesoc("--target", "lint_small", "verican:ip:can"))
        files = list(self.work.glob("build/**/*.vc"))
        self.assertEqual(len(files), 1)
        for value in ("-GNumMb=16", "-GExtras=0"):
            self.assertIn(value, files[0].read_text(encoding="utf-8"))

    def test_fusesoc_lints_a_design_that_depends_on_it(self):
        self.assertNotIn("Warning", self.fusesoc("--target", "lint", "::user:0"))

    def test_fusesoc_builds_a_simulation_that_depends_on_it(self):
        self.fusesoc("--setup", "--build", "--target", "sim", "::user:0")


if __name__ == "__main__":
    unittest.main()

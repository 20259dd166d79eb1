#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""usage: flat_file.py [BUS_SIZE ...]

A build of the core in one file of Verilog-2005 (wb_16): no tool has anything to say of it, it
passes the smoke bench, a design in another folder takes it, and its RAMs are found. `make dist`
runs all twelve, and proves that they equal their sources."""

import re
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import design

sys.path.insert(0, str(design.ROOT / "tools"))
sys.dont_write_bytecode = True
# ruff: noqa: E402  (the path must be set first)
from pack import flat, wrappers as source

BUILDS = sys.argv[1:] or ["wb_16"]
of_dist = unittest.skipUnless(sys.argv[1:], "minutes of proof, part of `make dist`")
USER = """\
module user_top (
{ports}
);
  {module} u_can (
{pins});
endmodule
"""


def modules(text):
    """The names of the modules in a file."""
    return re.findall(r"^module (\w+)", text, re.MULTILINE)


class FlatFile(unittest.TestCase):
    """Each of the builds asked for."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.out = Path(folder.name)
        code, text = design.run(design.ROOT / "tools/package.py", cls.out, "--flat", *BUILDS)
        if code != 0:
            raise AssertionError(text)
        by_bus = {wrapper.bus: wrapper for wrapper in source.wrappers()}
        cls.builds = [(by_bus[name.split("_")[0]], int(name.split("_")[1]),
                       cls.out / f"verilog/can_{name}.v") for name in BUILDS]

    def test_it_is_verilog_2005_without_a_warning(self):
        for _, _, file in self.builds:
            self.assertEqual(design.run("iverilog", "-g2005", "-Wall", "-o", "/dev/null", file),
                             (0, ""))
            self.assertNotRegex(file.read_text(encoding="utf-8"), r"\$paramod|enum_value|\bsrc =")

    def test_it_keeps_the_synchronisers_attributes(self):
        for _, _, file in self.builds:
            text = file.read_text(encoding="utf-8")
            for name in ("ASYNC_REG", "altera_attribute", "syn_preserve", "syn_encoding"):
                self.assertIn(f"(* {name} = ", text)

    def test_two_builds_fit_one_design(self):
        names = [modules(file.read_text(encoding="utf-8")) for _, _, file in self.builds]
        every = [name for build in names for name in build]
        self.assertEqual(len(every), len(set(every)))
        number = source.version().replace(".", "_")
        for (wrapper, size, _), build in zip(self.builds, names):
            end = rf"_{wrapper.bus}_{size}_{number}x*$"
            self.assertTrue(all(re.search(end, name) for name in build), build)

    def test_two_versions_fit_one_design(self):
        wrapper, size, file = self.builds[0]
        with tempfile.TemporaryDirectory() as work, \
                unittest.mock.patch.object(flat, "version", return_value="9.8.7"):
            other = modules(flat.render(wrapper, size, Path(work)))
        mine = modules(file.read_text(encoding="utf-8"))
        self.assertEqual(len(other), len(mine))
        self.assertEqual(set(other) & set(mine), set())

    def test_smoke_bench_passes(self):
        for wrapper, size, file in self.builds:
            others = [f"-DNO_{bus.upper()}" for bus in source.BUSES if bus != wrapper.bus]
            bench = sorted((design.ROOT / "tb/smoke").glob("*.v"))
            code, text = design.run(
                "iverilog", "-g2005-sv", "-s", "can_smoke", *others,
                f"-DCAN_{wrapper.bus.upper()}={flat.top(wrapper, size)}", "-o", self.out / "smoke",
                file, *bench)
            self.assertEqual((code, text), (0, ""))
            self.assertEqual(design.run("vvp", "-n", self.out / "smoke")[1].splitlines()[:1],
                             ["smoke: passed"])

    def test_a_design_elsewhere_takes_it(self):
        for wrapper, size, file in self.builds:
            ports = ",\n".join(
                f"  {port.direction} wire [{port.high}:{port.low}] {port.name}"
                for port in wrapper.ports)
            pins = ",\n".join(f"    .{port.name}({port.name})" for port in wrapper.ports)
            (self.out / "user_top.v").write_text(USER.format(
                ports=ports, pins=pins, module=flat.top(wrapper, size)), encoding="utf-8")
            code, text = design.run(
                "yosys", "-q", "-p", f"read_verilog user_top.v {file}; hierarchy -check -top "
                "user_top; proc; flatten; opt_clean; check -assert", cwd=self.out)
            self.assertEqual(code, 0, text)

    def memories(self, script):
        """Words and bits of the memories that Yosys finds."""
        code, text = design.run("yosys", "-p", f"{script}; flatten; opt_clean; memory -nomap; "
                                "write_rtlil")
        self.assertEqual(code, 0, text)
        cells = re.findall(r"cell \$mem_v2 .*?\n  end\n", text, re.DOTALL)
        return sorted((int(re.search(r"\\SIZE (\d+)", cell)[1]),
                       int(re.search(r"\\WIDTH (\d+)", cell)[1]),
                       len(re.findall(r"connect \\WR_EN", cell))) for cell in cells)

    def test_its_rams_are_found(self):
        for wrapper, size, file in self.builds:
            top = flat.top(wrapper, size)
            mine = self.memories(f"read_verilog {file}; hierarchy -check -top {top}; proc")
            self.assertEqual(mine, self.memories(flat.read_sources(wrapper, size)))
            self.assertEqual(len(mine), 3)
            self.assertTrue(all(width == 32 for _, width, _ in mine), mine)

    @of_dist
    def test_it_equals_its_sources(self):
        for wrapper, size, file in self.builds:
            with tempfile.TemporaryDirectory() as work:
                points = flat.prove(wrapper, size, file, Path(work))
            self.assertGreater(points, 1500)

    @of_dist
    def test_a_wrong_wire_into_a_ram_is_noticed(self):
        wrapper, size, file = self.builds[0]
        wrong, count = re.subn(r"(can_mb_ram_\w+ \w+ \([^;]*?\.wdata_i\()([^()]+)\)", r"\1~\2)",
                               file.read_text(encoding="utf-8"), count=1)
        self.assertEqual(count, 1)
        path = self.out / "wrong.v"
        path.write_text(wrong, encoding="utf-8")
        with tempfile.TemporaryDirectory() as work:
            self.assertRaisesRegex(flat.FlatError, "unproven", flat.prove, wrapper, size, path,
                                   Path(work))

    def test_ram_of_the_template_equals_the_sources(self):
        path = self.out / "ram.v"
        path.write_text(flat.RAM.format(name="gate", high=3, last=15), encoding="utf-8")
        code, text = design.run("yosys", "-q", "-p", (
            "read_verilog -sv rtl/mailbox/can_mb_ram.sv; hierarchy -top can_mb_ram -chparam Depth "
            "16; proc; memory; flatten; rename -top gold; design -stash gold; "
            f"read_verilog {path}; hierarchy -top gate; proc; memory; flatten; opt_clean; "
            "design -copy-from gold gold; equiv_make gold gate equiv; hierarchy -top equiv; "
            "async2sync; equiv_struct; equiv_simple; equiv_induct; equiv_status -assert"))
        self.assertEqual(code, 0, text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The mutator follows the RTL: it reads every file, finds both ways to build a module where models
have both, and its rewritten core is one that Verilator takes."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import models
from mutants import Design
from regression import FOLDERS, programs
from schemata import Wrap, open_types, package, rewrite


class Machinery(unittest.TestCase):
    """Without a build of test programs."""

    @classmethod
    def setUpClass(cls):
        cls.design = Design(models.rtl_files())

    def lines_of(self, module):
        """The text of the lines with mutants."""
        return {m.line_text for m in self.design.candidates() if m.module == module}

    def test_every_file_of_the_rtl_is_read(self):
        self.assertEqual([file.path for file in self.design.files], models.rtl_files())
        parts = [models.modules_of(part) for part in FOLDERS]
        self.assertEqual(sum(map(len, parts)), len(self.design.files), "each is of one part")
        self.assertEqual(set().union(*parts), {file.module for file in self.design.files})

    def test_wrappers_have_mutants_in_both_modes(self):
        lines = self.lines_of("can_wb")
        self.assertIn("assign wb_stall_o = !ready;", lines)
        self.assertIn("assign wb_stall_o = wb_cyc_i && !answer;", lines)

    def test_the_way_that_models_have_is_mutated(self):
        self.assertIn("count_q <= count_q + 1'b1;", self.lines_of("can_tq_gen"))
        self.assertNotIn("assign tq_o = 1'b1;", self.lines_of("can_tq_gen"))
        lines = self.lines_of("can_rx_frame")
        self.assertIn("assign in_ex_id = (field_i == can_pkg::FldExId);", lines)
        self.assertNotIn("assign byte_o = shift_q[7:0];", lines)

    def test_states_are_plain_vectors(self):
        for file in self.design.files:
            if "typedef enum" in file.text and not file.package:
                with self.subTest(file.module):
                    self.assertNotRegex(open_types(file.module, file.text),
                                        r"\bstate_\w +\w+[,;]")

    def test_what_nobody_reads_is_not_mutated(self):
        self.assertFalse([m.name for m in self.design.candidates()
                          if m.line_text.startswith("assign unused")])

    def test_mutants_that_the_page_names_are_there(self):
        """Names hold lines and columns, which move with the RTL."""
        page = (models.ROOT / "docs/mutation.md").read_text(encoding="utf-8")
        named = set(re.findall(r"\bcan_\w+:\d+\.\d+:\w\b", page))
        self.assertEqual(named - {m.name for m in self.design.candidates()}, set())

    def test_programs_that_a_build_with_mutants_leaves_out_are_not_run(self):
        text = (models.ROOT / "tb/CMakeLists.txt").read_text(encoding="utf-8")
        block = re.search(r"if\(VERICAN_RTL_TRANSFORM\)\n(.*?)endif", text, re.DOTALL)[1]
        left_out = set(re.findall(r"/(\w+_test)\\", block))
        self.assertTrue(left_out)
        for part in FOLDERS:
            self.assertFalse(left_out & {name for _, name in programs(models.ROOT, part)}, part)

    def test_verilator_takes_the_core_with_a_mutant_of_each_file(self):
        taken = {}
        for mutant in self.design.candidates():
            taken.setdefault(mutant.module, mutant)
        for number, mutant in enumerate(taken.values(), 1):
            mutant.number = number
        self.addCleanup(lambda: [setattr(m, "number", 0) for m in taken.values()])
        with tempfile.TemporaryDirectory() as name:
            path = Path(name) / "mutants.sv"
            path.write_text(package(len(taken)) + "\n".join(
                open_types(file.module, rewrite(file, Wrap())) for file in self.design.files),
                encoding="utf-8")
            for top in ("can_ahb", "can_apb", "can_axil", "can_wb", "can_remote"):
                done = subprocess.run(
                    ["verilator", "--lint-only", "-Wno-lint", "-Wno-style", "--top-module", top,
                     path], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""), top)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/coverage.py's machinery, on a module whose points are known (tiny.sv)."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [f"{ROOT}/tools", f"{ROOT}/cmake"]
sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
import coverage_model  # noqa: E402
from rtlcov import exclusions, points, report  # noqa: E402

FILE = "rtl/tiny.sv"
# Text of the line, kind, what: all points of tiny.sv but the clock's.
LINES = {
    ("function", "line", "block"), ("always_ff", "line", "block"), ("if (!rst_ni)", "branch", "if"),
    ("if (!rst_ni)", "branch", "else"), ("3'd0:", "line", "case"), ("3'd1: ", "line", "case"),
    ("default:", "line", "case"), ("if (in_i == 3'd1)", "branch", "if"),
    ("if (in_i == 3'd1)", "branch", "else")}
BITS = {"rst_ni", "in_i[0]", "in_i[1]", "in_i[2]", "state_q[0]", "state_q[1]", "seen_q"}
WAYS = {f"{bit}:{way}" for bit in BITS for way in ("0->1", "1->0")}


def build(work):
    """Verilates and compiles tiny, as cmake/verilate.cmake does it."""
    root = f"{work}/root"
    os.makedirs(f"{root}/rtl")
    shutil.copy(f"{HERE}/tiny.sv", f"{root}/rtl")
    share = subprocess.run(["verilator", "--getenv", "VERILATOR_ROOT"], check=True,
                           capture_output=True, text=True).stdout.strip() + "/include"
    subprocess.run(["verilator", "--cc", "-O3", "--x-initial", "fast", "--no-timing",
                    "--coverage-line", "--coverage-toggle", "--prefix", "Vtiny", "--Mdir",
                    f"{work}/model", f"{root}/{FILE}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([sys.executable, f"{ROOT}/cmake/coverage_model.py", f"{work}/model", "Vtiny",
                    root], check=True)
    # The model as one source: its headers are read once.
    with open(f"{work}/model.cpp", "w", encoding="utf-8") as whole:
        whole.writelines(f'#include "{f}"\n' for f in sorted(os.listdir(f"{work}/model"))
                         if f.endswith(".cpp"))
    subprocess.run(["c++", "-std=c++20", "-w", "-pthread", f"-I{work}/model", f"-I{share}",
                    f"-I{share}/vltstd", f"-I{ROOT}/cmake", "-o", f"{work}/tiny_run",
                    f"{HERE}/tiny_run.cpp", f"{ROOT}/cmake/coverage_writer.cpp",
                    f"{share}/verilated.cpp", f"{share}/verilated_threads.cpp",
                    f"{work}/model.cpp"],
                   check=True)
    return root


class Machinery(unittest.TestCase):
    """Counts of a run, and what the report makes of them."""

    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.work)
        cls.root = build(cls.work)
        with open(f"{HERE}/tiny.sv", encoding="utf-8") as file:
            cls.source = file.read().splitlines()

    def run_tiny(self, *runs):
        """Counts of processes with these inputs, merged."""
        out = tempfile.mkdtemp(dir=self.work)
        for inputs in runs:
            subprocess.run([f"{self.work}/tiny_run", *map(str, inputs)], check=True,
                           env=os.environ | {"VERICAN_COVERAGE_DIR": out})
        files = [f"{out}/{name}" for name in os.listdir(out)]
        self.assertEqual(len(files), len(runs), "one file for each process")
        self.merged_by_verilator(files, out)
        return points.read_counts(files)

    def merged_by_verilator(self, files, out):
        subprocess.run(["verilator_coverage", "--write", f"{out}/merged", *files], check=True,
                       stdout=subprocess.DEVNULL)
        ours, theirs = points.read_counts(files), points.read_counts([f"{out}/merged"])
        self.assertEqual({p: n for p, n in ours.items() if n},
                         {p: n for p, n in theirs.items() if n})

    def named(self, counts, hit):
        """The points that were hit (or not): texts of lines, and toggles."""
        lines, toggles = set(), set()
        for point, count in counts.items():
            self.assertEqual(point.file, FILE)
            if (count > 0) != hit:
                continue
            if point.kind == "toggle":
                toggles.add(point.what)
            else:
                text = self.source[point.line - 1]
                lines |= {key for key in LINES if key[0] in text
                          and key[1:] == (point.kind, point.what)}
        return lines, toggles

    def test_all_points_are_there(self):
        counts = self.run_tiny([])
        hit, missed = self.named(counts, True), self.named(counts, False)
        self.assertEqual(hit[0] | missed[0], LINES)
        self.assertEqual(hit[1] | missed[1], WAYS)
        self.assertEqual(len(counts), len(LINES) + len(WAYS))

    def test_hit_is_what_was_driven(self):
        # state_q 2 (reset) 0 | 2 (reset) 0 1 0: bit 1 falls twice and never rises, for what the
        # reset does is not counted; seen_q falls.
        counts = self.run_tiny([0, 1, 0])
        lines, toggles = self.named(counts, True)
        self.assertEqual(LINES - lines, {("default:", "line", "case"),
                                         ("function", "line", "block")})
        self.assertEqual(toggles, {"rst_ni:0->1", "in_i[0]:0->1", "in_i[0]:1->0",
                                   "state_q[0]:0->1", "state_q[0]:1->0", "state_q[1]:1->0",
                                   "seen_q:1->0"})
        by_what = {p.what: n for p, n in counts.items() if p.kind == "toggle"}
        self.assertEqual(by_what["state_q[1]:1->0"], 2, "both instances count")
        self.assertEqual(by_what["rst_ni:0->1"], 2)

    def test_every_top_has_a_reset_that_is_known(self):
        # What its reset does is not counted; "VL_IN8(&name," is a port of a Verilated model.
        for top, name in (("host/can_ahb", "hresetn"), ("host/can_apb", "presetn"),
                          ("host/can_axil", "aresetn"), ("can_core", "rst_ni"),
                          ("remote/can_remote", "rst_ni"), ("time/can_time_node", "rst_ni")):
            with open(f"{ROOT}/rtl/{top}.sv", encoding="utf-8") as file:
                self.assertRegex(file.read(), rf"input\s+logic\s+{name}\b")
            self.assertEqual(coverage_model.armed(f"VL_IN8(&clk,0,0);\nVL_IN8(&{name},0,0);"),
                             f"vlSelf->{name}")
        self.assertEqual(coverage_model.armed("VL_IN8(&wb_rst_i,0,0);"), "!vlSelf->wb_rst_i")
        self.assertEqual(coverage_model.armed("VL_IN8(&clk_i,0,0);"), "1")

    def test_processes_add_up(self):
        lines, toggles = self.named(self.run_tiny([0, 1, 0], [5, 2, 0, 3]), True)
        self.assertEqual(lines, LINES)
        self.assertEqual(toggles, WAYS - {"rst_ni:1->0", "seen_q:0->1"})

    def test_report_counts_what_is_reachable(self):
        counts = self.run_tiny([0, 1, 0], [5, 2, 0, 3])
        entries = [exclusions.Exclusion(FILE, {"because": "constant", "reason": "never set again",
                                               "toggle": "seen_q:0->1"})]
        self.assertEqual(exclusions.apply(entries, counts, self.root), [])
        files = report.tally(counts, set(entries[0].points))
        self.assertEqual(files[FILE]["toggle"], [12, 13, 1])
        self.assertEqual(files[FILE]["line"], [5, 5, 0])
        self.assertEqual(report.missed(counts, set(entries[0].points)),
                         [f"{FILE}:15: toggle rst_ni:1->0"])
        figures = {f["name"]: f for f in report.figures(files, entries, True)}
        self.assertFalse(figures["RTL toggle coverage"]["ok"], "12 of 13 is below the bar")
        self.assertTrue(figures["RTL line coverage"]["ok"])

    def test_wrong_exclusions_are_refused(self):
        counts = self.run_tiny([0, 1, 0])
        entry = {"because": "constant", "reason": "a claim"}

        def problems(**more):
            return exclusions.apply([exclusions.Exclusion(FILE, entry | more)], counts, self.root)

        self.assertIn("was hit", problems(toggle="in_i[0]")[0])
        self.assertIn("was hit", problems(at="3'd0:")[0])
        self.assertEqual(problems(at="default:"), [])
        self.assertEqual(problems(toggle="in_i[2:1]"), [])
        self.assertIn("excludes nothing", problems(toggle="no_such_signal")[0])
        for bad in ({"at": "3'd"}, {"toggle": "in_i", "wrong": 1}, {}, {"at": "x", "because": "y"}):
            with self.assertRaises(points.CoverageError):
                problems(**bad)

    def test_the_projects_exclusions_name_what_exists(self):
        # That they are not hit is seen by the campaign; that they are about this RTL, here.
        for entry in exclusions.load(f"{ROOT}/tb/coverage/exclusions.yaml"):
            with open(f"{ROOT}/{entry.file}", encoding="utf-8") as file:
                text = file.read()
            if entry.at:
                self.assertEqual(text.count(entry.at), 1, entry.name())
            for signal in entry.toggle:
                name = re.match(r"\w+", signal.pattern)[0]
                self.assertRegex(text, rf"\b{name}\b", entry.name())

    def test_other_files_are_refused(self):
        path = f"{self.work}/no.dat"
        for text in ("", "hello\n", "# SystemC::Coverage-3\nC 'x' y\n",
                     "# SystemC::Coverage-3\nC '\1f\2rtl/tiny.sv' 1\n"):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            with self.assertRaises(points.CoverageError):
                points.read_counts([path])


if __name__ == "__main__":
    unittest.main()

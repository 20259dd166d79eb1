#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The runner itself: a false property and a mutant that changes nothing must fail, and mistakes in
a catalogue or on the command line get one line that says what is wrong."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUN = Path(__file__).resolve().parent / "run.py"
PROPERTY = """
  always @(posedge clk_i) begin
    m_reset: assume (rst_ni == !$initstate);
    // BT-06: text
    p_it: assert (!rst_ni || $initstate || {condition});
  end
"""
PROOF = """
proofs:
  - name: sync
    title: t
    top: can_sync
    rtl: [bit/can_sync.sv]
    splice: {{can_sync: sync.sv}}
    method: {method}
    {more}
    mutants:
      - {{name: m, file: bit/can_sync.sv, old: "{old}", new: "{new}", breaks: [p_it]}}
"""
TRUE = "rx_o == $past(meta_q) || !$past(rst_ni)"
GOOD = {"method": "pdr", "more": "quick: true",
        "old": "{meta_q, can_rx_i}", "new": "{can_rx_i, meta_q}"}


class Runner(unittest.TestCase):
    """Each case writes its own catalogue."""

    def run_it(self, condition=TRUE, options=("--mutants",), **changes):
        """Runs run.py on a catalogue of one proof; returns (exit code, output)."""
        with tempfile.TemporaryDirectory() as name:
            part = Path(name) / "part"
            part.mkdir()
            (part / "sync.sv").write_text(PROPERTY.format(condition=condition).replace("{{", "{"),
                                          encoding="utf-8")
            (part / "proofs.yaml").write_text(PROOF.format(**{**GOOD, **changes}), encoding="utf-8")
            run = subprocess.run([sys.executable, RUN, "--catalogue", name, "--scratch",
                                  f"{name}/scratch", "--jobs", "1", *options], text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
            return run.returncode, run.stdout

    def test_true_property_passes_with_each_method(self):
        """pdr, induction and both kinds of bounded search agree."""
        for method, more in (("pdr", ""), ("induction", "depth: 2"), ("bounded", "depth: 5"),
                             ("bounded", "{depth: 5}")):
            more = "depth: 5\n    solver: abc" if more.startswith("{") else more
            code, text = self.run_it(method=method, more=more)
            self.assertEqual(code, 0, text)

    def test_false_property_is_refuted_with_each_method(self):
        """A wrong statement never counts as proven."""
        for method, more in (("pdr", ""), ("induction", "depth: 2"), ("bounded", "depth: 5")):
            code, text = self.run_it("rx_o == can_rx_i", method=method, more=more)
            self.assertEqual(code, 1, text)
            self.assertIn("REFUTED", text)

    def test_mutant_without_effect_is_not_caught(self):
        """A mutant has to break its property."""
        code, text = self.run_it(new="{meta_q, can_rx_i && 1'b1}")
        self.assertEqual(code, 1, text)
        self.assertIn("mutant m: not refuted: p_it", text)

    def test_mistakes_get_one_line(self):
        """Catalogue and command line."""
        for changes, want in (({"method": "magic"}, "'method' is 'magic', allowed:"),
                              ({"more": "colour: red"}, "unknown key 'colour'"),
                              ({"options": ("--only", "part.no")}, "no such proof"),
                              ({"options": ("--scale", "0")}, "allowed: above 0"),
                              ({"options": ("--jobs", "0")}, "allowed: 1 to 64")):
            code, text = self.run_it(**changes)
            self.assertEqual(code, 2, text)
            self.assertIn(want, text)
        code, text = self.run_it(old="not there")
        self.assertEqual(code, 1, text)
        self.assertIn("stands 0 times", text)


if __name__ == "__main__":
    unittest.main()

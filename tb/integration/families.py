#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""make synth FAMILY=...: a block of the engine in one family by npm's Yosys, installed from the
lock file; the page is what the results say; bad names are told. VERICAN_FAMILIES=node_modules: what
the build has fetched."""

import json
import os
import sys
import unittest
import unittest.mock
from pathlib import Path

import design

sys.path.insert(0, str(design.ROOT / "tools"))
sys.dont_write_bytecode = True
# ruff: noqa: E402  (the path must be set first)
import families
from synth.families_page import render


class Families(unittest.TestCase):
    """What tools/families.py does."""

    def test_tool_is_pinned(self):
        lock = json.loads((families.FOLDER / "package-lock.json").read_text(encoding="utf-8"))
        entry = lock["packages"]["node_modules/@yowasp/yosys"]
        self.assertEqual(entry["version"], "0.55.944")
        self.assertRegex(entry["integrity"], "^sha512-")

    def test_one_family_is_measured(self):
        entry = families.families()["ecp5"]
        modules = families.packages(os.environ.get("VERICAN_FAMILIES"))
        # A block of the engine: the engine whole takes as long as all else here.
        with unittest.mock.patch.object(families, "settings", return_value=("can_fault", [])):
            found = families.measure(entry, "core", modules)
        self.assertEqual((found["ram"], found["lut_ram"]), (0, 0))
        self.assertEqual(found["ff"], self.flip_flops())
        self.assertGreater(found["lut"], 20)

    def flip_flops(self):
        """Of that block, as another Yosys counts them before any mapping."""
        code, text = design.run(
            "yosys", "-q", "-f", "verilog -sv", *design.rtl_files(), "-p",
            "hierarchy -top can_fault; proc; flatten; opt -full; opt_dff; wreduce; "
            "opt_clean -purge; simplemap t:$adff t:$adffe t:$dff t:$dffe; opt_clean; "
            "tee -a /dev/stdout stat -tech cmos")
        self.assertEqual(code, 0, text)
        return sum(int(line.split()[1]) for line in text.splitlines()
                   if line.strip().startswith("$_DFF"))

    def test_page_is_what_the_results_say(self):
        self.assertEqual(families.PAGE.read_text(encoding="utf-8"),
                         render(families.families(), families.load()))

    def test_another_state_of_the_rtl_is_told(self):
        """What make lint mentions and make dist refuses."""
        known, results = families.families(), {}
        for name, entry in known.items():
            results[name] = {"state": families.state(entry),
                             "builds": dict.fromkeys(families.BUILDS, {})}
        self.assertEqual(families.stale(known, results), [])
        results["ecp5"]["state"] = "0123456789ab"
        del results["gowin"]["builds"]["small"], results["xilinx"]
        self.assertEqual(families.stale(known, results), ["ecp5", "gowin", "xilinx"])

    def test_only_what_is_measured_counts(self):
        """A node without a processor or a bus wrapper more leaves the page as it is."""
        files = {"top": "unit u; part p;", "unit": "pkg::Width", "pkg": "", "part": "",
                 "other": "top t; unit u;", "apart": "unit u;"}
        self.assertEqual(families.used({"top"}, files), ["part", "pkg", "top", "unit"])
        used = families.used({"can_core", "can_ahb"}, families.modules())
        self.assertLess({"can_pkg", "can_regs_pkg", "can_mb_ram", "can_crc15", "can_time"},
                        set(used))
        self.assertFalse({"can_remote", "can_rn_step", "can_apb", "can_wb"} & set(used))

    def test_comments_do_not_count(self):
        """A figure does not go stale with a comment, nor is a module measured that one names."""
        self.assertEqual(families.code("unit u;  // see other\n/* top\nt */ part p;\n"),
                         "unit u; part p;")

    def test_unknown_family_is_told(self):
        code, text = design.run("tools/families.py", "stratix")
        self.assertEqual(code, 1)
        self.assertIn("no family stratix; there are all, ice40", text)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Each feature of the core can be left out alone, and a profile's together: no warning, and no
block, flip-flop or RAM of what is not there (PK-43)."""

import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

import yaml

import design

# What instances a feature brings, by the end of their names.
BLOCKS = {"Fifo": ("can_mb_filter", "can_rx_fifo"), "Abort": ("can_mb_guard",),
          "Status": ("can_mb_status",), "OwnMasks": (), "Wake": ("can_wake",), "Extras": (),
          "ClearRam": (), "TimeUnit": ("can_time_cmp", "can_time_regs", "can_mb_stamp"),
          "TimeSync": ("can_time_sync", "can_time_sync_regs")}
# What the netlist of a core of 16 buffers has less, at least, without the features that have no
# block: bits of flip-flops, RAMs. The masks that OwnMasks = 0 leaves need as many flip-flops as the
# scan of the third RAM did.
LESS = {"OwnMasks": (0, 1), "Extras": (23, 0), "ClearRam": (7, 0)}
# Features that a core has not unless it is asked for them.
ASKED_FOR = ("TimeUnit", "TimeSync")


def settings(*arguments):
    """The builds that tools/profiles.py lists, as dictionaries."""
    text = subprocess.run([sys.executable, design.ROOT / "tools/profiles.py", *arguments],
                          check=True, capture_output=True, text=True).stdout
    return [dict(word.split("=") for word in line.split() if "=" in word)
            for line in text.splitlines()]


def verilator(*options, parameters, top="can_ahb"):
    """A run of Verilator over the core with these parameters: status and text."""
    files = [str(design.ROOT / name) for name in ["rtl/lint.vlt", *design.rtl_files()]]
    values = [f"-G{name}={value}" for name, value in parameters.items()]
    return design.run("verilator", *options, "-Wall", "--top-module", top, *values, *files)


def lint(parameters, top="can_ahb"):
    """What Verilator says of a build of `top`: status and text."""
    return verilator("--lint-only", parameters=parameters, top=top)


def modules(parameters):
    """The names of the modules that a build of can_ahb consists of."""
    with tempfile.TemporaryDirectory() as name:
        tree = Path(name) / "tree.xml"
        code, text = verilator("--xml-only", "--xml-output", tree, parameters=parameters)
        if code != 0:
            raise AssertionError(text)
        return {module.get("origName") for module in ET.parse(tree).iter("module")}


def storage(builds):
    """(bits of flip-flops, RAMs) of netlists of can_ahb with these parameters."""
    with tempfile.TemporaryDirectory() as name:
        design.read_once(design.rtl_files(), [
            "hierarchy -top can_ahb "
            + " ".join(f"-chparam {key} {value}" for key, value in build.items())
            + "; proc; flatten; opt -full; simplemap t:$*dff*; opt_clean; "
            f"tee -q -o {name}/{i} stat" for i, build in enumerate(builds)])
        return [counts((Path(name) / str(i)).read_text(encoding="utf-8"))
                for i in range(len(builds))]


def counts(text):
    """(bits of flip-flops, RAMs) that Yosys' `stat` has counted."""
    return (sum(map(int, re.findall(r"\$_\w*DFF\w*_ +(\d+)", text))),
            int(re.search(r"Number of memories: +(\d+)", text)[1]))


def documented(text):
    """The parameters of a profile, as its row in docs/integration.md has them."""
    parameters = {"NumMb": int(text.split()[0])}
    if "all features 0" in text:
        return parameters | {name: 0 for name in BLOCKS if name not in ASKED_FOR}
    zeros = re.search(r", ((?:`\w+` = )+)0$", text)
    return parameters | {name: 0 for name in re.findall(r"`(\w+)`", zeros[1] if zeros else "")}


class Features(unittest.TestCase):
    def test_builds_without_a_feature_are_clean(self):
        features = settings("--features")
        self.assertEqual([next(iter(one)) for one in features], list(BLOCKS))
        for parameters in features:
            with self.subTest(parameters):
                self.assertEqual(lint(parameters), (0, ""))

    def test_profiles_are_clean(self):
        profiles = settings()
        self.assertEqual(len(profiles), 3)
        for parameters in profiles:
            with self.subTest(parameters):
                self.assertEqual(lint(parameters), (0, ""))

    def test_blocks_of_a_feature_are_not_there_without_it(self):
        for parameters in [{}, *settings("--features"), *settings()]:
            there = modules(parameters)
            for feature, blocks in BLOCKS.items():
                for block in blocks:
                    with self.subTest(parameters, block=block):
                        default = "0" if feature in ASKED_FOR else "1"
                        self.assertEqual(block in there,
                                         parameters.get(feature, default) == "1")

    def test_registers_of_a_feature_are_not_there_without_it(self):
        """PK-43, PK-44: for those that are no block."""
        self.assertEqual(list(LESS), [feature for feature, blocks in BLOCKS.items() if not blocks])
        full, *without = storage([{"NumMb": 16}] + [{"NumMb": 16, name: 0} for name in LESS])
        for (feature, less), (flops, rams) in zip(LESS.items(), without):
            with self.subTest(feature):
                self.assertGreaterEqual(full[0] - flops, less[0])
                self.assertEqual(full[1] - rams, less[1])

    def test_page_has_the_profiles_as_they_are(self):
        """PK-45: the table of docs/integration.md."""
        page = (design.ROOT / "docs/integration.md").read_text(encoding="utf-8")
        rows = dict(re.findall(r"^\| (\w+) \| (\d+ buffers, [^|]*) \|", page, re.MULTILINE))
        profiles = yaml.safe_load((design.ROOT / "sw/profiles.yaml").read_text(encoding="utf-8"))
        self.assertEqual({name: documented(text) for name, text in rows.items()},
                         {name: profile["parameters"]
                          for name, profile in profiles["profiles"].items()})

    def refused(self, top, tried, base=None):
        """Each parameter of `tried` is named at each of its values. They do not depend on each
        other, so one run tries a value of each; who has no more keeps its last."""
        for turn in range(max(map(len, tried.values()))):
            values = {name: bad[min(turn, len(bad) - 1)] for name, bad in tried.items()}
            with self.subTest(top, values=values):
                code, text = lint({**(base or {}), **values}, top)
                self.assertNotEqual(code, 0)
                for name in values:
                    self.assertIn(f"{name}_must_be", text)

    def test_other_values_are_refused(self):
        code, text = lint({"Fifo": 2})
        self.assertNotEqual(code, 0)
        self.assertIn("must_be_0_or_1", text)

    def test_delay_of_more_than_its_register_is_refused(self):
        """TM-100: TSDLY has 24 bits."""
        most = {"TimeUnit": 1, "TimeSync": 1, "SyncDelay": (1 << 24) - 1}
        self.assertEqual(lint(most), (0, ""))
        code, text = lint({**most, "SyncDelay": 1 << 24})
        self.assertNotEqual(code, 0)
        self.assertIn("SyncDelay_must_be_24_bits", text)

    def test_node_without_a_processor_refuses_what_its_clock_cannot_be(self):
        """TM-106, TM-107: each parameter just outside its range; in it, it is clean."""
        self.assertEqual(lint({"TimeSync": 1}, "can_remote"), (0, ""))
        self.refused("can_remote", {"TimeSync": [2]})
        self.refused("can_remote", {"TimeInc": [0]}, {"TimeSync": 1})
        self.refused("can_remote", {"HalfPeriod": [-1, 1999], "SyncId": [1, 1 << 29],
                                    "SyncDelay": [1 << 24], "SyncCtrl": [0x1F410100]},
                     {"TimeSync": 1})
        self.assertEqual(lint({"TimeSync": 1, "HalfPeriod": 2000}, "can_remote"), (0, ""))

    def test_clock_without_a_processor_refuses_what_its_registers_cannot_hold(self):
        """TM-100: each parameter just outside its range."""
        self.refused("can_time_node", {"TimeInc": [0]})
        self.refused("can_time_node", {
            "HalfPeriod": [-1, 319], "SyncDelay": [1 << 24],
            "SyncId": [1, 0x20000, 1 << 29, 0xC000_0000], "SyncCtrl": [0x1F620100, 0x1F200100]})

    def test_clock_without_a_processor_takes_what_its_registers_can_hold(self):
        """TM-100: KD = KI; the largest base identifier, and an extended one."""
        for value in ({"SyncCtrl": 0x1F630100}, {"SyncId": 0x1FFC0000}, {"SyncId": 0x80000001}):
            with self.subTest(value):
                self.assertEqual(lint(value, "can_time_node"), (0, ""))

    def test_follower_refuses_what_it_cannot_follow(self):
        """TM-100, TM-103: values of TSCTRL and TSID after a reset, and a clock that stands."""
        follower = {"TimeUnit": 1, "TimeSync": 1}
        self.refused("can_ahb", {"SyncId": [1], "SyncCtrl": [0x1F200100], "TimeInc": [0]}, follower)

    def test_switches_of_the_buses_are_0_or_1(self):
        for top, name in (("can_ahb", "CheckHprot"), ("can_apb", "CheckProt"),
                          ("can_axil", "CheckProt"), ("can_wb", "Pipelined")):
            for value in (-1, 2, 3):
                with self.subTest(top, value=value):
                    code, text = lint({name: value}, top)
                    self.assertNotEqual(code, 0)
                    self.assertIn(f"{name}_must_be_0_or_1", text)
            self.assertEqual(lint({name: 1}, top), (0, ""))

    def test_clock_without_a_processor_refuses_pulses_faster_than_its_compare_unit(self):
        """TM-31: 16 clocks, to the ns: of 20 ns, of 62.5 ns, and of the longest there are."""
        for inc, least in (("40'h14_0000_0000", 320), ("40'h3E_8000_0000", 1000),
                           ("40'h3E_8000_0001", 1001), ("40'hFF_FFFF_FFFF", 4096)):
            with self.subTest(inc):
                value = {"TimeInc": inc, "HalfPeriod": least}
                self.assertEqual(lint(value, "can_time_node"), (0, ""))
                code, text = lint({**value, "HalfPeriod": least - 1}, "can_time_node")
                self.assertNotEqual(code, 0)
                self.assertIn("HalfPeriod_must_be", text)

    def test_nodes_without_a_processor_refuse_a_timing_that_cannot_be(self):
        """BT-02: each parameter just outside its range, and a bit of seven clocks."""
        for top in ("can_time_node", "can_remote"):
            self.refused(top, {"Brp": [0, 257], "Prop": [0, 9], "Ps1": [0, 9], "Ps2": [0, 9],
                               "Sjw": [0, 5]})
            with self.subTest(top):
                code, text = lint({"Brp": 1, "Prop": 1, "Ps1": 3, "Ps2": 2}, top)
                self.assertNotEqual(code, 0)
                self.assertIn("Bit_must_have_8_clocks", text)
                self.assertEqual(
                    lint({"Brp": 256, "Prop": 8, "Ps1": 8, "Ps2": 8, "Sjw": 4}, top), (0, ""))

    def test_node_without_a_processor_refuses_other_options(self):
        """remote-node.md, parameters: each just outside what it can be."""
        switches = dict.fromkeys(("Protect", "Block", "AutoRate", "Counters", "SameId", "Trace"),
                                 [-1, 2])
        self.refused("can_remote", {
            **switches, "NameBits": [2, 4, 6], "MemBytes": [512, 3072, 8192],
            "StageBytes": [-8, 4, 32], "TxDepth": [0, 2, 8], "NumProd": [-4, 2, 16],
            "NumMap": [-4, 2, 16], "RateRows": [0, 16]})
        self.refused("can_remote", {"ClocksPerMs": [7999, 131072]})

    def test_nodes_without_a_processor_refuse_jumps_beyond_a_phase_segment(self):
        """BT-03: the shorter of both is the limit."""
        for top in ("can_time_node", "can_remote"):
            for first, second in ((2, 4), (4, 2)):
                timing = {"Prop": 4, "Ps1": first, "Ps2": second}
                with self.subTest(top, **timing):
                    self.assertEqual(lint({**timing, "Sjw": 2}, top), (0, ""))
                    code, text = lint({**timing, "Sjw": 3}, top)
                    self.assertNotEqual(code, 0)
                    self.assertIn("Sjw_must_be_at_most_Ps1_and_Ps2", text)

    def test_engine_refuses_widths_that_hold_no_bit(self):
        """BT-02: PHASE_SEG2 of 8 quanta, and 16 before the sample point, are the longest."""
        for width in (2, 6):
            code, text = lint({"PosWidth": width}, "can_core")
            self.assertNotEqual(code, 0)
            self.assertIn("PosWidth_must_be_3_to_5", text)
        for width in (3, 5):
            self.assertEqual(lint({"PosWidth": width}, "can_core"), (0, ""))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""can_hx8k holds the core in the profile that its pages name, with all else at the defaults of the
wrapper, at the clock that its program takes it to have, and on pins of its constraints (PK-75)."""

import json
import re
import tempfile
import unittest
from pathlib import Path

import yaml

import design

FOLDER = design.ROOT / "examples/hx8k"
SOURCES = [FOLDER / "serial_apb.sv", FOLDER / "can_hx8k.sv"]
# What the board sets beside the profile: the serial port has addresses of 32 bits.
OWN = {"RegionBits": 32}


def elaborated():
    """module -> what Yosys makes of the board, around a black box of the core."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "board.json"
        code, text = design.run(
            "yosys", "-q", "-f", "verilog -sv", *design.rtl_files(), *SOURCES, "-p",
            f"blackbox can_top; hierarchy -check -top can_hx8k; proc; write_json {path}")
        if code != 0:
            raise AssertionError(text)
        return json.loads(path.read_text(encoding="utf-8"))["modules"]


def values(module):
    """The parameters that a module was elaborated with."""
    return {name: int(bits, 2) for name, bits in module["parameter_default_values"].items()}


class Board(unittest.TestCase):
    """By its elaborated netlist."""

    def setUp(self):
        self.modules = elaborated()
        self.top = self.modules["can_hx8k"]

    def test_core_has_the_profile_standard(self):
        text = (design.ROOT / "sw/profiles.yaml").read_text(encoding="utf-8")
        profile = yaml.safe_load(text)["profiles"]["standard"]["parameters"]
        wrapper = (design.ROOT / "rtl/host/can_apb.sv").read_text(encoding="utf-8")
        defaults = dict(re.findall(r"parameter int (\w+) = (\d+)", wrapper))
        seen = values(self.modules[self.top["cells"]["u_can"]["type"]])
        for name, value in {**{k: int(v) for k, v in defaults.items()}, **profile, **OWN}.items():
            self.assertEqual(seen[name], value, name)

    def test_rates_are_those_of_the_oscillator(self):
        program = (FOLDER / "node.c").read_text(encoding="utf-8")
        clock = int(re.search(r"CLOCK_HZ (\d+)u", program)[1])
        script = (design.ROOT / "tools/hx8k.sh").read_text(encoding="utf-8")
        self.assertIn(f"--freq {clock // 1_000_000} ", script)
        board = values(self.top)
        self.assertLess(abs(clock / board["BitClocks"] / 115_200 - 1), 0.01)
        self.assertEqual(board["Silence"] / clock, 0.1)

    def test_every_port_has_its_pin(self):
        pins = re.findall(r"^set_io (?:-pullup yes )?(\w+)(?:\[(\d+)\])? (\w+)$",
                          (FOLDER / "hx8k.pcf").read_text(encoding="utf-8"), re.MULTILINE)
        bits = {(name, str(at) if len(port["bits"]) > 1 else "")
                for name, port in self.top["ports"].items() for at in range(len(port["bits"]))}
        self.assertEqual({(name, at) for name, at, _ in pins}, bits)
        self.assertEqual(len({pin for *_, pin in pins}), len(bits), "a pin has two ports")


if __name__ == "__main__":
    unittest.main()

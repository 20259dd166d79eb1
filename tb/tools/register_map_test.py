#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Mistakes in sw/registers.yaml are told with their place and what is allowed: a value of another
kind at each kind of place, and a table of what is said of some."""
import copy
import sys
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools")]
sys.dont_write_bytecode = True
# pylint: disable=wrong-import-position
import registers
from regmap import model

SOURCE = yaml.safe_load((ROOT / "sw/registers.yaml").read_text(encoding="utf-8"))
OTHERS = (None, "x", -1, 3.5, [], {}, ["x"], {"x": 1}, True, 10**12)
MCR, FIELD = ("registers", 0), ("registers", 0, "fields", 1)
# Place of a value, what is there instead, and what is said of it.
TABLE = (
    ((*MCR, "offset"), "0x4", "registers: MCR: offset is '0x4'; expected: a whole number"),
    ((*MCR, "fields"), None, "registers: MCR: fields is None; expected: a list of at least one"),
    ((*MCR, "name"), 3, "registers: name is 3; expected: text"),
    ((*FIELD, "reset"), "x",
     "registers: MCR FRZ: reset is 'x'; expected: a whole number, or NumMb"),
    ((*FIELD, "reset"), 2, "registers: MCR FRZ: reset 0x2 does not fit into bits 30"),
    ((*FIELD, "live"), "yes", "registers: MCR FRZ: live is 'yes'; expected: true or false"),
    ((*FIELD, "bits"), "3:40", "registers: MCR FRZ: bits '3:40' are not within 31:0"),
    (MCR, 7, "registers: keys are expected here, not 7"),
    (("registers",), SOURCE["registers"][:1], "registers: XCONFIG is missing"),
    (("fifo", "depth"), -1, "fifo: depth is -1; expected: a whole number"),
    ((), [], "map: keys are expected here, not []"),
)


def with_value(place, value):
    """The map with another value at a place, a path of keys and indices."""
    if not place:
        return value
    changed = copy.deepcopy(SOURCE)
    inner = changed
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value
    return changed


def kinds_of_places(node, place=()):
    """{names of the keys on the way: one such place}."""
    found = {tuple(key for key in place if isinstance(key, str)) + (type(node).__name__,): place}
    entries = node.items() if isinstance(node, dict) else \
        enumerate(node) if isinstance(node, list) else ()
    for key, inner in entries:
        found = kinds_of_places(inner, (*place, key)) | found
    return found


class RegisterMap(unittest.TestCase):
    """model.py, and what is made of a map that it takes."""

    def test_what_is_said(self):
        for place, value, said in TABLE:
            with self.subTest(said), self.assertRaises(model.MapError) as caught:
                model.read_map(with_value(place, value))
            self.assertIn(said, str(caught.exception))

    def test_a_value_of_another_kind_is_told_or_does_no_harm(self):
        places = kinds_of_places(SOURCE)
        self.assertGreater(len(places), 60)
        told = 0
        for place in places.values():
            for value in OTHERS:
                with self.subTest(place=place, value=value):
                    try:
                        registers.outputs(model.read_map(with_value(place, value)))
                    except model.MapError:
                        told += 1
        self.assertGreater(told, len(places) * len(OTHERS) / 2)


if __name__ == "__main__":
    unittest.main()

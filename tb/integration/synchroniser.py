#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Both flip-flops of can_sync carry what the vendors' tools ask of a synchroniser, also after the
RTL was read, and in the whole design. What those tools make of it is not tested."""

import unittest

import design

ATTRIBUTES = {
    "ASYNC_REG": "TRUE",
    "altera_attribute": "-name SYNCHRONIZER_IDENTIFICATION FORCED_IF_ASYNCHRONOUS",
    "syn_preserve": 1,
    "syn_replicate": 0,
}


def value(attribute):
    """A number or a text; the netlist has numbers as bits."""
    return int(attribute, 2) if set(attribute) <= {"0", "1"} else attribute


class Synchroniser(unittest.TestCase):
    """By the netlist that Yosys reads of the protocol engine."""

    def test_flip_flops_have_the_attributes(self):
        core = design.netlist("can_core")
        pin = core["ports"]["can_rx_i"]["bits"]
        flip_flops = {cell["connections"]["D"][0]: cell["connections"]["Q"]
                      for cell in core["cells"].values()
                      if cell["type"] == "$adff" and len(cell["connections"]["Q"]) == 1}
        first = flip_flops[pin[0]]
        for bits in (first, flip_flops[first[0]]):
            nets = [net for net in core["netnames"].values() if net["bits"] == bits]
            seen = {name: value(text) for net in nets for name, text in net["attributes"].items()
                    if name in ATTRIBUTES}
            self.assertEqual(seen, ATTRIBUTES)


if __name__ == "__main__":
    unittest.main()

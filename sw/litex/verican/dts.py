#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""dts.py csr.json [INTERRUPT_PARENT]: prints a device-tree node for each VeriCAN of a LiteX SoC,
from the csr.json that LiteX writes, for an overlay. INTERRUPT_PARENT: label of the interrupt
controller (intc0). The node is that of sw/linux/verican,can.yaml.
"""
import json
import sys

NODE = """\
        {name}: can@{base:x} {{
                compatible = "verican,can-1.0", "fsl,ls1021ar2-flexcan";
                reg = <{base:#x} 0x1000>;
                interrupt-parent = <&{parent}>;
                interrupts = <{interrupt}>;
                clock-frequency = <{clock}>;
                fsl,clk-source = /bits/ 8 <0>;
        }};
"""


def node(soc, name, parent="intc0"):
    """The node of the core whose region is `name`; `soc` is what csr.json holds."""
    constants = soc["constants"]
    if f"{name}_interrupt" not in constants:
        raise ValueError(f"{name} has no interrupt: add_to() a SoC whose CPU takes some")
    return NODE.format(name=name, base=soc["memories"][name]["base"],
                       interrupt=constants[f"{name}_interrupt"], parent=parent,
                       clock=constants["config_clock_frequency"])


def nodes(soc, parent="intc0"):
    """An overlay with the nodes of all cores of a SoC."""
    if not isinstance(soc, dict) or not all(isinstance(soc.get(key), dict)
                                            for key in ("memories", "constants")):
        raise ValueError("no csr.json of LiteX's: it has no memories or no constants")
    found = [f"&{{/soc}} {{\n{node(soc, name, parent)}}};\n" for name in sorted(soc["memories"])
             if f"{name}_verican" in soc["constants"]]
    if not found:
        raise ValueError("no VeriCAN in this SoC")
    return "/dts-v1/;\n/plugin/;\n\n" + "\n".join(found)


def main():
    """The command line."""
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    try:
        with open(sys.argv[1], encoding="utf-8") as file:
            print(nodes(json.load(file), *sys.argv[2:]), end="")
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"dts.py: {sys.argv[1]}: {error}")


if __name__ == "__main__":
    main()

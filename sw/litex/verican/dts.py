#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""dts.py csr.json [INTERRUPT_PARENT]: prints a device-tree node for each VeriCAN of a LiteX SoC,
from the csr.json that LiteX writes, for an overlay. INTERRUPT_PARENT: label of the interrupt
controller; without, it is the one that LiteX names. The node is that of sw/linux/verican,can.yaml.
"""
import json
import re
import sys

# Parameters that the driver cannot do without (docs/integration.md).
LINUX_NEEDS = {"NumMb": 64, "Fifo": 1, "OwnMasks": 1}
LEVEL_HIGH = 4  # of an interrupt, in device trees
NODE = """\
        {name}: can@{base:x} {{
                compatible = "verican,can-1.0", "fsl,ls1021ar2-flexcan";
                reg = <{base:#x} 0x1000>;
                interrupt-parent = <&{parent}>;
                interrupts = <{interrupt}{flags}>;
                clock-frequency = <{clock}>;
                fsl,clk-source = /bits/ 8 <0>;
        }};
"""


def constant(name, parameter):
    """The name of the SoC's constant that holds a parameter of the core `name`."""
    return f"{name}_verican_" + re.sub("(?<=[a-z])([A-Z])", r"_\1", parameter).lower()


def check(constants, name):
    """Refuses a core that Linux could not drive."""
    if f"{name}_interrupt" not in constants:
        raise ValueError(f"{name} has no interrupt: add_to() a SoC whose CPU takes some")
    lacks = [f"{parameter} = {value}" for parameter, value in LINUX_NEEDS.items()
             if constants.get(constant(name, parameter)) != value]
    if lacks:
        raise ValueError(f"{name} is no core for Linux' flexcan driver, which needs "
                         f"{', '.join(lacks)}: take profile full")


def aplic(soc):
    """The label of a RISC-V APLIC, as LiteX names it, or None: its interrupts have flags."""
    labels = {"aplic_s": "intc_s", "aplic_m": "intc_m"}
    return next((label for memory, label in labels.items() if memory in soc["memories"]), None)


def node(soc, name, parent=None):
    """The node of the core whose region is `name`; `soc` is what csr.json holds."""
    constants = soc["constants"]
    check(constants, name)
    return NODE.format(name=name, base=soc["memories"][name]["base"],
                       interrupt=constants[f"{name}_interrupt"],
                       flags=f" {LEVEL_HIGH:#x}" if aplic(soc) else "",
                       parent=parent or aplic(soc) or "intc0",
                       clock=constants["config_clock_frequency"])


def nodes(soc, parent=None):
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

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""sample.py BUILD: recorded pins on a netlist of gates in Icarus Verilog: no output differs, and
each module is proven equal to its RTL. The same netlist with one AND turned into an OR must differ
for both, or they are blind. A netlist with the time unit, too: a proof reads the RTL as synthesis
does, and what both misread only the pins of the simulated RTL show."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import equal
from replay import netlist_of, replay


def with_a_wrong_gate(text):
    """The netlist with one AND of can_bsp, which every frame runs through, turned into an OR."""
    module = re.search(r"^module \\?\S*can_bsp\b", text, re.MULTILINE)
    gate = text.index(" & ", module.start())
    return text[:gate] + " | " + text[gate + 3:]


def main():
    build = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch:
        good, bad = Path(scratch) / "good.v", Path(scratch) / "bad.v"
        netlist_of("gates", "ahb", 16, good)
        status, text = replay(["frames"], 16, build, netlist=good)
        print(text)
        if status:
            sys.exit("netlist: the gates do not do what the RTL did")
        bad.write_text(with_a_wrong_gate(good.read_text()))
        status, text = replay(["frames"], 16, build, netlist=bad)
        if status == 0 or "DIFF" not in text:
            sys.exit(f"netlist: a wrong gate was not noticed (status {status}):\n{text}")
        modules, faults = equal.compare(good, 16, Path(scratch) / "good")
        if faults or modules < 30:
            sys.exit(f"netlist: of {modules} modules differ from the RTL: {faults}")
        modules, faults = equal.compare(bad, 16, Path(scratch) / "bad", only="can_bsp")
        if modules != 1 or not faults:
            sys.exit("netlist: no proof noticed a wrong gate")
        print("a wrong gate is noticed")
        timed = Path(scratch) / "time.v"
        netlist_of("gates", "time", None, timed)
        status, text = replay(["time_registers"], None, build, netlist=timed, device="time")
        print(text)
        if status:
            sys.exit("netlist: the gates with the time unit do not do what the RTL did")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"netlist: {error}")

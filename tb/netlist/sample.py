#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""sample.py BUILD: recorded pins on a netlist of gates in Icarus Verilog: no output differs. The
same netlist with one AND turned into an OR must differ, or the comparison is blind."""
import subprocess
import sys
import tempfile
from pathlib import Path

from replay import netlist_of, replay


def with_a_wrong_gate(text):
    """The netlist with one AND of can_bsp, which every frame runs through, turned into an OR."""
    begin = text.index("module can_bsp(")
    gate = text.index(" & ", begin)
    return text[:gate] + " | " + text[gate + 3:]


def main():
    build = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch:
        good, bad = Path(scratch) / "good.v", Path(scratch) / "bad.v"
        netlist_of("gates", 16, good)
        status, text = replay(["frames", "errors"], 16, build, netlist=good)
        print(text)
        if status:
            sys.exit("netlist: the gates do not do what the RTL did")
        bad.write_text(with_a_wrong_gate(good.read_text()))
        status, text = replay(["frames"], 16, build, netlist=bad)
        if status == 0 or "DIFF" not in text:
            sys.exit(f"netlist: a wrong gate was not noticed (status {status}):\n{text}")
        print("a wrong gate is noticed")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"netlist: {error}")

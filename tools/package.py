#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""package.py OUT [--flat BUS_SIZE ...]: writes what other tools' packagers take:

  OUT/verilog/can_<bus>_v.v          Verilog-2001 shells around the wrappers
  OUT/verilog/can_axil_window.v      one whose addresses end with the core's window
  OUT/verilog/can_<bus>_<size>.v     a build in one file of Verilog-2005: --flat apb_16, or all
  OUT/ipxact/can_<bus>.xml           IP-XACT 1685-2014 components
  OUT/fpga/...                       scripts for the packagers of Vivado, Quartus, Libero
  OUT/lists/...                      file lists

Lists and scripts take the RTL from OUT/rtl, as it is in the archive of make dist.
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

# ruff: noqa: E402  (the path must be set first)
from pack import flat, ipxact, lists, shell, vendors
from pack.wrappers import ROOT, wrappers
from plain_end import run
from regmap import model


def outputs(found, regmap):
    """path -> text of all that needs no tool."""
    files = {}
    for wrapper in found:
        files[f"verilog/{wrapper.module}_v.v"] = shell.render(wrapper)
        files[f"ipxact/{wrapper.module}.xml"] = ipxact.render(wrapper, regmap)
        if wrapper.bus == "axil":
            files[f"verilog/{wrapper.module}_window.v"] = shell.window(wrapper)
    return {**files, **vendors.render(found), **lists.render()}


def flat_files(found, wanted):
    """path -> text of the builds asked for."""
    files = {}
    for name, (wrapper, size) in flat.chosen(found, wanted).items():
        with tempfile.TemporaryDirectory() as work:
            files[f"verilog/can_{name}.v"] = flat.render(wrapper, size, Path(work))
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--flat", nargs="+", default=[], metavar="BUS_SIZE")
    arguments = parser.parse_args()
    found = wrappers()
    try:
        flat.chosen(found, arguments.flat)
        arguments.out.mkdir(parents=True, exist_ok=True)
        files = {**outputs(found, model.load(ROOT / "sw/registers.yaml")),
                 **flat_files(found, arguments.flat)}
        for name, text in files.items():
            (arguments.out / name).parent.mkdir(parents=True, exist_ok=True)
            (arguments.out / name).write_text(text, encoding="utf-8")
    except (flat.FlatError, model.MapError) as error:
        sys.exit(f"package.py: {error}")
    print(f"{len(files)} files in {arguments.out}")
    if not (arguments.out / "rtl/can.f").is_file():
        print(f"they take the RTL from {arguments.out}/rtl, which is not there: link it or copy it")


if __name__ == "__main__":
    run(main)

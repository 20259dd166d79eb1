# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""contents: what the archive for integrators holds."""
import shutil
import subprocess
import sys
from pathlib import Path

from pack.wrappers import ROOT

# Committed files and folders, which lie in the archive where they lie here: pages name their paths.
TAKEN = ("rtl", "constraints", "tb/smoke", "can.core", "sw/litex", "sw/driver/src",
         "sw/driver/include", "sw/remote", "sw/verican.svd", "sw/registers.yaml",
         "sw/profiles.yaml", "examples/hx8k", "examples/remote/board", "LICENSE", "LICENSES",
         "CHANGELOG.md", "docs/integration.md", "docs/registers.md", "docs/img/registers",
         "docs/errata.md", "docs/synthesis.md", "docs/synthesis-families.md", "docs/driver.md",
         "docs/time.md", "docs/hx8k.md", "docs/remote.md", "docs/remote-node.md",
         "docs/remote-cabinet.svg", "tools/core_check.py", "tools/constraints.py",
         "tools/remote_memory.py")
README = """\
# VeriCAN for integrators

A CAN 2.0 controller with FlexCAN's registers on AHB-Lite, APB, AXI4-Lite or Wishbone.
Begin with the table "I use ..." of docs/integration.md. What is where:

| folder | holds |
|---|---|
| rtl | SystemVerilog, in the order of rtl/can.f |
| verilog | a build a file in Verilog-2005; shells with a Verilog top |
| lists | the file list: can_root.f from here, can_abs.f behind `VERICAN_ROOT`; for Tcl |
| can.core, ipxact, fpga | for FuseSoC, IP-XACT tools, Vivado, Quartus, Libero |
| constraints | by FPGA family; tools/constraints.py writes them for an instance in a design |
| examples/hx8k | a CAN node at a serial port; can_hx8k.bin, if it was made: its bitstream |
| examples/remote | boards with a node without a processor (docs/remote.md) |
| tb/smoke | a first frame in loop-back through each bus |
| sw | C driver, LiteX module, client of remote nodes; SVD file, register map, profiles |

Licences: each file names its own; texts in LICENSES. MANIFEST: SHA-256, size, path of every file.
"""


def committed(place):
    """The committed files at or below a place of the project."""
    done = subprocess.run(["git", "ls-files", "--", place], cwd=ROOT, check=True, text=True,
                          stdout=subprocess.PIPE)
    return done.stdout.splitlines()


def stage(folder, flat, bitstream=None):
    """Fills the folder. flat: builds in Verilog-2005; bitstream: that of the board, if there is
    one."""
    for place in TAKEN:
        files = committed(place)
        if not files:
            sys.exit(f"dist.py: {place} has no committed file")
        for name in files:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    (folder / "README.md").write_text(README, encoding="utf-8")
    if bitstream:
        shutil.copyfile(bitstream, folder / "examples/hx8k/can_hx8k.bin")
    package = [sys.executable, "-B", ROOT / "tools/package.py", folder, "--flat", *flat]
    # Links of pages to what is not here become text.
    links = [sys.executable, "-B", ROOT / "cmake/installed_docs.py", ROOT, folder]
    for command in (package, links):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

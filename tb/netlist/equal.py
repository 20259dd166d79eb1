# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the netlist of each module does what its RTL does: Yosys' equiv_make and equiv_induct.

Registers of the same name are taken as equal, nothing is said about what they hold, and outputs and
next values must be equal then: a proof for every state and every input, reachable or not. (One
clock, -seq 1: a longer induction would leave states out to which no other one leads.) Next values,
*_d, are no pairs of their own: a netlist may have any where they are not loaded. Modules below are
black boxes with equal outputs for equal inputs, and proven on their own. can_mb_ram is one
always: what it returns for a word that is being written is not defined."""
import hashlib
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from replay import rtl_files

ROOT = Path(__file__).resolve().parent.parent.parent
RESET = ROOT / "tb/netlist/sync_reset.v"
CELLS = "`define NO_ICE40_DEFAULT_ASSIGNMENTS"   # behind it: models of iCE40 cells


def yosys(script, log, check=True):
    """Runs a script; what it wrote."""
    path = log.with_suffix(".ys")
    path.write_text(script)
    log.unlink(missing_ok=True)
    done = subprocess.run(["yosys", "-q", "-l", log, path], capture_output=True, text=True,
                          check=False, stdin=subprocess.DEVNULL)
    if check and done.returncode:
        sys.exit(f"netlist: yosys failed, see {log}")
    return log.read_text() if log.exists() else ""


def plain_names(text):
    """Modules with parameters by hashes: Yosys and the Verilog it writes differ in their names."""
    def name(match):
        return "\\with_" + hashlib.md5(match.group().lstrip("\\").encode()).hexdigest()[:10]
    return re.sub(r"\\?\$paramod\S*", name, text)


def read_both(netlist, num_mb, folder):
    """Writes rtl.il and net.il: RTL and netlist of can_ahb, modules apart. The modules: file of the
    RTL and name in what was written."""
    raw = folder / "raw.il"
    yosys(f"read_verilog -sv {' '.join(rtl_files())}; hierarchy -check -top can_ahb "
          f"-chparam NumMb {num_mb}; proc; write_rtlil {raw}", folder / "rtl.log")
    text = plain_names(raw.read_text())
    (folder / "rtl.il").write_text(text)
    modules = re.findall(r'src "[^"]*/(\w+)\.sv:[^"]*"\n(?:attribute [^\n]*\n)*module \\(\S+)',
                         text)
    gates, models, cells = netlist.read_text().partition(CELLS)
    (folder / "net.v").write_text(plain_names(gates))
    (folder / "cells.v").write_text(models + cells)
    kept = "\n".join(f"setattr -mod -set keep_hierarchy 1 {name}" for _, name in modules)
    yosys(f"read_verilog {folder}/net.v; read_verilog -defer {folder}/cells.v\n"
          f"hierarchy -top {top_of(modules)}\n{kept}\nproc; flatten; write_rtlil {folder}/net.il",
          folder / "net.log")
    return modules


def split(folder, side):
    """Writes SIDE.MODULE.il of each module of SIDE.il, and SIDE.black.il with all of them as black
    boxes, so that a proof reads what it is about, and of the rest the ports."""
    whole = (folder / f"{side}.il").read_text()
    yosys(f"read_rtlil {folder}/{side}.il; blackbox *; write_rtlil {folder}/{side}.black.il",
          folder / f"{side}.black.log")
    for text, name in re.findall(r"^((?:attribute [^\n]*\n)*module \\(\S+)\n.*?^end\n)", whole,
                                 re.MULTILINE | re.DOTALL):
        (folder / f"{side}.{name}.il").write_text(text)


def top_of(modules):
    """can_ahb as it is called in the files."""
    return next(name for file, name in modules if file == "can_ahb")


def prove(module, folder):
    """Signals of a module that are not proven equal; None: Yosys could not compare them."""
    def side(name):
        return f"""read_rtlil {folder}/{name}.black.il
delete {module}
read_rtlil {folder}/{name}.{module}.il
hierarchy -top {module}
opt_clean; simplemap t:$mux t:$and t:$or t:$not; opt_expr; opt_clean
techmap -map {RESET}; opt_expr; opt_clean
rename -hide {module}/w:*_d
rename {module} {name}
design -stash {name}
"""
    log = yosys(side("rtl") + side("net") + """design -load rtl
design -copy-from net -as net net
equiv_make rtl net equiv
hierarchy -top equiv
opt_clean
equiv_simple; equiv_induct -seq 1
equiv_status
""", folder / f"{module}.log", check=False)
    if "Equivalence successfully proven!" in log:
        return []
    return re.findall(r"Unproven \$equiv \S+: \\(\S+)_gold", log) or None


def compare(netlist, num_mb, folder, jobs=2, only=""):
    """Compares all modules of a netlist of can_ahb but the RAM, or those of one file of RTL: how
    many, and the faults found."""
    folder.mkdir(parents=True, exist_ok=True)
    modules = read_both(netlist, num_mb, folder)
    for side in ("rtl", "net"):
        split(folder, side)
    asked = [(file, name) for file, name in modules if file != "can_mb_ram" and only in ("", file)]
    with ThreadPoolExecutor(jobs) as pool:
        answers = list(pool.map(lambda entry: prove(entry[1], folder), asked))
    faults = []
    for (file, name), unproven in zip(asked, answers):
        if unproven is None:
            faults.append(f"{file}: not compared, see {folder / name}.log")
        elif unproven:
            faults.append(f"{file}: differs in {', '.join(sorted(set(unproven)))}")
    return len(asked), faults

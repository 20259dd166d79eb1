# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A top's flip-flops by name, from Yosys; and the task of its bench that looks for X in them."""
import json
import re
import subprocess


class RegisterError(Exception):
    """Yosys failed; the text says where its log is."""


# Yosys' cells, and whether they have an asynchronous reset.
FLIP_FLOPS = {"adff": True, "adffe": True, "aldff": True, "dff": False, "dffe": False,
              "sdff": False, "sdffe": False, "dlatch": False}


def run_yosys(rtl, top, parameters, directory):
    result = f"{directory}/registers.json"
    values = " ".join(f"-set {name} {value}" for name, value in parameters.items())
    script = (f"read_verilog -sv {' '.join(rtl)}; chparam {values} {top}; "
              f"hierarchy -check -top {top}; proc -norom; flatten; opt_clean; "
              f"write_json {result}")
    log = f"{directory}/yosys.log"
    if subprocess.run(["yosys", "-q", "-l", log, "-p", script], check=False,
                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode:
        raise RegisterError(f"yosys failed, see {log}")
    with open(result, encoding="utf-8") as file:
        return json.load(file)["modules"][top]


def flip_flops(module):
    """Names of registers with a reset, and of those without one, as in the RTL's hierarchy."""
    registers, pools = [], {True: set(), False: set()}
    for cell in module["cells"].values():
        kind = cell["type"].removeprefix("$")
        if cell["type"].startswith("$") and kind in FLIP_FLOPS:
            bits = set(cell["connections"]["Q"])
            registers.append(bits)
            pools[FLIP_FLOPS[kind]] |= bits
    names = {True: [], False: []}
    covered = set()
    # The name closest to the register: the deepest in the hierarchy that has all of its bits. What
    # is left is named piece by piece.
    nets = sorted(module["netnames"].items(), key=lambda item: (-item[0].count("."), item[0]))
    for whole in (True, False):
        for name, net in nets:
            bits = {bit for bit in net["bits"] if isinstance(bit, int)}
            plain = re.sub(r"\[\d+\](?=\.)", "", name)   # of a block of a generate loop
            if net["hide_name"] or not bits or any(mark in plain for mark in "$\\["):
                continue
            if whole and not any(one <= bits and not one <= covered for one in registers):
                continue
            for reset, pool in pools.items():
                if bits <= pool and not bits <= covered:
                    names[reset].append(name)
                    covered |= bits
    missing = (pools[True] | pools[False]) - covered
    return sorted(names[True]), sorted(names[False]), len(missing)


def write_task(name, signals, out):
    """A task of replay.sv: one look at all signals, and at each of them only if there is an X."""
    out.write(f"task {name};\n  begin\n")
    for start in range(0, len(signals), 50):
        group = signals[start:start + 50]
        every = ", ".join(f"dut.{signal}" for signal in group)
        out.write(f"    if (^{{{every}}} === 1'bx) begin\n")
        for signal in group:
            out.write(f'      if (^dut.{signal} === 1\'bx) unknown("{signal}");\n')
        out.write("    end\n")
    out.write("  end\nendtask\n")


def write_tasks(with_reset, without, behind_ram, path):
    """check_registers looks at all of them but those that check_behind_ram looks at: those without
    reset, the RAMs' read data, and the names of behind_ram, which show what a RAM returns."""
    for name in behind_ram:
        if name not in with_reset:
            raise RegisterError(f"registers.py: there is no register {name}")
    with open(path, "w", encoding="utf-8") as out:
        write_task("check_registers", [n for n in with_reset if n not in behind_ram], out)
        write_task("check_behind_ram", without + behind_ram, out)

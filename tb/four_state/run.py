#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Plays recorded pins to the RTL in Icarus Verilog, with everything unknown before the reset.

For each recording (the recorder's --list) and size: record with Verilator, replay with Icarus,
compare every output in every clock, look for X in outputs and in every flip-flop after the reset.
Exits with 1 if there is a difference or an X. docs/netlist.md has the details.
"""
import argparse
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile

import registers
from devices import DEVICES, LEAST_CLOCKS

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


class ReplayError(Exception):
    """A step failed; the text is one line for the user."""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("recordings", nargs="*", help="names; default: all")
    parser.add_argument("--build", default="build/release", help="where four_state_record is")
    parser.add_argument("--device", choices=sorted(DEVICES), default="ahb",
                        help="ahb: the core; small: its profile of that name; time: with the "
                             "time unit; remote: the node without a processor; follower: the clock "
                             "without one (ahb)")
    parser.add_argument("--num-mb", type=int, nargs="+", choices=DEVICES["ahb"].sizes,
                        help="of the core (16 64)")
    parser.add_argument("--netlist", nargs="+", metavar="FILE", help="a netlist of can_ahb "
                        "of that size in place of the RTL; its registers are not looked at")
    parser.add_argument("--rtl", default="rtl", metavar="DIR", help="another copy of rtl/")
    parser.add_argument("--work", metavar="DIR", help="keep the intermediate files there")
    parser.add_argument("--json", metavar="FILE", help="write the figures there")
    parser.add_argument("--clocks", type=int, default=400_000, metavar="N",
                        help="of each recording at most the first N (all)")
    parser.add_argument("--most", type=int, default=0, metavar="N",
                        help="end a replay with its Nth difference or X (0: with its last clock)")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    if options.most < 0:
        parser.error(f"--most {options.most}: at least 0 is needed")
    if options.clocks < 1:
        parser.error(f"--clocks {options.clocks}: at least 1 is needed")
    if options.jobs < 1:
        parser.error(f"--jobs {options.jobs}: at least 1 is needed")
    if options.num_mb and options.device != "ahb":
        parser.error("--num-mb is for --device ahb: there is no other choice of buffers")
    options.device = DEVICES[options.device]
    options.sizes = options.num_mb or list(options.device.sizes)
    return options


def call(command, log):
    with open(log, "w", encoding="utf-8") as out:
        if subprocess.run(command, stdout=out, stderr=out, check=False).returncode:
            raise ReplayError(f"{os.path.basename(command[0])} failed, see {log}")


def rtl_files(directory):
    with open(f"{directory}/can.f", encoding="utf-8") as file:
        names = [line.split("#")[0].strip() for line in file]
    return [f"{directory}/{name}" for name in names if name]


def for_icarus(files, target):
    """Copies of RTL files that Icarus 11 can run: always_comb as always @*.

    In Icarus 11 all always_comb processes share the event that starts them at time 0, and two of
    them can wake each other for ever without any input changing.
    """
    copies = []
    for name in files:
        with open(name, encoding="utf-8") as file:
            text = file.read()
        copies.append(f"{target}/{os.path.basename(name)}")
        with open(copies[-1], "w", encoding="utf-8") as out:
            out.write(re.sub(r"\balways_comb\b", "always @*", text))
    return copies


def compile_bench(args, size, work):
    """Returns the compiled bench and how many registers it looks at."""
    device = args.device
    parameters = device.parameters(size)
    target = f"{work}/replay{size}"
    os.makedirs(target, exist_ok=True)
    command = ["iverilog", "-g2012", "-s", "replay", "-o", f"{target}/replay.vvp",
               "-I", target, "-I", HERE,
               "-DPARAMETERS=" + ", ".join(f".{n}({v})" for n, v in parameters.items())]
    files, names = args.netlist, []
    if args.netlist:
        command.append("-DNETLIST")
    else:
        files = rtl_files(args.rtl)
        module = registers.run_yosys(files, device.top, parameters, target)
        reset, free, missing = registers.flip_flops(module)
        free = [name for name in free if name not in device.unasked]
        if missing:
            raise ReplayError(f"{missing} flip-flop bits have no name in {target}/registers.json")
        names = reset + free
        behind_ram = list(device.behind_ram)
        registers.write_tasks(reset, free, behind_ram, f"{target}/registers.vh")
        command.append("-DREGISTERS")
        files = for_icarus(files, target)
    call(command + [f"{HERE}/{device.bench}"] + files, f"{target}/iverilog.log")
    return f"{target}/replay.vvp", names


def recorder(args):
    return f"{args.build}/tb/four_state/{args.device.recorder}"


def replay(args, name, size, bench, work):
    """Records and replays; returns (clocks, differences, unknown values, lines to show)."""
    rows = f"{work}/{name}{size}.rows"
    call([recorder(args), name, str(size), rows], f"{work}/{name}{size}.record.log")
    with open(rows, encoding="utf-8") as file:
        recorded = sum(1 for _ in file)
    if recorded < LEAST_CLOCKS[name]:
        raise ReplayError(f"{name}: {recorded} clocks recorded, not {LEAST_CLOCKS[name]} or more")
    count = min(recorded, args.clocks)
    log = f"{work}/{name}{size}.log"
    call(["vvp", "-n", bench, f"+rows={rows}", f"+count={count}", f"+most={args.most}"],
         log)
    with open(log, encoding="utf-8") as file:
        lines = file.read().splitlines()
    end = re.fullmatch(r"END clocks (\d+) diffs (\d+) xs (\d+)", lines[-1] if lines else "")
    early = end and 0 < args.most <= int(end[2]) + int(end[3])
    if not end or (int(end[1]) != count and not early):
        raise ReplayError(f"the replay of {name} did not reach its end, see {log}")
    shown = [line for line in lines if line.startswith(("DIFF", "X "))]
    return int(end[1]), int(end[2]), int(end[3]), shown


def write_json(path, rows, registers_seen):
    bad = sum(row[3] + row[4] for row in rows)
    figures = [
        {"name": "4-state: clocks replayed on the RTL", "value": sum(row[2] for row in rows)},
        {"name": "4-state: flip-flops watched", "value": registers_seen},
        {"name": "4-state: unknown values after reset and outputs that differ", "value": bad,
         "bar": "0", "ok": bad == 0}]
    tables = [{"title": "4-state replay", "columns": ["recording", "buffers", "clocks",
                                                      "differences", "X"], "rows": rows}]
    with open(path, "w", encoding="utf-8") as out:
        json.dump({"figures": figures, "tables": tables, "notes": []}, out, indent=1)


def run(args, work):
    known = subprocess.run([recorder(args), "--list"], capture_output=True, text=True,
                           check=True).stdout.split()
    names = args.recordings or known
    for name in names:
        if name not in known:
            raise ReplayError(f"no recording {name}; there are: {' '.join(known)}")
    rows, seen = [], 0
    for size in args.sizes:
        bench, watched = compile_bench(args, size, work)
        seen = max(seen, len(watched))
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            tasks = [(name, pool.submit(replay, args, name, size, bench, work))
                     for name in names]
            for name, task in tasks:
                count, diffs, unknown, shown = task.result()
                rows.append([name, size, count, diffs, unknown])
                print(f"{name} {args.device.shown(size)}: {count} clocks, "
                      f"{diffs} differences, {unknown} X", flush=True)
                for line in shown:
                    print(f"  {line}")
    if args.json:
        write_json(args.json, rows, seen)
    return 1 if any(row[3] or row[4] for row in rows) else 0


def main():
    args = arguments()
    os.chdir(ROOT)
    if args.netlist and len(args.sizes) != 1:
        raise ReplayError("--netlist needs --num-mb with one size")
    if args.work:
        os.makedirs(args.work, exist_ok=True)
        return run(args, args.work)
    with tempfile.TemporaryDirectory() as work:
        return run(args, work)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (ReplayError, registers.RegisterError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"four-state: {error}")

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""mutants.py [--list] [--keep DIR] [NAME ...]: does the random campaign find a broken core?

Builds the tool and the campaign once on a copy of the RTL in which every mutant below sleeps; the
environment variable VERICAN_MUTANT wakes one. For each (or each NAME): runs seeds until one fails,
then holds the shrunk scenario against the broken and the healthy core. Prints a line for each and
ends with status 1 if a mutant is not found, or if its scenario does not tell the two apart.
--keep DIR: copies the shrunk scenarios there.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/random-mutants"
VALUE = '(getenv(\\"VERICAN_MUTANT\\") ? std::atoi(getenv(\\"VERICAN_MUTANT\\")) : 0)'
AWAKE = f'($c32("{VALUE}") == {{}})'

# Name, what is wrong, file, the text and what takes its place; @ is true while the mutant is awake.
MUTANTS = [
    ("arbitration", "a loss at IDE is not noticed", "frame/can_error.sv",
     "saw_d && arbitration && !stuff_i;                                 // AR-02",
     "saw_d && arbitration && !stuff_i && !(@ && field_i == can_pkg::FldIde);"),
    ("overload", "a dominant INT1 or INT2 is not answered", "frame/can_error.sv",
     "{fixed, overload} = {1'b0, !last_i};", "{fixed, overload} = {1'b0, !last_i && !@};"),
    ("acknowledge", "a passive transmitter counts a missing ACK", "frame/can_fault.sv",
     "!(exempt_i || withhold)", "!(exempt_i || (withhold && !@))"),
    ("success", "TEC stays after a success", "frame/can_fault.sv",
     "good_tx && (tec_q[7:0] != '0)", "good_tx && !@ && (tec_q[7:0] != '0)"),
    ("suspend", "no suspend transmission", "frame/can_field.sv",
     "assign suspend = tx_q && passive_i;", "assign suspend = tx_q && passive_i && !@;"),
    ("joined-start", "no joining at INT3", "frame/can_field.sv",
     "(field_q == can_pkg::FldIdle || field_q == can_pkg::FldInt)",
     "(field_q == can_pkg::FldIdle || (field_q == can_pkg::FldInt && !@))"),
    ("synchronisation", "early edges do not shorten the bit", "bit/can_bit_timing.sv",
     "seg2_q && !ending && (hard_q || reached)",
     "seg2_q && !ending && (hard_q || (reached && !@))"),
    ("lost-frame", "a C/S write cancels what waits for another buffer", "mailbox/can_mb_move.sv",
     "kill[0] = cs_written_i && cs_written_idx_i == tgt0_q",
     "kill[0] = cs_written_i && (@ || cs_written_idx_i == tgt0_q)"),
    ("overrun", "a frame over an unread one counts as the first", "mailbox/can_mb_move.sv",
     "ans, ovr_q || ans,", "ans, (ovr_q && !@) || ans,"),
]


def run(*command, mutant=0, **options):
    environment = dict(os.environ, VERICAN_MUTANT=str(mutant))
    return subprocess.run(command, env=environment, check=False, text=True, **options)


def insert(rtl):
    """All mutants into the folder `rtl`; exits if the text of one is not there once."""
    for number, (name, _, file, old, new) in enumerate(MUTANTS, 1):
        path = rtl / file
        text = path.read_text()
        if text.count(old) != 1:
            sys.exit(f"mutants: {name}: rtl/{file} has '{old}' {text.count(old)} times, not once")
        path.write_text(text.replace(old, new.replace("@", AWAKE.format(number))))


def build(jobs):
    rtl = BUILD / "rtl"
    shutil.rmtree(rtl, ignore_errors=True)
    shutil.copytree(ROOT / "rtl", rtl)
    insert(rtl)
    configure = ["cmake", "--preset", "release", "-B", BUILD, f"-DVERICAN_RTL_DIR={rtl}"]
    make = ["cmake", "--build", BUILD, "-j", str(jobs), "--target", "random_campaign", "verican"]
    for command in (configure, make):
        done = run(*command, cwd=ROOT, capture_output=True)
        if done.returncode != 0:
            text = done.stdout[-2000:] + done.stderr[-2000:]
            sys.exit(f"mutants: {' '.join(map(str, command))}\n{text}")


def judge(number, name, options):
    """Runs the campaign on a mutant; what came of it, and the shrunk scenario or None."""
    folder = BUILD / "found" / name
    shutil.rmtree(folder, ignore_errors=True)
    for seed in range(1, options.seeds + 1):
        done = run(BUILD / "tb/random/random_campaign", "--seed", str(seed), "--runs", "1",
                   "--frames-a-run", str(options.frames), "--jobs", "1", "--directory", folder,
                   mutant=number, capture_output=True)
        if done.returncode not in (0, 1):
            return f"the campaign ends with {done.returncode} at seed {seed}", None
        if done.returncode == 1:
            break
    else:
        return f"not found by {options.seeds} seeds", None
    file = folder / f"seed-{seed}.yaml"
    broken = run(BUILD / "verican", "run", file, mutant=number, capture_output=True)
    good = run(BUILD / "verican", "run", file, capture_output=True)
    lines = len(file.read_text().splitlines())
    result = f"seed {seed}, {lines} lines"
    if broken.returncode != 1:
        return f"{result}: the scenario passes on the broken core", None
    if good.returncode != 0:
        return f"{result}: the scenario fails on the healthy core", None
    finding = next(line for line in broken.stdout.splitlines() if "FAIL" in line)
    finding = finding.split("compared: ")[-1].removesuffix(" (expected no difference)")
    return f"{result}: {finding}", file


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--list", action="store_true",
                        help="names and what is wrong, if the RTL has the text of each")
    parser.add_argument("--keep", type=Path, help="folder for the shrunk scenarios")
    parser.add_argument("--seeds", type=int, default=300, help="tried at most (300)")
    parser.add_argument("--frames", type=int, default=150, help="of each, about (150)")
    parser.add_argument("--jobs", type=int, default=2, help="of the build (2)")
    options = parser.parse_args()
    known = [name for name, *_ in MUTANTS]
    for name in options.names:
        if name not in known:
            parser.error(f"no mutant '{name}'; there are: {', '.join(known)}")
    if options.list:
        with tempfile.TemporaryDirectory() as folder:
            insert(Path(shutil.copytree(ROOT / "rtl", Path(folder) / "rtl")))
        print("\n".join(f"{name:16} {what} (rtl/{file})" for name, what, file, *_ in MUTANTS))
        return 0
    build(options.jobs)
    missed = 0
    for number, (name, what, *_) in enumerate(MUTANTS, 1):
        if options.names and name not in options.names:
            continue
        result, file = judge(number, name, options)
        missed += file is None
        print(f"{'found ' if file else 'MISSED'} {name}: {what}: {result}", flush=True)
        if file and options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, options.keep / f"{name}.yaml")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())

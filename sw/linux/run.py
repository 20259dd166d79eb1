#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Runs Linux's unmodified flexcan driver, and the driver of the time unit, on the Verilated core
and judges what came of it.

Each case boots a user-mode Linux whose controllers are those of `verican linux`, runs a script of
sw/linux/guest in it and hands the files it left to its judge (judge.py, judge_clock.py,
judge_events.py, judge_tools.py, judge_isotp.py). A judge's prepare_SCRIPT, if there is one, writes
files for the script.
"""
import argparse
import concurrent.futures
import filecmp
import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import judge
import judge_canfdtest
import judge_clock
import judge_events
import judge_isotp
import judge_j1939
import judge_services
import judge_timeouts
import judge_tools
from scratch import scratch

ROOT = Path(__file__).resolve().parents[2]
CHIPS = ("ls1021ar2", "imx28")
# Controllers without what the driver can do without (PK-47).
LEAN = "ls1021ar2-lean"
WITH_LEAN = (*CHIPS, LEAN)
# Controllers with time units: their device tree and their simulator.
CLOCKS = ("time",)
CLOCK_OPTIONS = ["--time-unit", f"--clock-ppm={','.join(str(ppm) for ppm in judge_clock.PPM)}"]
JUDGES = (judge, judge_canfdtest, judge_clock, judge_events, judge_tools, judge_isotp, judge_j1939,
          judge_services, judge_timeouts)
RATES = "125000,250000,500000,1000000"


@dataclass
class Case:
    """A script with its settings; `red` cases spoil something, and their judge must notice."""

    name: str
    script: str
    settings: dict = field(default_factory=dict)
    chips: tuple = CHIPS
    short: bool = False
    red: bool = False
    twice: bool = False


def cases(short):
    """The cases of the short or of the full form."""
    few = {"VERICAN_RATES": "1000000", "VERICAN_FRAMES": "100"}
    many = {"VERICAN_RATES": RATES, "VERICAN_FRAMES": "400"}
    load = few if short else many
    impatient = {**few, "VERICAN_STEPS": "30"}
    spoilt = {"VERICAN_LOAD": "0", "VERICAN_LEAST": "0", "VERICAN_SABOTAGE": "corrupt-data"}
    everything = [
        Case("probe", "probe", short=True, chips=WITH_LEAN),
        Case("exchange", "exchange", load, short=True, chips=WITH_LEAN),
        Case("flood", "flood", load, short=True, chips=WITH_LEAN),
        Case("remote", "remote", chips=WITH_LEAN),
        Case("loopback", "loopback"),
        Case("listenonly", "listenonly"),
        Case("busoff", "busoff", short=True, chips=WITH_LEAN),
        Case("stuck", "stuck", chips=WITH_LEAN),
        Case("statistics", "statistics", chips=WITH_LEAN),
        Case("reload", "reload"),
        Case("rxrtr", "rxrtr", chips=("imx28",)),
        Case("ptp-probe", "ptpprobe", chips=CLOCKS, short=True),
        Case("ptp-calls", "ptpcalls", chips=CLOCKS),
        Case("ptp-perout", "ptpperout", chips=CLOCKS),
        Case("ptp-extts", "ptpextts", chips=CLOCKS),
        Case("ptp-pps", "ptppps", chips=CLOCKS),
        Case("ptp-remove", "ptpremove", chips=CLOCKS, short=True),
        Case("ptp-tools", "ptptools", chips=CLOCKS),
        Case("ptp-phc2sys", "ptpphc2sys", chips=CLOCKS),
        Case("ptp-ts2phc", "ptpts2phc", chips=CLOCKS),
        # Programs in guests take most of their time, so one compatible is enough.
        Case("isotp", "isotp", {"VERICAN_PDUS": "3", "VERICAN_LOAD": "36",
                                "VERICAN_LEAST": "0.80"}, chips=("ls1021ar2",)),
        Case("j1939", "j1939", {"VERICAN_BYTES": "100000", "VERICAN_LOAD": "20",
                                "VERICAN_LEAST": "0.45"}, chips=("ls1021ar2",)),
        Case("timeouts", "timeouts", chips=("ls1021ar2",)),
        Case("bcm", "bcm", {"VERICAN_LOAD": "12"}, chips=("ls1021ar2",)),
        Case("gateway", "gateway", {"VERICAN_LOAD": "12"}, chips=("ls1021ar2",)),
        Case("canfdtest", "canfdtest", {"VERICAN_FRAMES": "500"}),
        Case("repeatable", "exchange", few, short=True, twice=True),
        Case("red-lost-frame", "exchange", {**few, "VERICAN_SABOTAGE": "lose-frame"}, short=True,
             red=True),
        Case("red-wrong-data", "exchange", {**few, "VERICAN_SABOTAGE": "corrupt-data"}, red=True),
        Case("red-canfdtest", "canfdtest", {"VERICAN_FRAMES": "100",
                                            "VERICAN_SABOTAGE": "corrupt-data"}, red=True,
             chips=("ls1021ar2",)),
        Case("red-j1939", "j1939", {"VERICAN_BYTES": "2000", **spoilt}, red=True,
             chips=("ls1021ar2",)),
        Case("red-bcm", "bcm", spoilt, red=True, chips=("ls1021ar2",)),
        Case("red-gateway", "gateway", spoilt, red=True, chips=("ls1021ar2",)),
        Case("red-no-interrupt", "exchange", {**impatient, "VERICAN_SABOTAGE": "deaf"}, red=True,
             chips=("ls1021ar2",)),
        Case("red-frozen-counter", "statistics", {"VERICAN_SABOTAGE": "frozen-errors"}, red=True,
             chips=("ls1021ar2",)),
    ]
    return [case for case in everything if case.short or not short]


@dataclass
class Result:
    """How a case went."""

    case: Case
    chip: str
    ok: bool
    message: str = ""
    notes: dict = field(default_factory=dict)
    guest: float = 0.0
    wall: float = 0.0


def compatible(chip):
    """What the driver takes a controller for: name of its device tree, and of its quirks."""
    return "ls1021ar2" if chip == LEAN else chip


def of_judges(name):
    """The judges' function of that name, or None."""
    return next((getattr(module, name) for module in JUDGES if hasattr(module, name)), None)


def boot(args, case, chip, directory):
    """One guest from power-on to power-off; returns (simulated, real) seconds."""
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    prepare = of_judges(f"prepare_{case.script}")
    if prepare:
        prepare(directory, case.settings)
    modules = args.build / "modules"
    settings = {"VERICAN_SCRIPTS": case.script, "VERICAN_MODULES": str(modules),
                "VERICAN_GUEST": str(ROOT / "sw/linux/guest"), **case.settings}
    command = [str(args.verican), "linux", "--kernel", str(modules / "linux"),
               "--dtb", str(modules / f"{compatible(chip)}.dtb"),
               "--init", str(ROOT / "sw/linux/guest/init.sh"),
               "--preload", str(modules / "wide_xstate.so"), "--dir", str(directory),
               "--access-logs", "--timeout", str(args.timeout)]
    command += [*(CLOCK_OPTIONS if chip in CLOCKS else []),
                *(["--lean"] if chip == LEAN else []), "--"]
    command += [f"{key}={value}" for key, value in settings.items()]
    start = time.monotonic()
    environment = {**os.environ, "TMPDIR": scratch()}
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env=environment, check=False)
    text = done.stdout.decode(errors="replace")
    (directory / "console.txt").write_text(text)
    if done.returncode != 0:
        raise judge.Failed(f"verican linux ended with code {done.returncode}: "
                           f"{text.strip().splitlines()[-1] if text.strip() else 'no output'}")
    match = re.search(r"verican linux: ([0-9.]+) s of guest time", text)
    return float(match[1]) if match else 0.0, time.monotonic() - start


def same_runs(first, second):
    """Two runs of the same case leave the same files, but for the names of their directories."""
    def names_in(directory):
        return sorted(p.name for p in directory.iterdir()
                      if p.name not in ("console.txt", "dmesg.txt"))
    names = names_in(first)
    judge.expect(names_in(second), names, "files")
    _, different, errors = filecmp.cmpfiles(first, second, names, shallow=False)
    judge.expect(different + errors, [], "files that differ between two runs")


def run_case(args, case, chip):
    """Runs and judges; never raises for what a guest does."""
    directory = args.build / "out" / f"{chip}-{case.name}"
    result = Result(case, chip, False)
    run = judge.Run(directory, compatible(chip),
                    {"VERICAN_SCRIPTS": case.script, **case.settings})
    try:
        result.guest, result.wall = boot(args, case, chip, directory)
        judge.common(run)
        of_judges(case.script)(run)
        if case.twice:
            again = directory.with_name(directory.name + "-again")
            guest, wall = boot(args, case, chip, again)
            result.guest += guest
            result.wall += wall
            same_runs(directory, again)
        result.ok = True
    except (judge.Failed, ValueError, KeyError, IndexError) as error:
        result.message = f"{type(error).__name__}: {error}" if not isinstance(
            error, judge.Failed) else str(error)
    result.notes = run.notes
    if case.red:
        result.ok = not result.ok
        result.message = f"noticed: {result.message}" if result.ok else "the judge noticed nothing"
    return result


def show(result):
    """One line of the table."""
    notes = result.notes
    counted = f"{notes['frames']:6d}" if "frames" in notes and not result.case.red else "     -"
    load = f"{100 * notes['load']:6.1f}" if "load" in notes and not result.case.red else "     -"
    print(f"{'pass' if result.ok else 'FAIL'}  {result.chip:14} {result.case.name:19}{counted}  "
          f"{load}  {result.guest:7.3f}  {result.wall:6.1f}"
          f"{'' if result.ok and not result.case.red else '  ' + result.message[:90]}", flush=True)


def options():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--verican", type=Path, default=ROOT / "build/release/verican")
    parser.add_argument("--build", type=Path, default=ROOT / "build/linux",
                        help="where sw/linux/build.sh has built")
    parser.add_argument("--short", action="store_true", help="the cases that take seconds")
    parser.add_argument("--only", help="cases whose chip-name matches this regular expression")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=int, default=600, help="seconds for one guest")
    args = parser.parse_args()
    for name in ("jobs", "timeout"):
        if getattr(args, name) < 1:
            parser.error(f"--{name} {getattr(args, name)}: at least 1 is needed")
    try:
        re.compile(args.only or "")
    except re.error as error:
        parser.error(f"--only {args.only!r}: no regular expression: {error}")
    args.build = args.build.resolve()
    args.verican = args.verican.resolve()
    for path in (args.verican, args.build / "modules/linux"):
        if not path.exists():
            parser.error(f"{path} is missing; `make test-linux` builds it")
    return args


def main():
    """Runs all, prints the table and the sum."""
    args = options()
    start = time.monotonic()
    work = [(case, chip) for case in cases(args.short) for chip in case.chips
            if not args.only or re.search(args.only, f"{chip}-{case.name}")]
    if not work:
        sys.exit(f"test-linux: no case matches {args.only!r}")
    print("      compatible     case                frames  load %  guest s  real s")
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for result in pool.map(lambda item: run_case(args, *item), work):
            failed += not result.ok
            show(result)
    print(f"{len(work) - failed} of {len(work)} cases passed in {time.monotonic() - start:.0f} s; "
          f"their files are in {args.build / 'out'}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

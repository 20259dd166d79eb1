#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Line, branch and toggle coverage of the RTL over the regression (docs/coverage.md).

Builds build/coverage (CMake preset `coverage`), runs the test programs of build/coverage/regression
.txt in it and prints what of rtl/ they reached, exclusions apart. Fails if a test fails, if an
exclusion is hit or excludes nothing, or if a figure is below its bar. Stage `coverage` of the
campaign: CAMPAIGN_OUT, CAMPAIGN_DIR, CAMPAIGN_SEED and CAMPAIGN_SCALE are in docs/verification.md.
"""
import argparse
import concurrent.futures
import glob
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

from rtlcov import exclusions as exclusion_file
from rtlcov import points, report

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.append(os.path.join(ROOT, "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position

BUILD = "build/coverage"
MATRIX = "build/campaign/matrix.json"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--only", metavar="PROGRAM", nargs="+", help="run these test programs only")
    parser.add_argument("--no-build", action="store_true", help=f"{BUILD} is built already")
    parser.add_argument("--no-run", action="store_true", help="report on the files of the last run")
    parser.add_argument("--missed", action="store_true", help="list every point that was not hit")
    parser.add_argument("--jobs", type=campaign_settings.JOBS.option, default=2,
                        help="programs at a time (default 2)")
    parser.add_argument("--out", help="directory for the counts (default build/coverage/counts)")
    parser.add_argument("--exclusions", default="tb/coverage/exclusions.yaml", metavar="FILE")
    return parser.parse_args()


def build(jobs):
    log = f"{BUILD}.log"
    os.makedirs("build", exist_ok=True)
    print(f"building {BUILD} (log: {log})", flush=True)
    with open(log, "w", encoding="utf-8") as out:
        for command in (["cmake", "--preset", "coverage"],
                        ["cmake", "--build", BUILD, "-j", str(jobs), "--target", "regression"]):
            if subprocess.run(command, stdout=out, stderr=out, check=False).returncode:
                raise points.CoverageError(f"{' '.join(command)} failed, see {log}")


def programs(only):
    with open(f"{BUILD}/regression.txt", encoding="utf-8") as file:
        names = file.read().splitlines()
    for name in only or []:
        if name not in names:
            raise points.CoverageError(f"{name} is not in {BUILD}/regression.txt")
    return only or names


def run_program(name, directory, shards):
    """Runs a line of regression.txt; returns it and, if it failed, the path of its output."""
    log = f"{directory}/{os.path.basename(name).replace(' /dev/null', '').replace(' ', '_')}.log"
    environment = os.environ | {"VERICAN_COVERAGE_DIR": directory, "GTEST_BRIEF": "1"}
    program, _, bus = name.partition("@")
    if bus:
        environment["VERICAN_TEST_BUS"] = bus
    if shards > 1:
        seed = campaign_settings.seed()
        environment |= {"GTEST_TOTAL_SHARDS": str(shards), "GTEST_SHARD_INDEX": str(seed % shards)}
    with open(log, "w", encoding="utf-8") as out:
        done = subprocess.run(f"{BUILD}/tb/{program}".split(), stdout=out, stderr=out,
                              stdin=subprocess.DEVNULL, env=environment, check=False)
    return name, log if done.returncode else None


def clear(directory):
    """Makes `directory`, without the counts of the run before; one with anything else in it is not
    ours, and is left as it is."""
    os.makedirs(directory, exist_ok=True)
    files = list(Path(directory).iterdir())
    for path in files:
        if not re.search(r"\.(log|dat[^/]*)$", path.name) or not path.is_file():
            raise points.CoverageError(f"{path} is not of a run of this program: name another "
                                       "folder, or remove it")
    for path in files:
        path.unlink()


def run(names, directory, shards, jobs):
    clear(directory)
    failed, last = [], time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        tasks = [pool.submit(run_program, name, directory, shards) for name in names]
        for number, task in enumerate(concurrent.futures.as_completed(tasks), 1):
            name, log = task.result()
            if log:
                failed.append(name)
                print(f"{name} FAILED, see {log}", flush=True)
            if time.monotonic() - last > 10:
                last = time.monotonic()
                print(f"{number} of {len(names)} programs", flush=True)
    return failed


def functional():
    """TH-05 as the matrix stage has counted it, if it has run."""
    if not os.path.exists(MATRIX):
        return [{"name": "TH-05 bins", "value": 0, "text": "not counted: no stage matrix here",
                 "bar": "100 %", "ok": None}]
    with open(MATRIX, encoding="utf-8") as file:
        return [f for f in json.load(file)["figures"] if f["name"].startswith("TH-05")]


def write_result(path, files, exclusions, complete, problems):
    if not path:
        return
    figures = report.figures(files, exclusions, complete) + functional()
    figures.append({"name": "RTL exclusions that are wrong", "value": len(problems), "bar": "0",
                    "ok": not problems})
    notes = ["Exclusions and their reasons: tb/coverage/exclusions.yaml."]
    if not complete:
        notes.append("A part of the tests only: not held against the bar.")
    with open(path, "w", encoding="utf-8") as out:
        json.dump({"figures": figures, "tables": report.tables(files), "notes": notes}, out,
                  indent=1)


def main():
    args = arguments()
    os.chdir(ROOT)
    part, result = campaign_settings.scale(), campaign_settings.result_file()
    directory = args.out or os.path.join(os.environ.get("CAMPAIGN_DIR", BUILD), "counts")
    directory = os.path.abspath(directory)
    failed, start = [], time.monotonic()
    if not args.no_run:
        if not args.no_build:
            build(args.jobs)
        start = time.monotonic()
        failed = run(programs(args.only), directory, max(1, round(1 / part)), args.jobs)
    paths = sorted(glob.glob(f"{glob.escape(directory)}/*.dat*"))
    if not paths:
        raise points.CoverageError(f"no coverage files in {directory}")
    counts = points.read_counts(paths)
    exclusions = exclusion_file.load(args.exclusions)
    problems = exclusion_file.apply(exclusions, counts)
    excluded = {p for e in exclusions for p in e.points}
    files = report.tally(counts, excluded)
    complete = part == 1 and not args.only and not args.no_run
    print(report.text(files))
    missed = report.missed(counts, excluded)
    limit = len(missed) if args.missed else 20
    print("\n".join(["not hit:"] + missed[:limit]) if missed else "nothing missed")
    if len(missed) > limit:
        print(f"... and {len(missed) - limit} more (--missed --no-run)")
    print("\n".join(problems))
    write_result(result, files, exclusions, complete, problems)
    print(f"{len(paths)} files, {time.monotonic() - start:.0f} s"
          + (f"; FAILED: {' '.join(failed)}" if failed else ""))
    low = complete and any(f["ok"] is False for f in report.figures(files, exclusions, True))
    return 1 if failed or problems or low else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (points.CoverageError, OSError) as error:
        sys.exit(f"coverage: {error}")

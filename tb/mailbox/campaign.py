#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Stage `buffers` of the campaign: random software beside the model of the buffers, many seeds.

Runs the suites of buffer_random_test with other seeds than `make test` has (VERICAN_RANDOM_SEEDS),
CAMPAIGN_JOBS programs at a time, and writes figures to CAMPAIGN_OUT if that is set. Ends with
status 1 if core and model differ, or a program crashes, hangs, or runs fewer seeds than it was
asked for. A seed that fails is repeated with the line that is printed for it.
"""
import argparse
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position
import gtest_run  # noqa: E402  pylint: disable=wrong-import-position
from shards import Shard  # noqa: E402  pylint: disable=wrong-import-position

PROGRAM = ROOT / "build/release/tb/buffer_random_test"
# Suites with their seeds at scale 1, and what their software does.
SUITES = {
    "Random": (6000, "reads, writes, sends and aborts at any clock"),
    "RandomAtEvents": (6000, "the same with few buffers, at moments at which the core works on "
                             "them"),
    "RandomLives": (12000, "the same, and takes the core off the bus: freeze, disable, soft reset, "
                           "with and without the FIFO"),
    "RandomSmall": (3000, "as Random, on the profile *small*"),
    "RandomAtEventsSmall": (3000, "as RandomAtEvents, on the profile *small*"),
}
BLOCK = 100      # seeds of a program
TIMEOUT = 600    # s; a program needs some 20
FIRST = 100_000  # below are the seeds of `make test` and those that found something


def blocks(seed, scale):
    """[(suite, first seed, seeds)]: all of the stage, other ones for each of 4,000 seeds of it."""
    start = FIRST + seed % 4000 * 1_000_000
    result = []
    for suite, (seeds, _) in SUITES.items():
        wanted = max(1, round(seeds * scale))
        result += [(suite, start + done, min(BLOCK, wanted - done))
                   for done in range(0, wanted, BLOCK)]
    return result


def run(block, program, scratch):
    """A block: what it is, seeds passed, and the seeds (or what else) that failed."""
    suite, first, seeds = block
    log = scratch / f"{suite}-{first}.log"
    name = f"Seeds/{suite}.Lockstep"
    variables = {"VERICAN_RANDOM_SEEDS": f"{first}+{seeds}"}
    try:
        passed, bad = gtest_run.run([program, f"--gtest_filter={name}/*"], log, ROOT,
                                    timeout=TIMEOUT, **variables)
    except subprocess.TimeoutExpired:
        passed, bad = 0, 1
    if passed == seeds and not bad:
        log.unlink()
        return {"suite": suite, "passed": passed, "failed": []}
    numbers = re.findall(rf"^\[  FAILED  \] {name}/(\d+), where", log.read_text(errors="replace"),
                         re.MULTILINE)
    failed = [str(first + int(number)) for number in sorted(set(numbers), key=int)]
    failed = failed or [f"{first} to {first + seeds - 1}"]
    for each in failed:
        seed = each.split()[0]
        print(f"{suite}: {each} failed, see {log}\n  again: VERICAN_RANDOM_SEEDS={seed}+1 "
              f"build/release/tb/buffer_random_test --gtest_filter='{name}/0'", flush=True)
    return {"suite": suite, "passed": passed, "failed": failed}


def summary(results, wanted):
    """The result of the stage."""
    rows, failures = [], 0
    for suite, (_, text) in SUITES.items():
        mine = [result for result in results if result["suite"] == suite]
        failed = [seed for result in mine for seed in result["failed"]]
        rows.append([suite, text, sum(result["passed"] for result in mine), ", ".join(failed)])
        failures += len(failed)
    passed = sum(row[2] for row in rows)
    figures = [
        {"name": "random runs of the buffers", "value": passed, "bar": f"all {wanted:,}",
         "ok": passed == wanted},
        {"name": "runs in which core and model differ", "value": failures, "bar": "0",
         "ok": failures == 0}]
    tables = [{"title": "Suites", "columns": ["suite", "software", "runs that passed",
                                              "seeds that failed"], "rows": rows}]
    return {"figures": figures, "tables": tables,
            "notes": ["A run: 300 steps of traffic and software at 8 clocks a bit; what the core "
                      "shows is compared with the model at each access and, on a quiet bus, "
                      "whole."]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=PROGRAM, help="the test program")
    program = parser.parse_args().program
    scale, seed = campaign_settings.scale(), campaign_settings.seed()
    jobs, out = campaign_settings.jobs(), campaign_settings.result_file()
    if not program.is_file():
        campaign_settings.fail(f"{program} is missing; build it, or name another with --program")
    scratch = Path(os.environ.get("CAMPAIGN_DIR", ROOT / "build/campaign/buffers")).resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    shard, work = Shard(), blocks(seed, scale)
    if shard.kind == "merge":
        results = [result for part in shard.read(scratch) for result in part]
    else:
        with ThreadPoolExecutor(jobs) as pool:
            results = list(pool.map(lambda block: run(block, program, scratch), shard.mine(work)))
    if shard.kind == "part":
        shard.write(scratch, results)
        return 0
    return campaign_settings.write_result(out, summary(results, sum(block[2] for block in work)))


if __name__ == "__main__":
    sys.exit(main())

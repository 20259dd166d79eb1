#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""run.py [--build BUILD]: the tests that apply, on each core that lacks one feature and on the
profiles that lack some.

Runs what `cmake --preset features` has built. A core that lacks one feature has 64 buffers and
takes the place of the full one (VERICAN_TEST_BUILD, tb/harness/core_build.hpp), so that the tests
are those of the full core; NEEDS says which ask for a feature. Writes figures to CAMPAIGN_OUT if
that is set. Ends with status 1 if a test fails, or a program has run none or not on its build.
"""
import argparse
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position
import gtest_run  # noqa: E402  pylint: disable=wrong-import-position

BINARIES = ROOT / "build/features/tb"
# Programs with the filter of their tests on a core of 64 buffers with all features.
PROGRAMS = {
    "register_map_test": "*/full", "read_effects_test": "*full64*",
    "buffer_random_test": "*/Random.*:*/RandomAtEvents.*", "can_saturation_test": "*_full",
    "buffer_lock_race_test": "*", "buffer_send_race_test": "*", "buffer_fifo_test": "*",
    "rx_fifo_test": "*", "rx_fifo_order_test": "*", "tx_abort_test": "*", "tx_priority_test": "*",
    "can_lock_test": "*", "can_modes_test": "*", "one_shot_test": "*", "remote_answer_test": "*",
    "esr2_crcr_test": "*", "driver_traffic_test": "*", "driver_abort_test": "*"}
# Of these, which run one test in so many, other ones on each build: they differ in the clock of an
# access alone.
SAMPLED = {"buffer_lock_race_test": 7, "buffer_send_race_test": 3}
# What asks for a feature, by the build that lacks it: the filter, "*" for all of a program. Besides
# the tests of the feature: many take every frame by a buffer's own mask (no_own_masks), cut the
# number of buffers by MAXMB, or leave CTRL2.RRS at 0 (no_extras).
NEEDS = {
    "no_fifo": {
        "buffer_fifo_test": "*", "rx_fifo_test": "*", "rx_fifo_order_test": "*",
        "tx_priority_test": "*BuffersOfTheRxFifo*", "remote_answer_test": "*FifoTakes*",
        "esr2_crcr_test": "*AreaOfTheRxFifo*"},
    "no_abort": {
        "buffer_send_race_test": "*_Aen:*OfAnAnswer*", "tx_abort_test": "Abort.*:Guard.WordsOf*",
        "driver_abort_test": "*/WithAen",
        "esr2_crcr_test": "*BlockedWrites*:Crcr.OfEveryFrameSent"},
    "no_status": {"esr2_crcr_test": "*"},
    "no_own_masks": {
        "buffer_lock_race_test": "*_Queue_*",
        "buffer_fifo_test": "*/?Bcc:*FirstBcc:*FifoTable.*", "rx_fifo_order_test": "*",
        "rx_fifo_test": "*ClearsItsFlagsAtOnce:*OverALockedBuffer",
        "tx_abort_test": "Abort.AtEveryClockOfAFrameThatSucceeds:Deactivate.AtEvery*:Replace.*",
        "tx_priority_test": "*PrioIsNotSent",
        "can_lock_test": "*ReplacesTheProg*:*WithoutEacen:*LowestFree*:*EmptyBufferIsNotLocked*:"
                         "*MaskBitsOfZero*:*CancelsTheWaiting*",
        "one_shot_test": "*SuccessIsAsUsual",
        "can_modes_test": "*IsReadableInDisableMode:*WhatSection2Says",
        "remote_answer_test": "*"},
    "no_wake": {},
    "no_extras": {
        "buffer_fifo_test": "*RandomTables*", "rx_fifo_order_test": "*Tsyn*",
        "buffer_send_race_test": "*OfAnAnswer*", "tx_priority_test": "*Prio*:*LateWinner*",
        "can_lock_test": "*BeyondMaxmb*:*Tsyn*:*RemoteFramesAreNotStored",
        "one_shot_test": "*WithoutAck*:*LostArb*:*OnlyTheBuffer*",
        "can_modes_test": "SoftReset.*", "remote_answer_test": "*",
        "driver_abort_test": "*OneShot*",
        "esr2_crcr_test": "*AnyWrites:*OutsideTheArbitration*:*NoInactiveBuffer"},
    "no_clear_ram": {}}
# What runs on the profiles, most of it under their names; all else is for *full*, in `make test`.
PROFILES = {
    name: {"register_map_test": f"*/{name}", "read_effects_test": f"*/{name}",
           "buffer_random_test": "*/Random.*:*/RandomAtEvents.*", "driver_profiles_test": "*"}
    for name in ("small", "standard")}
PROFILES["small"] |= {"can_saturation_test": "*_small"}


def single_builds():
    """The builds that lack one feature, as the register map has them."""
    text = subprocess.run([sys.executable, "-B", ROOT / "tools/profiles.py", "--single"], cwd=ROOT,
                          capture_output=True, text=True, check=True).stdout
    return [line.split()[0] for line in text.splitlines()]


def filters(build):
    """{program: filter} of a build."""
    if build in PROFILES:
        return PROFILES[build]
    needs = NEEDS[build]
    return {program: f"{tests}-{needs[program]}" if program in needs else tests
            for program, tests in PROGRAMS.items() if needs.get(program) != "*"}


def run(build, index, program, tests, scale, scratch):
    """One program on the build of this number: tests passed, tests failed."""
    log = scratch / f"{build}.{program}.log"
    shards = max(1, round((SAMPLED.get(program, 1) if build in NEEDS else 1) / scale))
    passed, bad = gtest_run.run(
        [BINARIES / program, f"--gtest_filter={tests}"], log, ROOT, VERICAN_TEST_BUILD=build,
        GTEST_TOTAL_SHARDS=str(shards), GTEST_SHARD_INDEX=str(index % shards))
    if passed and build in NEEDS and f"on {build}\n" not in log.read_text(errors="replace"):
        bad += 1                                # on another core
    if scale == 1 and not passed:
        bad = max(bad, 1)
    if bad:
        print(f"{build}: {program}: {bad} failed, see {log}", flush=True)
    return passed, bad


def campaign(builds, jobs, scale, scratch):
    """The result of the stage."""
    figures, rows = [], []
    for build in builds:
        programs, index = filters(build), list(NEEDS | PROFILES).index(build)
        with ThreadPoolExecutor(jobs) as pool:
            outcomes = pool.map(lambda item, build=build, index=index:
                                run(build, index, *item, scale, scratch), programs.items())
            passed, failed = map(sum, zip(*outcomes))
        print(f"{build}: {passed} passed, {failed} failed", flush=True)
        rows.append([build, len(programs), passed, failed])
    for name, part in (("cores that lack one feature", NEEDS), ("profiles", PROFILES)):
        mine = [row for row in rows if row[0] in part]
        passed, failed = (sum(row[column] for row in mine) for column in (2, 3))
        figures.append({"name": f"tests passed on {name}", "value": passed,
                        "text": f"{passed} of {passed + failed}", "bar": "all",
                        "ok": failed == 0 and (passed > 0 or not mine)})
    tables = [{"title": "Builds", "columns": ["build", "test programs", "passed", "failed"],
               "rows": rows}]
    return {"figures": figures, "tables": tables, "notes": []}


def main():
    builds = [*single_builds(), *PROFILES]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", action="append", choices=builds, help="default: all")
    arguments = parser.parse_args()
    jobs, scale = campaign_settings.jobs(), campaign_settings.scale()
    out = campaign_settings.result_file()
    scratch = Path(os.environ.get("CAMPAIGN_DIR", ROOT / "build/features/run"))
    scratch.mkdir(parents=True, exist_ok=True)
    result = campaign(arguments.build or builds, jobs, scale, scratch)
    sys.exit(campaign_settings.write_result(out, result))


if __name__ == "__main__":
    main()

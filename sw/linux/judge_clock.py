# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a run of a script with hardware clocks must have left behind: one function a script."""
import re

import clock_log
from judge import Failed, expect, expect_true

SECOND = 10**9
PPM = (40, -25)  # of the two oscillators


def follow(run, number):
    """The clock of a controller by the rule, and its readings; every reading has been compared."""
    path = run.dir / f"access-{number}.txt"
    expect_true(path.exists(), f"{path.name} is missing")
    try:
        return clock_log.check(clock_log.read_accesses(path), PPM[number])
    except ValueError as error:
        raise Failed(str(error)) from None


def shown(text):
    """The times that phc_ctl says a clock shows, ns."""
    found = re.findall(r"clock time is (\d+)\.(\d{9}) or", text)
    return [int(seconds) * SECOND + int(ns) for seconds, ns in found]


def expect_near(found, wanted, tolerance, what):
    """All in ns."""
    if abs(found - wanted) > tolerance:
        raise Failed(f"{what}: {found}, expected {wanted} +- {tolerance}")


def ptpprobe(run):
    expect(run.text("names.txt").split(), ["verican", "verican"], "names of the clocks")
    expect_true("driver: flexcan" in run.text("driver.txt"), "the CAN driver is not beside it")
    caps = run.text("caps.txt")
    for line in ("100000000 maximum frequency adjustment", "1 external time stamp channels",
                 "1 programmable periodic signals", "0 configurable input/output pins",
                 "has pulse per second support"):
        expect_true(line in caps, f"capabilities: no {line!r} in {caps!r}")
    lines = run.text("interrupts.txt")
    expect_true("e0001000.clock" in lines and "e0003000.clock" in lines, "no interrupts")
    # 2 s of the guest are 2 s of the simulator; a script's programs take some accesses more.
    (first,) = shown(run.text("set0.txt"))
    expect_near(first, 1_000_000_002_500_000_000 + 2 * 1000 * PPM[0], 20_000, "clock 0 after 2 s")
    (second,) = shown(run.text("set1.txt"))
    expect_near(second, 2_000_000_000_250_000_000, 20_000, "clock 1")
    for number in (0, 1):
        clock, readings = follow(run, number)
        expect(set(clock.increments), {clock_log.CLOCK}, f"increment of clock {number}")
        expect(len(clock.increments), 2, f"probes of clock {number}")
        expect_true(len(readings) >= 2, f"readings of clock {number}")
        expect_true(not clock.unknown, f"clock {number} was never set")
    # The driver that comes back leaves the time.
    (before,), (after,) = shown(run.text("get0.txt")), shown(run.text("again0.txt"))
    expect_true(first < before < after < before + 100_000, "the time across a removal")

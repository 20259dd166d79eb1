# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a run of a script with hardware clocks must have left behind: one function a script."""
import re
from fractions import Fraction

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
    """TM-110: the driver binds with and without the CAN driver, and leaves the time."""
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


def ptpcalls(run):
    """TM-111: rates and shifts are the rule's; what is not allowed is refused."""
    clock, readings = follow(run, 0)
    expect_true(not clock.unknown and len(readings) >= 6, "readings")
    # phc_ctl has ppb, the kernel 2^-16 ppm: what is lost there is not the driver's.
    wanted = [0, 100_000, -100_000_000, 100_000_000, Fraction("12345.678"), 0]
    expect(len(clock.increments), len(wanted), "rates that were written")
    for found, ppb in zip(clock.increments, wanted):
        scaled = int(ppb * Fraction(65536, 1000))
        exact = clock_log.CLOCK * (1 + Fraction(scaled, 65536 * 10**6))
        expect_true(abs(found - exact) <= Fraction(1, 1 << 32),
                    f"increment for {ppb} ppb: {float(found)}, expected {float(exact)}")
    (fast,) = shown(run.text("fast.txt"))
    gain = (PPM[0] + 100) * 10 * 1000
    expect_near(fast, 1_000_000_010 * SECOND + gain, 20_000, "after 10 s at +100 ppm")
    back, forth = shown(run.text("shift.txt"))
    expect_near(back - fast, -3 * SECOND // 2, 50_000, "shift back")
    expect_near(forth - back, 86_400_250_000_000, 50_000, "shift forth")
    expect_true("out of range" in run.text("beyond.txt"), "a rate beyond max_adj was taken")
    expect([ns for ns in clock.slews if ns != 0], [-300_000, 1_000_000], "changes of the phase")
    (later,) = shown(run.text("set.txt"))
    half = SECOND // 2
    expect_near(later, 5_000_000_000 * SECOND + half + PPM[0] * half // 10**6, 20_000,
                "set during a change of the phase")

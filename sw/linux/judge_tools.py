# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a run of the tools of hardware clocks must have left behind: one function a script. Times
in ns."""
import re

from judge import expect, expect_true
from judge_clock import SECOND, expect_near, follow, shown
from judge_events import MS, asserts, edges, events, expect_output, expect_seconds, marks

FOLLOWS = 1000  # how well a clock must follow after a minute


def got(run, name):
    """What testptp -g shows."""
    seconds, ns = re.search(r"clock time: (\d+)\.(\d{9}) or", run.text(name)).groups()
    return int(seconds) * SECOND + int(ns)


def ptptools(run):
    """TM-113: testptp -c -g -s -t -n -f -e -p -P -k; phc_ctl set, get, adj, freq, cmp, wait."""
    clock, readings = follow(run, 0)
    now, system = map(int, run.text("system.txt").split())
    for name, said in (("set", "set time okay"), ("shift", "time shift okay"),
                       ("shiftns", "time shift okay"),
                       ("rate", "frequency adjustment okay"), ("perout", "okay"),
                       ("ppson", "okay"), ("ppsoff", "okay"),
                       ("caps", "100000000 maximum frequency adjustment")):
        expect_true(said in run.text(f"{name}.txt"), f"{name}: no {said!r}")
    first, second, third = (got(run, f"get{n}.txt") for n in (1, 2, 3))
    expect_near(first, system, 50_000, "set from the system")
    expect_near(second - first, 5 * SECOND, 50_000, "shift by -t 5")
    expect_near(third - second, SECOND // 4, 50_000, "shift by -n 250000000")
    rates = [float(found / clock.increments[0]) for found in clock.increments[1:3]]
    expect_near(rates[0], 1.00005, 1e-9, "rate by -f 50000")
    expect_near(rates[1], 1, 1e-12, "rate by freq 0")
    samples = re.findall(r"^phc +time: \d+\.\d{9}$", run.text("samples.txt"), re.M)
    expect(len(samples), 5, "samples by -k 5")
    expect_seconds(clock, asserts(run, "pulses.txt"), "pulse")
    at = marks(run)
    expect_output(edges(run), clock, (at["on"] - 2 * MS, at["off"]), MS // 2, MS, 95, "output")
    expect(len(events(run, 0)), 3, "events by -e 3")
    set_to, shifted = shown(run.text("phc.txt"))
    expect_near(shifted - set_to, 3 * SECOND // 2, 50_000, "adj 1.5")
    (offset,) = re.findall(r"offset from CLOCK_REALTIME is (-?\d+)ns", run.text("phc.txt"))
    expect_near(abs(int(offset)), 3 * SECOND // 2, 150_000, "cmp")
    expect_true(len(readings) >= 10, "readings of the clock")


def ptpphc2sys(run):
    """TM-113: after a minute the second clock shows what the first shows."""
    clock, _ = follow(run, 0)
    _, readings = follow(run, 1)
    minute = int(run.text("minute.txt"))
    errors = [float(value - clock.was(time)) for time, value in readings if time > minute]
    expect_true(len(errors) >= 10, "readings of the second clock")
    run.notes["clock"] = max(map(abs, errors))
    expect_near(max(errors, key=abs), 0, FOLLOWS, "second clock after a minute")


def ptpts2phc(run):
    """TM-113: after a minute the clock shows the system's seconds at the pulses."""
    clock, _ = follow(run, 0)
    now, system = map(int, run.text("system.txt").split())
    first = int(run.text("pulses.txt"))
    errors = []
    for pulse in range(60, 70):
        time = first + pulse * SECOND
        errors.append(float(clock.was(time) - (time - now + system)))
    run.notes["pin"] = max(map(abs, errors))
    expect_near(max(errors, key=abs), 0, FOLLOWS, "clock at the pulses after a minute")

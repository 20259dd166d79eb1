# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a run of a script with a clock's pins and pulses must have left behind: one function a
script. Edges of pins are the simulator's, in its time; the rule of the clock (clock_log.py) says
what the clock showed there. Times in ns."""
from fractions import Fraction

from clock_log import CLOCK
from judge import Failed, expect, expect_true
from judge_clock import SECOND, expect_near, follow

MS = 10**6
# From a compare to the pin, and one clock for where in a clock the first command acted.
PIN_DELAY = 4 * CLOCK


def marks(run):
    """{name: simulated time}."""
    return {name: int(time) for name, time in map(str.split, run.text("marks.txt").splitlines())}


def edges(run):
    """[(simulated time, level)] of the output of the first clock."""
    lines = (line.split() for line in run.text("edges.txt").splitlines())
    return [(Fraction(int(time), 1000), int(level)) for time, level in lines]


def expect_output(found, clock, span, first, half, least, what, from_first=False):
    """Within the span of simulated time the output rises when the clock shows first + 2 n half
    and falls half a period later, nothing left out; `least` edges; with from_first n begins at 0.
    What turns the output off may make it fall."""
    inside = [edge for edge in found if span[0] < edge[0] < span[1]]
    numbers = []
    for index, (time, level) in enumerate(inside):
        shown = clock.was(time) - first
        number = round(shown / half)
        if abs(shown - number * half) > PIN_DELAY or (number % 2 == 0) != bool(level):
            if index + 1 == len(inside) and not level and time > span[1] - 2 * MS:
                break
            raise Failed(f"{what}: at {float(time):.0f} the output goes to {level} when the clock "
                         f"is at {float(shown):+.1f} of the first edge, half a period is {half}")
        numbers.append(number)
    expect_true(len(numbers) >= least, f"{what}: {len(numbers)} edges, at least {least} expected")
    expect(numbers, list(range(numbers[0], numbers[0] + len(numbers))), f"{what}: edges in a row")
    if from_first:
        expect(numbers[0], 0, f"{what}: first edge")


def answers(run):
    """[(request, answer)]."""
    return [tuple(line.split(": ")) for line in run.text("answers.txt").splitlines()]


def ptpperout(run):
    """TM-112: start, phase, half duty, starts far ahead, re-arming, refusals."""
    clock, _ = follow(run, 0)
    found, at = edges(run), marks(run)
    base = 1_000_000_000 * SECOND
    expect_output(found, clock, (0, at["start"]), base + SECOND // 2, MS // 2, 190, "start", True)
    expect_output(found, clock, (at["start"], at["phase"]), 3 * MS, 5 * MS, 18, "phase")
    expect_output(found, clock, (at["phase"], at["far"]), base + 6_250_000_000, SECOND // 2, 6,
                  "start far ahead", True)
    expect_output(found, clock, (at["far"], at["shortest"]), 0, 2000, 490, "shortest period")
    expect_output(found, clock, (at["shortest"], at["longest"]), 0, 2_147_483_647, 3,
                  "longest period")
    jumps = [at[name] for name in ("longest", "forth", "back", "set", "jumps")]
    for lo, hi in zip(jumps, jumps[1:]):
        # The worker arms again soon after the jump; until then the output is off.
        expect_output(found, clock, (lo + 3 * MS, hi), 0, 50 * MS, 8, f"100 ms from {lo}")
    expect_true(all(time <= at["jumps"] for time, _ in found), "edges of an output that was off")
    given = answers(run)
    expect([answer for _, answer in given[-6:]],
           ["ERANGE", "ERANGE", "ERANGE", "ERANGE", "EOPNOTSUPP", "EOPNOTSUPP"], "refusals")
    expect({answer for _, answer in given[:-6]}, {"ok"}, "answers")


def events(run, number):
    """[(channel, time)] as testptp prints external events."""
    found = []
    for line in run.text(f"events{number}.txt").splitlines():
        words = line.split()
        if words[:2] == ["event", "index"]:
            seconds, ns = words[4].split(".")
            found.append((int(words[2]), int(seconds) * SECOND + int(ns)))
    return found


def ptpextts(run):
    """TM-112: an edge at the pin has the time that the clock showed there."""
    first = [int(word) for word in run.text("pulses.txt").split()]
    for number, period in ((0, 10_000_333), (1, 10_000_777)):
        clock, _ = follow(run, number)
        found = events(run, number)
        expect(len(found), 40, f"events of clock {number}")
        for n, (channel, shown) in enumerate(found):
            expect(channel, 0, "channel")
            expect_near(float(shown - clock.was(first[number] + n * period)), 0, float(2 * CLOCK),
                        f"event {n} of clock {number}: error")


def asserts(run, name):
    """[(number, simulated time)] of the pulses that the system noted."""
    now, system = map(int, run.text("system.txt").split())
    found = []
    for line in run.text(name).splitlines():
        time, number = line.split("#")
        seconds, ns = time.split(".")
        found.append((int(number), int(seconds) * SECOND + int(ns) - system + now))
    return found


def expect_seconds(clock, pulses, what):
    """Each pulse is where the clock shows a whole second."""
    for _, time in pulses:
        past = (clock.was(time) + SECOND // 2) % SECOND - SECOND // 2
        expect_near(float(past), 0, 20_000, what)


def ptppps(run):
    """TM-112: a pulse a second, alone and with an output of 1 s in phase, and with no other."""
    clock, _ = follow(run, 0)
    at = marks(run)
    pulses = asserts(run, "pulses.txt")
    expect([number for number, _ in pulses], list(range(1, 16)), "numbers of the pulses")
    expect_seconds(clock, pulses, "pulse")
    expect(asserts(run, "last.txt"), pulses[-1:], "last pulse")
    expect([answer for _, answer in answers(run)],
           ["ok", "EBUSY", "EBUSY", "ok", "ok", "ok", "ok", "EBUSY", "ok", "ok"], "answers")
    found = edges(run)
    expect_true(all(time > at["both"] - 3 * MS for time, _ in found), "an output without request")
    half = SECOND // 2
    expect_output(found, clock, (at["both"], at["shifted"]), 0, half, 9, "with pulses")
    expect_output(found, clock, (at["shifted"] + 3 * MS, at["jumped"]), 0, half, 5, "after a shift")
    expect_output(found, clock, (at["jumped"] + 3 * MS, at["output"]), 0, half, 3, "over a second")
    inside = [time for time, _ in found if at["jumped"] < time <= at["jumped"] + 3 * MS]
    expect_true(len(inside) <= 1, f"edges at a jump: {len(inside)}, the output falls once at most")
    expect_output(found, clock, (at["output"], at["off"]), 0, half, 3, "without pulses")


def ptpremove(run):
    """TM-112: the driver may go while edges and pulses come; the kernel says nothing of it."""
    clock, _ = follow(run, 0)
    expect(len(clock.increments), 4, "probes")
    expect(answers(run), 3 * [("pps 1", "ok")], "answers")
    for turn in (1, 2, 3):
        expect_true(run.text(f"pulse{turn}.txt").strip().endswith("#1"), f"pulse of turn {turn}")

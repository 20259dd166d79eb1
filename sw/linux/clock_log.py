# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a hardware clock must have shown, from the log of its registers' accesses: the rule of the
clock (time.md, TM-10 to TM-15) in exact fractions, without the core and without the driver."""
import re
from dataclasses import dataclass
from fractions import Fraction

TCTRL, TIMELO, TIMEHI, TINCN, TINCF = 0x1104, 0x1110, 0x1114, 0x1118, 0x111C
TSHLO, TSHHI, TSLEW, TCMP, TCMPH = 0x1120, 0x1124, 0x1128, 0x1130, 0x1134
NOMINAL = 8_000_000  # Hz, of the device tree
# A command acts four clocks after its write; the log has a write one or two later, a reading with
# its clock. One clock more or less where two oscillators share the time.
LATENCY = Fraction(4, NOMINAL) * 10**9
CLOCK = Fraction(1, NOMINAL) * 10**9
LINE = re.compile(r"(\d+\.\d{3}) ([RW]) ([0-9a-f]{3,4}) ([0-9a-f]{8}) ([01])$")


@dataclass(frozen=True)
class Access:
    """One line of a log; time in ns."""
    time: int
    write: bool
    offset: int
    value: int


def read_accesses(path):
    """[Access] of a log; ValueError names a line that is none."""
    accesses = []
    for line in path.read_text().splitlines():
        match = LINE.match(line)
        if not match:
            raise ValueError(f"{path}: no access: {line!r}")
        microseconds, kind, offset, value, _ = match.groups()
        accesses.append(Access(int(microseconds.replace(".", "")), kind == "W", int(offset, 16),
                               int(value, 16)))
    return accesses


def signed(value, bits):
    """Two's complement."""
    return value - (1 << bits) if value >> (bits - 1) else value


class Clock:
    """A clock whose oscillator is `ppm` fast, as its commands make it; times in ns."""

    def __init__(self, ppm):
        self.hertz = NOMINAL * (1 + Fraction(str(ppm)) / 10**6)
        self.since, self.base = Fraction(0), Fraction(0)
        self.increment = CLOCK
        self.held = 0
        self.slews_until = Fraction(0)
        self.increments = []  # ns a clock, each that was written
        self.slews = []
        self.unknown = True  # until it is set, the reset counts
        self.past = []  # (until, since, base, increment), oldest first

    def at(self, time):
        """What it shows."""
        return self.base + (time - self.since) * self.hertz * self.increment / 10**9

    def was(self, time):
        """What it showed at any time of the log."""
        for until, since, base, increment in self.past:
            if time < until:
                return base + (time - since) * self.hertz * increment / 10**9
        return self.at(time)

    def write(self, access):
        """A command."""
        now = access.time + LATENCY
        if access.offset in (TIMELO, TINCN, TSHLO):
            self.held = access.value
        pair = access.value << 32 | self.held
        if access.offset in (TIMEHI, TSHHI, TINCF, TSLEW):
            self.past.append((now, self.since, self.base, self.increment))
            self.base, self.since = self.at(now), now
        if access.offset == TIMEHI:
            self.base, self.unknown = Fraction(pair), False
        elif access.offset == TSHHI:
            self.base += signed(pair, 64)
        elif access.offset == TINCF:
            self.increment = (self.held & 0xFF) + Fraction(access.value, 1 << 32)
            self.increments.append(self.increment)
        elif access.offset == TSLEW:
            left = signed(access.value, 32)
            self.slews.append(left)
            self.base += left
            # SLEWR = 3: 1 ns in 1,024 of the clock's; 10 % slower at most.
            self.slews_until = now + abs(left) * 1200


def check(accesses, ppm):
    """Compares every reading with the rule. Returns the clock and [(time, shown)]; ValueError for
    the first that is off. Readings before the first set and during a slew are not judged."""
    clock, low, readings = Clock(ppm), None, []
    for access in accesses:
        if access.write:
            clock.write(access)
        elif access.offset == TIMELO:
            low = access
        elif access.offset == TIMEHI and low is not None:
            shown, wanted = access.value << 32 | low.value, clock.at(low.time)
            readings.append((low.time, shown))
            if clock.unknown or low.time < clock.slews_until:
                continue
            if abs(shown - wanted) > 2 * CLOCK:
                raise ValueError(f"at {low.time} ns the clock shows {shown}, not "
                                 f"{float(wanted):.1f}: {float(shown - wanted):+.1f}")
    return clock, readings

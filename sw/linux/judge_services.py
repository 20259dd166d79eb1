# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The broadcast manager and the gateway over the core: what a run must have left behind."""
import re
from dataclasses import replace

from frames import Frame
from judge import expect, expect_true

LOAD = 0x081


def _common(run, name):
    """What holds for each of these scripts; returns the bus's log without the third node's."""
    for device in ("can0", "can1"):
        run.same_as_bus(f"{name}-{device}.log", f"{name}-bus.log")
    run.counters_agree(name)
    expect_true(run.bus(name)["bus"]["errors"] > 5, "no errors on the bus")
    log = run.log(f"{name}-bus.log")
    run.notes["frames"] = len(log)
    return [(time, frame) for time, frame in log if frame.ident != LOAD]


# ---- Broadcast manager

def frames_of(log, ident):
    """The frames of an identifier in a log."""
    return [(time, frame) for time, frame in log if frame.ident == ident]


def contents(found):
    """The frames of 300: contents in turn, which change once."""
    data = [frame.data for _, frame in found]
    expect_true(len(data) > 16, f"only {len(data)} cyclic frames")
    changed = next(n for n, content in enumerate(data) if content[0] >= 0xA0)
    wanted = [bytes([n % 3] * (n % 3 + 1)) if n < changed else bytes([0xA0 + n % 3])
              for n in range(len(data))]
    expect(data, wanted, "contents of the cyclic frames, in turn")


def _cyclic(log):
    """12 of them each 5 ms, then each 20 ms."""
    found = frames_of(log, 0x300)
    contents(found)
    gaps = [after[0] - before[0] for before, after in zip(found, found[1:])]
    for n, gap in enumerate(gaps):
        period = 5_000 if n < 11 else 20_000
        # A frame waits for the third node's burst and for repetitions.
        expect_true(abs(gap - period) <= 4_500, f"cyclic frame {n + 1}: {gap} us after the last")
    # Late frames do not shift those that follow.
    late = found[10][0] - found[0][0] - 50_000
    expect_true(abs(late) <= 4_500, f"the eleventh cyclic frame is off by {late} us")


def told_in(text):
    """[(time, what, identifier, frames)] of the manager's messages."""
    lines = [line.split() for line in text.splitlines()]
    return [(int(words[0]), *words[1:3], words[3:]) for words in lines]


def changes(told):
    """Of 310: first sight, then what differs in the bits asked for, and nothing else."""
    found = [frames[0] for _, what, ident, frames in told
             if what == "RX_CHANGED" and ident == "310"]
    expect(found, ["310#0000000000000000", "310#0100000000000000", "310#0100000000000001",
                   "310#0000000000000001"], "changes of 310")


def _silence(told, log):
    """Of 320: silence once, 30 ms after the last frame before it, and again when it ends."""
    alive = frames_of(log, 0x320)
    expect({frame.data for _, frame in alive}, {b"alive", b"again"}, "frames of 320")
    last = [time for time, frame in alive if frame.data == b"alive"][-1]
    found = [(time, what) for time, what, ident, _ in told if ident == "320"]
    expect([what for _, what in found], ["RX_CHANGED", "RX_TIMEOUT", "RX_CHANGED"],
           "messages of 320")
    first = next(time for time, frame in alive if frame.data == b"again")
    # The clock of the guest and that of the bus begin elsewhere: differences are compared.
    quiet = found[1][0] - found[0][0] - (last - alive[0][0])
    expect_true(abs(quiet - 30_000) <= 1_000, f"silence was noticed after {quiet} us")
    expect_true(abs(found[2][0] - found[0][0] - (first - alive[0][0])) <= 1_000,
                "the end of the silence was noticed late")


def bcm(run):
    log = _common(run, "bcm")
    told = told_in(run.text("bcm.txt"))
    _cyclic(log)
    expect([what for _, what, ident, _ in told if ident == "300"], ["TX_EXPIRED"],
           "messages of 300")
    changes(told)
    _silence(told, log)
    expect([(frame.remote, frame.data) for _, frame in frames_of(log, 0x330)],
           [(True, b""), (False, b"answer")], "remote frame and its answer")


# ---- Gateway

def _set(frame):
    """SET:IL:333.4.1122334455667788 on frames of 8 bytes: four of them."""
    return replace(frame, ident=0x333, dlc=4, data=frame.data[:4])


def _masks(frame):
    """AND, OR and XOR of data, XOR of the identifier; only bytes that are there count."""
    both = [(byte & 0x0F) for byte in frame.data]
    if both:
        both[0] |= 0x80
    if len(both) == 8:
        both[7] ^= 0xFF
    return replace(frame, ident=frame.ident ^ 0x0FF, data=bytes(both))


def _checksum(frame):
    """-x 0:6:7:00: byte 7 is the XOR of bytes 0 to 6; shorter frames have no such byte."""
    if frame.dlc < 8:
        return frame
    total = 0
    for byte in frame.data[:7]:
        total ^= byte
    return replace(frame, data=frame.data[:7] + bytes([total]))


def _to_network(frame):
    """What the rules make of a frame of the bus, or None."""
    if not frame.extended and frame.ident & 0x700 == 0x100:
        return _set(frame)
    if not frame.extended and frame.ident & 0x700 == 0x200:
        return _masks(frame)
    if not frame.extended and frame.ident & 0x700 == 0x300:
        return _checksum(frame)
    if frame.extended and frame.ident & 0x1FFFFF00 == 0x12345600:
        return frame
    return None


def gateway(run):
    log = [frame for _, frame in _common(run, "gateway")]
    network = [frame for _, frame in run.log("vcan0.log")]
    from_bus = [made for made in map(_to_network, log) if made]
    expect([frame for frame in network if frame.ident != 0x4C4], from_bus, "from bus to network")
    from_network = [replace(frame, ident=0x4C5) for frame in network if frame.ident == 0x4C4]
    expect(len(from_network), 20, "frames of the network")
    expect([frame for frame in log if frame.ident == 0x4C5], from_network, "from network to bus")
    expect([replace(frame, ident=0x500) for frame in log if frame.ident == 0x501],
           [frame for frame in log if frame.ident == 0x500], "from bus to bus")
    expect(len([frame for frame in log if frame.ident == 0x500]), 20, "frames of 500")
    handled = [int(n) for n in re.findall(r"# (\d+) handled", run.text("rules.txt"))]
    expect(sorted(handled), sorted([20, 30, 30, 20, 20, 20]), "frames that the rules handled")


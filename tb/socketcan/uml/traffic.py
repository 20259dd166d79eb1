# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Full buses: what programs and nodes must have sent, and who must have seen it."""
import random

from canlog import Frame, candump, expect, expect_true, frames, merged, read, same


def cangen(count, ident=None, extended=False, remote=False, dlc=None, data=None):
    """The frames of `cangen -g 0 -n count`, as its manual tells.

    ident, dlc, data: fixed values (-I, -L, -D), or None for increasing ones (-I i, -L i, -D i).
    """
    result = []
    mask = 0x1FFFFFFF if extended else 0x7FF
    for number in range(count):
        length = number % 9 if dlc is None else dlc
        if remote:
            content = b""
        elif data is None:
            length = max(length, 1)  # "the data length code minimum is set to 1"
            content = number.to_bytes(8, "little")[:length]
        else:
            content = data[:length]
        result.append(Frame(number & mask if ident is None else ident, extended, remote, length,
                            content))
    return result


def counter(count, ident, extended, dlc):
    """The frames of a scenario's message with `data: counter`."""
    return [Frame(ident, extended, False, dlc, number.to_bytes(8, "little")[:dlc])
            for number in range(count)]


# One transmit buffer: among several, a core sends equal identifiers in the order of the buffers.
FLOOD = """\
name: both ways
bitrate: 1M
duration: 1000 s
nodes:
  - {name: other, ppm: 80, tx_buffers: 1}
traffic:
  - {node: other, name: a, id: 0x700, data: counter, dlc: 8, period: saturated, count: 2500}
  - {node: other, name: b, id: 0x1ABCDEF0, extended: true, data: counter, dlc: 4,
     period: saturated, count: 2500}
  - {node: other, name: c, id: 0x7FF, data: counter, dlc: 2, period: saturated, count: 2300}
  - {node: other, name: d, id: 0x1FFFFFFF, extended: true, data: counter, dlc: 8,
     period: saturated, count: 2500}
  - {node: other, name: e, id: 0x7EF, remote: true, dlc: 3, period: saturated, count: 200}
"""


def flood_senders():
    """Who sends what in the flood: one sequence of the interface, one of each message."""
    program = (cangen(1792) + cangen(1792, data=bytes.fromhex("1122334455667788"))
               + cangen(3000, extended=True) + cangen(1624, extended=True, data=b"\xff" * 8)
               + cangen(896, remote=True) + cangen(896, extended=True, remote=True))
    messages = {"a": counter(2500, 0x700, False, 8), "b": counter(2500, 0x1ABCDEF0, True, 4),
                "c": counter(2300, 0x7FF, False, 2), "d": counter(2500, 0x1FFFFFFF, True, 8),
                "e": [Frame(0x7EF, False, True, 3, b"")] * 200}
    return program, messages


def statistics(run, interface, packets):
    """The kernel's counters. What comes from a program counts both ways, a vcan loops it back."""
    expect(run.packets(f"{interface}.json"), (packets, packets, 0),
           f"{interface}: packets received, sent, dropped")


def rate(entries):
    """Frames a second, real time."""
    return (len(entries) - 1) * 1e6 / max(1, entries[-1].time - entries[0].time)


def flood(run):
    """Nothing lost, nothing added, each sender's order kept; the bridge's log is what was seen."""
    program, messages = flood_senders()
    senders = {"cangen": program, **messages}
    expect(sum(map(len, messages.values())), len(program), "frames each way")
    bus, seen = (read(run.dir / f"{name}.log") for name in ("bus", "vcan0"))
    merged(frames(bus), senders, "bus")
    merged(frames(seen), senders, "vcan0")
    own = set(program)
    same([f for f in frames(seen) if f not in own], [f for f in frames(bus) if f not in own],
         "order of the other nodes' frames at vcan0")
    # Both ways at once: neither side's frames came after all of the other's.
    where = [number for number, frame in enumerate(frames(bus)) if frame in own]
    expect_true(where[-1] > 2000 and where[0] < 18000, f"not at once: {where[0]}, {where[-1]}")
    expect((len(seen), len(bus)), (20000, 20000), "lines: frames, and no error messages")
    run.ended("bridge")
    statistics(run, "vcan0", 20000)
    statistics(run, "mon0", 20000)
    return [f"frames a second, both ways together: {rate(seen):.0f}"]


def duel_senders():
    """Four programs, two on each interface, each with identifiers of its own at random.

    They increase, so that the next of one side is now below, now above that of the other.
    """
    source = random.Random(20161)
    programs = {}
    for number, name in enumerate(("vcan0-a", "vcan0-b", "vcan1-a", "vcan1-b")):
        kinds = []
        for _ in range(1000):
            extended = source.random() < 0.5
            ident = source.getrandbits(27 if extended else 9) << 2 | number
            kinds.append((ident if extended else ident << 18, extended, ident))
        programs[name] = []
        for count, (_, extended, ident) in enumerate(sorted(kinds)):
            remote = source.random() < 0.1
            dlc = source.randrange(1 if remote else 3, 9)
            data = b"" if remote else count.to_bytes(2, "big") + source.randbytes(dlc - 2)
            programs[name].append(Frame(ident, extended, remote, dlc, data))
    return programs


def duel_files():
    """Logs for canplayer: {name: text}."""
    return {f"{name}.sent": "".join(f"(0.000000) can0 {candump(frame)}\n" for frame in sent)
            for name, sent in duel_senders().items()}


def duel(run):
    """Both interfaces see all frames: their own at once, those of the other in the bus's order."""
    programs = duel_senders()
    bus = frames(read(run.dir / "bus.log"))
    merged(bus, programs, "bus")
    for name in ("vcan0", "vcan1"):
        seen = frames(read(run.dir / f"{name}.log"))
        merged(seen, programs, name)
        mine = {frame for program, sent in programs.items() if program.startswith(name)
                for frame in sent}
        same([f for f in seen if f not in mine], [f for f in bus if f not in mine],
             f"order of the other side's frames at {name}")
        # One node: what its programs wrote leaves in the order in which they wrote it.
        same([f for f in bus if f in mine], [f for f in seen if f in mine],
             f"order of the frames of {name}'s programs")
        statistics(run, name, 4000)
    left = {frame for name in ("vcan0-a", "vcan0-b") for frame in programs[name]}
    turns = sum((a in left) != (b in left) for a, b in zip(bus, bus[1:]))
    expect_true(turns > 400, f"the sides took turns {turns} times only")
    run.ended("bridge")
    return [f"the sides took turns {turns} times"]

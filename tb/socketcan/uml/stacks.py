# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The kernel's stacks over bridged buses: J1939, the broadcast manager, a gateway between two
buses. The judges of what does not depend on time are those of sw/linux."""
import random
import re
from dataclasses import replace
from pathlib import Path

from canlog import Failed, expect, expect_true, frames, merged, read, same

# canlog has made sw/linux known.
import j1939 as sae  # pylint: disable=wrong-import-order
import judge  # pylint: disable=wrong-import-order
import judge_j1939  # pylint: disable=wrong-import-order
import judge_services  # pylint: disable=wrong-import-order

BCM = Path(__file__).resolve().parents[3] / "sw/linux/guest/bcm.py"
SIZES = {"there": 20_000, "back": 1785}
NAMES = "8000000000000A01 8000000000000B02"


def message(name):
    """The bytes of a message."""
    return random.Random(name).randbytes(SIZES[name])


def prepare(setup):
    """What guest/stacks.sh finds, and its variables."""
    return {f"{name}.bin": message(name) for name in SIZES}, {"VERICAN_BCM": BCM}


class _Run:
    """A run as the judges of sw/linux want it."""

    def __init__(self, run):
        self.run = run

    def text(self, name):
        """A file; the names are not in one here."""
        return NAMES if name == "names.txt" else self.run.text(name)


def transfers(run, log):
    """Both messages byte for byte, and with them the protocol on the bus."""
    done = sae.messages(log)
    expect([(m.by, m.to, m.pgn, m.aborted) for m in sorted(done, key=lambda m: m.by)],
           [(0x80, 0x90, 0x12400, None), (0x90, 0x80, 0x12500, None)], "messages of many frames")
    for name, by in (("there", 0x90), ("back", 0x80)):
        expect_true((run.dir / f"{name}.out").read_bytes() == message(name), f"{name}.out differs")
        found = next(m for m in done if m.by == by)
        expect_true(bytes(found.data) == message(name), f"{name}: others on the bus")


# What 320 has: silence, then contents as guest/bcm.py sends them.
_SILENCE, _ALIVE, _AGAIN = (re.escape(line) + "\n" for line in (
    "RX_TIMEOUT", f"RX_CHANGED 320#{b'alive'.hex().upper()}",
    f"RX_CHANGED 320#{b'again'.hex().upper()}"))
_TURNS = f"({_SILENCE})?({_ALIVE}{_SILENCE})+({_AGAIN}{_SILENCE})*{_AGAIN}({_SILENCE})?"


def silences(told):
    """Of 320: each silence is told once, and its end. The script makes one; a busy machine makes
    more, also before the first frame and behind the last."""
    found = "".join(" ".join([what, *data]) + "\n" for _, what, ident, data in told
                    if ident == "320")
    expect_true(re.fullmatch(_TURNS, found), f"messages of 320:\n{found}")


def manager(run, log):
    """Contents in turn, changes and the answer to a remote frame; how long anything took is that of
    a busy machine."""
    told = judge_services.told_in(run.text("bcm.txt"))
    judge_services.changes(told)
    silences(told)
    found = judge_services.frames_of(log, 0x300)
    judge_services.contents(found)
    expect([what for _, what, ident, _ in told if ident == "300"], ["TX_EXPIRED"],
           "messages of 300")
    expect({ident for _, _, ident, _ in told}, {"300", "310", "320"}, "who is told of")
    expect([(f.remote, f.data) for _, f in judge_services.frames_of(log, 0x330)],
           [(True, b""), (False, b"answer")], "remote frame and its answer")


def gateway(run, near, far):
    """Each frame went on to the other bus, changed as the rules say."""
    def ident(log, number):
        return [frame for frame in log if frame.ident == number and not frame.extended]

    there = [replace(f, ident=0x333, dlc=4, data=(f.data + bytes(8))[:4])
             for f in ident(near, 0x123)]
    back = []
    for f in ident(far, 0x444):
        data = bytearray(f.data)
        for at in (0, 7):
            if at < len(data):
                data[at] ^= 0xFF
        back.append(replace(f, ident=0x445, data=bytes(data)))
    expect((len(there), len(back)), (100, 100), "frames for the gateway")
    same(ident(far, 0x333), there, "from the near bus to the far one")
    same(ident(near, 0x445), back, "from the far bus to the near one")
    # A program there sees what was sent there, too; the floods meet, as the machine is busy.
    merged(frames(read(run.dir / "vcan3.log")), {"gateway": there, "cangen": ident(far, 0x444)},
           "vcan3.log")
    merged(frames(read(run.dir / "vcan0.log")), {"gateway": back, "cangen": ident(near, 0x123)},
           "vcan0.log")
    handled = [int(n) for n in re.findall(r"# (\d+) handled", run.text("rules.txt"))]
    expect(handled, [100, 100], "frames that the rules handled")


def stacks(run):
    """Everything of guest/stacks.sh."""
    logs = {bus: [(e.time, e.frame) for e in read(run.dir / f"{bus}-bus.log")]
            for bus in ("near", "far")}
    try:
        judge_j1939.claims(_Run(run), logs["near"])
        transfers(run, logs["near"])
        manager(run, logs["near"])
    except (judge.Failed, sae.Broken) as reason:
        raise Failed(str(reason)) from None
    gateway(run, *([frame for _, frame in logs[bus]] for bus in ("near", "far")))
    run.ended("near")
    run.ended("far")

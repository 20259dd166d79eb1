# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""J1939 over the core: what must be sent, and what a run must have left behind."""
import random

import j1939 as sae
from judge import expect, expect_true
from judge_isotp import other_load

# Those of guest/j1939.sh.
CLAIMED = 0x80
NONE = 0xFE  # the address of who has none
BY = 0x90
FRAME = "01 23 45 67 89 ab cd ef"  # what testj1939 sends
SENT = [(pgn, to) for pgn in (0x12300, 0x12400, 0x0FEF1, 0x0FEF2) for to in (0x80, 0x81, 0xFF)]
# Messages in the order in which one program sends them: sender, receiver, PGN, sizes.
FLOWS = {
    "etp": (0x90, 0x80, 0x12500, [100_000]),
    "tp": (0x90, 0x98, 0x12300, [9, 14, 15, 1785, 1784, 500]),
    "back": (0x80, 0x90, 0x12400, [1786, 64, 20_000]),
    "bam": (0x90, 0xFF, 0x0FEF1, [120]),
}
ETP = 0x12500


def messages_of(flow, settings):
    """The bytes of a flow's messages; that of the longest may be set."""
    chosen = random.Random(flow)
    sizes = FLOWS[flow][3]
    if flow == "etp":
        sizes = [int(settings["VERICAN_BYTES"])]
    return [chosen.randbytes(size) for size in sizes]


def prepare_j1939(directory, settings):
    """What guest/j1939.sh sends, one file a message."""
    for flow in FLOWS:
        for number, data in enumerate(messages_of(flow, settings)):
            name = f"{flow}-{number}" if flow in ("tp", "back") else flow
            (directory / f"{name}.bin").write_bytes(data)


def claims(run, log):
    """81 4.4: of two claimants the one with the smaller NAME keeps the address; the other claims
    one of its others."""
    smaller, larger = (int(name, 16) for name in run.text("names.txt").split())
    claimed = [(address, name) for _, address, name in sae.claims(log)]
    both = {name for address, name in claimed if address == CLAIMED}
    expect(both, {smaller, larger}, "NAMEs that claimed one address")
    first = next(name for address, name in claimed if address == CLAIMED)
    expect(first, larger, "NAME that had the address first")
    last = {name: address for address, name in claimed if address != NONE}
    expect(last[smaller], CLAIMED, "address of the smaller NAME")
    expect(last[larger], BY, "address of the larger NAME")
    expect({name for address, name in claimed[-2:] if address == NONE}, {smaller, larger},
           "NAMEs that gave their address back at the end")


def heard_by(to, only=None):
    """What testj1939 prints of SENT at an address. A PGN whose format is 240 and more has no
    destination: it goes to everybody, whatever address was given."""
    lines = []
    for pgn, wanted in SENT:
        everybody = wanted == 0xFF or pgn >> 8 & 0xFF >= 240
        if (everybody or wanted == to) and only in (None, pgn):
            lines.append(f"{BY:02x} {pgn:05x}: {FRAME}")
    return lines


def single_frames(run):
    """Each socket has what goes to its address, and of its PGN if it has one."""
    by_name = f"{BY:02x} 12300: {FRAME[:14]}"
    for name, lines in (("all", [*heard_by(0x80), by_name]),
                        ("pgn", [*heard_by(0x80, 0x12300), by_name]),
                        ("peer", heard_by(0x80, 0x0FEF1)),
                        ("named", [*heard_by(0x80), by_name]),
                        ("elsewhere", heard_by(0x81))):
        expect(run.text(f"{name}.txt").splitlines(), lines, f"{name}: frames")


def transfers(run, log):
    """Every message byte for byte, in the files and as reassembled from the bus."""
    done = sae.messages(log)
    expect([message.aborted for message in done if message.aborted is not None], [], "aborts")
    total = 0
    for flow, (by, to, pgn, _) in FLOWS.items():
        sent = messages_of(flow, run.settings)
        received = (run.dir / f"{flow}.out").read_bytes()
        expect_true(received == b"".join(sent), f"{flow}: {len(received)} bytes received, "
                                                f"{sum(map(len, sent))} sent, or others")
        found = [bytes(m.data) for m in done if (m.by, m.to, m.pgn) == (by, to, pgn)]
        expect_true(found == sent, f"{flow}: others on the bus")
        total += len(received)
    expect(len(done), sum(len(messages_of(flow, run.settings)) for flow in FLOWS), "messages")
    run.notes["bytes"] = total
    return done


def j1939(run):
    log = run.log("j1939-bus.log")
    claims(run, log)
    single_frames(run)
    done = transfers(run, log)
    longest = next(message for message in done if message.pgn == ETP)
    load = other_load(log, 1_000_000, (longest.start, longest.end))
    expect_true(load >= float(run.settings["VERICAN_LEAST"]), f"load of the third node: {load:.3f}")
    for device in ("can0", "can1"):
        run.same_as_bus(f"j1939-{device}.log", "j1939-bus.log")
    run.counters_agree("j1939")
    expect_true(run.bus("j1939")["bus"]["errors"] > 20, "no errors on the bus")
    expect([line for line in run.text("dmesg.txt").splitlines() if "j1939_" in line], [],
           "messages of the stack")
    run.notes["frames"], run.notes["load"] = len(log), load
    run.notes["rate"] = longest.size * 1e6 / (longest.end - longest.start)

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Logs of candump, with interfaces, and what two of them must have in common."""
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "sw/linux"))
from expectations import Failed, expect, expect_true  # noqa: E402,F401
from frames import Frame, length_in_bits, parse, read_log  # noqa: E402,F401


def read(path):
    """All entries, error messages too; Failed if the file is missing or has another line."""
    path = Path(path)
    expect_true(path.exists(), f"{path.name} is missing")
    try:
        return read_log(path)
    except ValueError as error:
        raise Failed(str(error)) from None


def frames(entries):
    """Their frames in order, error messages left out."""
    return [entry.frame for entry in entries if not entry.frame.is_error]


def errors(entries):
    """Their error messages in order: (class bits, eight bytes)."""
    return [(e.frame.ident & 0x1FFFFFFF, e.frame.data) for e in entries if e.frame.is_error]


def candump(frame):
    """As candump writes it."""
    rest = f"R{frame.dlc or ''}" if frame.remote else frame.data.hex().upper()
    return f"{frame.ident:0{8 if frame.extended else 3}X}#{rest}"


def same(found, wanted, what):
    """Every frame, in the same order, and nothing else; Failed says which kind of difference."""
    if found == wanted:
        return
    lost = list((Counter(wanted) - Counter(found)).elements())
    extra = list((Counter(found) - Counter(wanted)).elements())
    if lost or extra:
        known = set(wanted)
        twice = [frame for frame in extra if frame in known]
        raise Failed(f"{what}: {len(found)} frames for {len(wanted)}; lost {len(lost)} "
                     f"{[candump(f) for f in lost[:3]]}, twice {len(twice)} "
                     f"{[candump(f) for f in twice[:3]]}, added {len(extra) - len(twice)} "
                     f"{[candump(f) for f in extra if f not in known][:3]}")
    at = next(i for i, (a, b) in enumerate(zip(found, wanted)) if a != b)
    raise Failed(f"{what}: another order from frame {at} on: {candump(found[at])}, "
                 f"expected {candump(wanted[at])}")


def merged(found, senders, what):
    """`found` is the sequences of `senders` (name: frames), each complete and in its order, merged
    in any way. The senders' frames must differ from each other's."""
    owner = {frame: name for name, sent in senders.items() for frame in sent}
    expect(sum(len(set(sent)) for sent in senders.values()), len(owner), f"{what}: owners")
    parts = {name: [] for name in senders}
    for frame in found:
        expect_true(frame in owner, f"{what}: {candump(frame)} was sent by nobody")
        parts[owner[frame]].append(frame)
    for name, sent in senders.items():
        same(parts[name], sent, f"{what}, sent by {name}")

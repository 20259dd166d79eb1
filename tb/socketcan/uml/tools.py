# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Everyday programs on the bridge: can-utils with filters, canplayer, canbusload, python-can."""
import json

from canlog import expect, expect_true, frames, length_in_bits, parse, read, same
from traffic import cangen

SENT = ("123#DEADBEEF", "124#01", "123#R2", "00000123#AA", "12345678#1122", "12345679#33", "7FF#",
        "123#", "1FFFFFFF#R", "000#0102030405060708", "00000000#FF")
FILTERS = ("123:7FF", "123:C00007FF", "12345678:DFFFFFFF", "123~7FF", "124:7FF,7FF:C00007FF",
           "000:1FFFFFFF", "00000000:DFFFFFFF")
OWN_FILTERS = (3, 4, 6)  # of these, the bridge applies some itself (--filter)
EXTENDED, REMOTE = 0x80000000, 0x40000000

PROGRAMS = {
    # What vcan0's other program and vcan1's have sent; not its own.
    "a": ["124/1/04", "1ABCDEF0x/2/0506", "1ABD0000x/1/08", "12F/1/09", "7FE/0/"],
    "neighbour": ["123/3/010203", "124/1/04", "223/0/", "1ABCDEF0x/2/0506", "1ABCDEF1x/1/07",
                  "1ABD0000x/1/08", "125r/0/", "12F/1/09", "7FE/0/", "12E/0/"],
    # Its own too, once.
    "vain": ["123/3/010203", "124/1/04", "223/0/", "1ABCDEF0x/2/0506", "1ABCDEF1x/1/07",
             "1ABD0000x/1/08", "125r/0/", "12F/1/09", "7FE/0/", "12E/0/"],
    "b": ["123/3/010203", "124/1/04", "223/0/", "1ABCDEF1x/1/07", "1ABD0000x/1/08", "125r/0/",
          "12E/0/"],
    # Its filters, on what both sides send.
    "choosy": ["123/3/010203", "124/1/04", "1ABCDEF0x/2/0506", "1ABCDEF1x/1/07", "125r/0/",
               "12F/1/09", "12E/0/"],
}


def can_id(frame):
    """As linux/can.h has it, with flags."""
    return frame.ident | EXTENDED * frame.extended | REMOTE * frame.remote


def passes(rules, frame):
    """candump's filters: one match is enough; 8 digits of an identifier mean 29 bits."""
    for rule in rules.split(","):
        unequal = "~" in rule
        ident, mask = rule.split("~" if unequal else ":")
        wanted = int(ident, 16) | EXTENDED * (len(ident) == 8)
        if ((can_id(frame) ^ wanted) & int(mask, 16) != 0) == unequal:
            return True
    return False


def passed(rules):
    """What is left of SENT."""
    return [frame for frame in (parse(f"(0.000000) vcan0 {text}").frame for text in SENT)
            if passes(rules, frame)]


def settings(source, recorded):
    """Variables of guest/tools.sh."""
    own = (f"{number}:{len(passed(FILTERS[number]))}" for number in OWN_FILTERS)
    return {"VERICAN_SENT": " ".join(SENT), "VERICAN_FILTERS": " ".join(FILTERS),
            "VERICAN_OWN_FILTERS": " ".join(own),
            "VERICAN_LOG": source / "bus.log", "VERICAN_FRAMES": len(recorded)}


def busload(run):
    """canbusload has counted each frame and each bit, those of the intermission left out."""
    sent = cangen(200) + cangen(200, extended=True)
    same(frames(read(run.dir / "load.log")), sent, "load.log")
    rows = [line.split() for line in run.text("load.txt").splitlines() if line.strip()]
    total = [sum(int(row[column]) for row in rows) for column in (1, 2, 3)]
    bits = sum(length_in_bits(frame) for frame in sent)
    expect(total, [len(sent), bits, 8 * sum(frame.dlc for frame in sent)],
           "canbusload: frames, bits, bits of data")


def tools(run):
    """What each program has seen."""
    sent = [parse(f"(0.000000) vcan0 {text}").frame for text in SENT]
    same(frames(read(run.dir / "all.log")), sent, "all.log")
    for number, rules in enumerate(FILTERS):
        wanted = passed(rules)
        expect_true(0 < len(wanted) < len(sent), f"filter {rules} tells nothing")
        same(frames(read(run.dir / f"filter{number}.log")), wanted, f"filter {rules}")
        if number in OWN_FILTERS:
            same(frames(read(run.dir / f"own{number}.log")), wanted, f"--filter {rules}")
            run.ended(f"own{number}")
    recorded = [frame for _, frame in run.sent]
    same(frames(read(run.dir / "played.log")), recorded, "played.log")
    busload(run)
    seen = json.loads(run.text("programs.json"))
    expect(seen["programs"], PROGRAMS, "python-can")
    codes = [[0x300 + code, 8, code, "abcdefgh"] for code in range(9, 16)]
    codes.append([0x310 | REMOTE, 8, 15, "\0" * 8])
    expect(seen["raw_dlc"], codes * 2, "length codes above 8")
    run.ended("bridge")

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The judges themselves: spoiled files of a good run must not pass."""
import re
import shutil

from canlog import Failed, expect_true


def lose(lines):
    """A line in the middle is missing."""
    del lines[len(lines) // 2]


def double(lines):
    """A line in the middle is there twice."""
    lines.insert(len(lines) // 2, lines[len(lines) // 2])


def reorder(lines):
    """A line comes late, or early if all behind it are equal."""
    if len(set(lines)) > 1:
        lines.insert(3 * len(lines) // 4, lines.pop(len(lines) // 4))


def corrupt(lines):
    """One bit is wrong, of a line's data or, if it has none, of its identifier."""
    at = len(lines) // 2
    head, _, data = lines[at].rstrip().partition("#")
    if data and "R" not in data:
        data = f"{data[:-1]}{int(data[-1], 16) ^ 1:X}"
    else:
        head = f"{head[:-1]}{int(head[-1], 16) ^ 1:X}"
    lines[at] = f"{head}#{data}\n"


def strange(lines):
    """Something from outside in a file."""
    lines[len(lines) // 2] = lines[len(lines) // 2][:20] + "\n"


def lose_early(lines):
    """The fourth line is missing."""
    del lines[3]


LOG = (lose, double, reorder, corrupt, strange)


def error_bits(position):
    """Spoils byte `position` (0 to 3: class, 4 to 11: data) of an error message in the middle."""
    def spoil(lines):
        where = [n for n, line in enumerate(lines) if re.search(r" 2[0-9A-F]{7}#", line)]
        at = where[len(where) // 2]
        head, _, frame = lines[at].rstrip().rpartition(" ")
        ident, _, data = frame.partition("#")
        octets = bytearray(bytes.fromhex(ident + data))
        octets[position] ^= 1
        lines[at] = f"{head} {octets[:4].hex().upper()}#{octets[4:].hex().upper()}\n"
    spoil.__doc__ = f"byte {position} of an error message"
    return spoil


def replace(pattern, text):
    """Spoils a text file."""
    def spoil(lines):
        whole = "".join(lines)
        changed = re.sub(pattern, text, whole, count=1)
        if changed == whole:
            raise AssertionError(f"{pattern} is not in the file")
        lines[:] = [changed]
    spoil.__doc__ = f"{pattern} becomes {text}"
    return spoil


CODE = (replace(r"^0", "1"),)
MESSAGES = LOG + tuple(error_bits(n) for n in range(12))
# What is spoiled in each case: {file: ways}.
TARGETS = {
    "flood": {"bus.log": (lose,), "vcan0.log": (reorder,),
              "vcan0.json": (replace(r'"packets":20000', '"packets":19999'),)},
    "duel": {"bus.log": LOG, "vcan0.log": LOG, "vcan1.log": LOG, "bridge.code": CODE,
             "vcan1.json": (replace(r'"dropped":0', '"dropped":1'),)},
    "tools": {"all.log": LOG, "filter0.log": LOG, "filter3.log": LOG, "played.log": LOG,
              "load.txt": (replace(r"(vcan1@500000 +)\d", r"\g<1>9"),),
              "programs.json": (replace(r'"124/1/04", ', ""), replace("abcdefgh", "abcdefgi"))},
    "errors": {"noack.log": (lose_early, *MESSAGES[3:]), "busoff.log": MESSAGES,
               "receiver.log": MESSAGES, "lost0.log": MESSAGES, "lost1.log": (lose, *MESSAGES[5:]),
               "state.log": MESSAGES[3:],
               "busoff-bus.log": LOG, "lost-bus.log": LOG, "lost-mon.log": LOG},
    "interfaces": {"mon0.log": LOG, "mon0-late.log": LOG, "traffic-bus.log": LOG,
                   "up.log": MESSAGES,
                   "missing.code": (replace("2", "0"),),
                   "traffic.err": (replace("vcan0 is back\n", ""),),
                   "traffic.out": (replace('"away": 400', '"away": 399'),),
                   "small.code": (replace("1", "0"),), "small-mon.log": LOG[1:],
                   "small.out": (replace('"lost": ', '"lost": 1'),),
                   "down.err": (replace("vcan7", "vcan0"),)},
    "vxcan": {"echo.log": LOG, "echo-bus.log": LOG, "silent.log": LOG,
              "strange.out": (replace('"rejected": 5', '"rejected": 4'),)},
    "remote": {"c-small-0.log": (replace("1A1#01020304", "1A1#01020305"),),
               "python-full-0.log": (replace("1A1#01020304", "1A1#01020305"),),
               "c-full-1.client": CODE, "python-small-1.client": CODE,
               "python-full-1.txt": (replace("OK", "ok"),),
               "memory.code": CODE, "refused.code": (replace("1", "0"),),
               "down.code": (replace("2", "1"),),
               "read.out": (replace("(?i)A5|165", "A4"),)},
    "stacks": {"near-bus.log": (lose, double, corrupt), "vcan3.log": LOG, "far-bus.log": LOG,
               "bcm.txt": (lose, corrupt), "far.code": CODE,
               "rules.txt": (replace("# 100", "# 99"),)},
    "signals": {"INT-bus.log": LOG, "TERM-mon.log": LOG},
}


def notices(case, judge, source, directory):
    """Fails unless the judge takes the files as they are and refuses each spoiled one."""
    shutil.rmtree(directory, ignore_errors=True)
    shutil.copytree(source, directory)
    judge(directory)
    count = 0
    for name, ways in TARGETS[case].items():
        path = directory / name
        good = path.read_text()
        for way in ways:
            lines = good.splitlines(keepends=True)
            way(lines)
            if "".join(lines) == good:
                raise AssertionError(f"{name}: nothing was spoiled: {way.__doc__}")
            path.write_text("".join(lines))
            try:
                judge(directory)
            except Failed:
                count += 1
            else:
                expect_true(False, f"{name}: nothing noticed: {way.__doc__}")
        path.write_text(good)
    return [f"{count} spoiled files noticed"]

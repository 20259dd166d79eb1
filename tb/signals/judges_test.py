# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# judges_test VERICAN NODE MODULES: random frames of every message of every database, decoded by the
# tool and by other programs.
"""Judges: canmatrix's own decoder (floats, multiplexing), the npm package candied (another parser;
raw integers) and, if Python finds it, cantools. VERICAN_DBC_DIR names a folder with more databases,
VERICAN_DBC_FRAMES how many frames of each message (50)."""
import csv
import io
import json
import logging
import math
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

FRAMES = int(os.environ.get("VERICAN_DBC_FRAMES", "50"))
EXTENDED = 1 << 31
# The databases of this repository, which every judge must read, and how many values it must have
# compared at least, for each frame of every message. Other databases may be beyond a judge.
LEAST = {"tb/signals/features.dbc": {"canmatrix": 25, "candied": 5, "cantools": 5},
         "examples/engine.dbc": {"canmatrix": 8, "candied": 5, "cantools": 5}}
logging.disable(logging.CRITICAL)


class Case:
    """A database, frames of its messages, and what the tool makes of them."""

    def __init__(self, path, tool):
        self.path = path
        self.tool = tool
        self.frames = []  # (compound id, data)
        self.singles = set()  # (message, signal) of floats of 32 bits
        self.ours = None

    def make_frames(self, messages, seed):
        source = random.Random(seed)
        for message in messages:
            identifier = message["id"] | (EXTENDED if message["extended"] else 0)
            for _ in range(FRAMES):
                self.frames.append((identifier, source.randbytes(min(message["length"], 8))))
            self.singles |= {(message["name"], signal["name"]) for signal in message["signals"]
                             if signal["float"] and signal["length"] == 32}

    def run(self):
        """Decodes by the tool: {frame: {signal: (raw, value)}}."""
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            for i, (identifier, data) in enumerate(self.frames):
                width = 8 if identifier & EXTENDED else 3
                log.write(f"({1 + i // 1000000:010}.{i % 1000000:06}) can0 "
                          f"{identifier & ~EXTENDED:0{width}X}#{data.hex()}\n")
            log.flush()
            command = [self.tool, "signals", log.name, "--dbc", self.path, "--csv", "-"]
            result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode not in (0, 1):
            raise RuntimeError(result.stderr.strip())
        self.ours = [{} for _ in self.frames]
        for row in csv.DictReader(io.StringIO(result.stdout)):
            place = round((float(row["time"]) - 1) * 1e6)
            self.ours[place][row["signal"]] = (int(row["raw"]), float(row["value"]))


def is_close(ours, theirs, single):
    """The same but for the last digits of a calculation."""
    if math.isnan(ours) or math.isnan(theirs):
        return math.isnan(ours) and math.isnan(theirs)
    if single:
        return struct.pack("f", ours) == struct.pack("f", theirs)
    return math.isclose(ours, theirs, rel_tol=1e-9, abs_tol=1e-12)


class Verdict:
    def __init__(self):
        self.signals = 0
        self.differences = []

    def compare(self, what, ours, theirs, single=False):
        """`single`: a number of 32 bits, which the tool writes with as many digits as it has."""
        self.signals += 1
        if not (ours == theirs or isinstance(theirs, float) and is_close(ours, theirs, single)):
            self.differences.append(f"{what}: {ours}, not {theirs}")


def canmatrix_judge(case, verdict):
    """Which signals are there, and their values."""
    with open(case.path, "rb") as file, open(os.devnull, "w") as nowhere:
        sys.stdout, stdout = nowhere, sys.stdout
        try:
            database = FORMAT.load(file)
        finally:
            sys.stdout = stdout
    by_id = {f.arbitration_id.to_compound_integer(): f for f in database.frames}
    for index, (identifier, data) in enumerate(case.frames):
        frame = by_id.get(identifier)
        if frame is None or frame.size > 8 or frame.size == 0:
            continue
        theirs = frame.decode(data)
        ours = case.ours[index]
        name = f"{frame.name} {data.hex()}"
        verdict.compare(name, sorted(ours), sorted(theirs))
        for signal, decoded in theirs.items():
            if signal in ours:
                verdict.compare(f"{name} {signal}", ours[signal][1], float(decoded.phys_value),
                                (frame.name, signal) in case.singles)


def candied_judge(case, verdict):
    """Raw values of integers."""
    # It does not tell base identifiers from extended ones of the same number.
    lines = [f"{identifier & ~EXTENDED} {data.hex()}" for identifier, data in case.frames]
    result = subprocess.run([NODE, "tb/signals/candied.mjs", MODULES, case.path],
                            input="\n".join(lines), capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(result.stderr.strip().splitlines()[-1:])
    for index, values in json.loads(result.stdout).items():
        ours = case.ours[int(index)]
        for signal, raw in values.items():
            if signal in ours:
                verdict.compare(f"{lines[int(index)]} {signal}", float(ours[signal][0]), float(raw))


def cantools_judge(case, verdict):
    """Which signals are there, and their values."""
    database = CANTOOLS.load_file(case.path, strict=False)
    by_id = {m.frame_id | (EXTENDED if m.is_extended_frame else 0): m for m in database.messages}
    for index, (identifier, data) in enumerate(case.frames):
        message = by_id.get(identifier)
        if message is None or message.length > 8:
            continue
        try:
            theirs = message.decode(data, decode_choices=False, allow_truncated=True)
        except Exception:  # a value of a multiplexer that selects nothing is a mistake to it
            continue
        ours = case.ours[index]
        name = f"{message.name} {data.hex()}"
        verdict.compare(name, sorted(ours), sorted(theirs))
        for signal, value in theirs.items():
            if signal in ours:
                verdict.compare(f"{name} {signal}", ours[signal][1], float(value),
                                (message.name, signal) in case.singles)


def messages_of(path):
    """What the tool's own reader finds, and None for what it refuses."""
    with open(path, "rb") as file:
        result = subprocess.run([sys.executable, "-B", "sim/python/dbc_to_json.py"], stdin=file,
                                capture_output=True, text=True, check=True)
    database = json.loads(result.stdout)
    if "error" in database:
        print(f"{path}:{database['error']['line']}: refused: {database['error']['message']}")
        return None
    return database["messages"]


def databases():
    found = list(LEAST)
    folder = os.environ.get("VERICAN_DBC_DIR")
    if folder:
        found += sorted(pathlib.Path(folder).rglob("*.dbc"))
    else:
        print("VERICAN_DBC_DIR is not set: databases of others are left out")
    return map(str, found)


def heard(name, judge, case):
    """The verdict of one judge on one database."""
    verdict = Verdict()
    try:
        judge(case, verdict)
    except Exception as error:  # a judge that cannot read it says nothing
        if case.path in LEAST:
            raise
        print(f"{case.path}: {name}: {type(error).__name__}: {str(error)[:100]}")
    least = FRAMES * LEAST.get(case.path, {}).get(name, 0)
    if verdict.signals < least:
        verdict.differences.append(f"{verdict.signals} values compared, not {least} or more")
    return verdict


def main():
    judges = {"canmatrix": canmatrix_judge, "candied": candied_judge}
    if CANTOOLS:
        judges["cantools"] = cantools_judge
    else:
        print("cantools is not there: it is no judge")
    totals = {name: Verdict() for name in judges}
    read = refused = 0
    for path in databases():
        messages = messages_of(path)
        refused += messages is None
        if not messages:
            if path in LEAST:
                sys.exit(f"{path}: no messages to judge")
            continue
        read += 1
        case = Case(path, TOOL)
        case.make_frames(messages, 1)
        case.run()
        for name, judge in judges.items():
            verdict = heard(name, judge, case)
            totals[name].signals += verdict.signals
            totals[name].differences += [f"{path}: {name}: {d}" for d in verdict.differences]
    print(f"{read} databases, {refused} refused")
    for name, verdict in totals.items():
        print(f"{name}: {verdict.signals} values compared, {len(verdict.differences)} differences")
        print("".join(f"  {d}\n" for d in verdict.differences[:40]), end="")
    sys.exit(any(verdict.differences for verdict in totals.values()))


if __name__ == "__main__":
    TOOL, NODE, MODULES = sys.argv[1:4]
    import canmatrix.formats.dbc as FORMAT
    try:
        import cantools.database as CANTOOLS
    except ImportError:
        CANTOOLS = None
    main()

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""tb/coverage/exclusions.yaml: points that no test can reach, each with its reason.

    rtl/host/can_mode.sv:
      - because: upset          # one of BECAUSE
        reason: why nothing reaches it
        at: "default: state_q"  # line, branch: text of the source line, on one line of the file
        what: case              # which point of that line, where there are several
      - because: constant
        reason: ...
        toggle: "rx_i[7:2]:0->1 busy_*"   # signals; a range of bits, one direction, * for any text
"""
import re

import yaml

from .points import CoverageError

# Why a point is out of reach.
BECAUSE = {
    "constant": "constant by design or a parameter's value",
    "upset": "only an upset flip-flop leads there",
    "invariant": "two conditions that cannot meet",
    "tool": "not counted by Verilator 5.006",
}


class Exclusion:
    """One entry; `points` are filled in by apply()."""

    def __init__(self, file, entry):
        self.file = file
        keys = set(entry)
        if not {"because", "reason"} <= keys or not keys & {"at", "toggle"} \
                or keys - {"because", "reason", "at", "what", "toggle"}:
            raise CoverageError(f"exclusions of {file}: an entry has because, reason, and at "
                                f"[what] or toggle; here: {sorted(keys)}")
        if entry["because"] not in BECAUSE:
            raise CoverageError(f"exclusions of {file}: because is one of "
                                f"{', '.join(BECAUSE)}, not {entry['because']!r}")
        self.because, self.reason = entry["because"], entry["reason"]
        self.at, self.what = entry.get("at"), entry.get("what")
        self.toggle = [pattern(p) for p in entry.get("toggle", "").split()]
        self.points = []

    def name(self):
        return f"{self.file}: {self.at or ' '.join(p.pattern for p in self.toggle)}"


def pattern(text):
    """A regular expression for signals: "a[7:2]", "a*", "a:0->1"."""
    signal, _, way = text.partition(":0->1") if ":0->1" in text else text.partition(":1->0")
    way = ":0->1" if text.endswith(":0->1") else ":1->0" if text.endswith(":1->0") else ""
    bits = re.fullmatch(r"(.*)\[(\d+):(\d+)\]", signal)
    body = re.escape(bits[1] if bits else signal).replace(r"\*", ".*")
    if bits:
        high, low = int(bits[2]), int(bits[3])
        body += r"\[(?:" + "|".join(str(b) for b in range(low, high + 1)) + r")\]"
    elif "[" not in signal and "*" not in signal:
        body += r"(?:\[\d+\])?"
    return re.compile(body + (re.escape(way) if way else r":[01]->[01]"))


def load(path):
    with open(path, encoding="utf-8") as file:
        try:
            data = yaml.safe_load(file) or {}
        except yaml.YAMLError as error:
            raise CoverageError(f"{path}: {' '.join(str(error).split())}") from None
    return [Exclusion(file, entry) for file, entries in data.items() for entry in entries]


def lines_with(path, text):
    with open(path, encoding="utf-8") as file:
        return [n for n, line in enumerate(file, 1) if text in line]


def find_points(exclusion, counts, root):
    mine = [p for p in counts if p.file == exclusion.file]
    if exclusion.at is None:
        return [p for p in mine if p.kind == "toggle"
                and any(t.fullmatch(p.what) for t in exclusion.toggle)]
    lines = lines_with(f"{root}/{exclusion.file}", exclusion.at)
    if len(lines) != 1:
        raise CoverageError(f"exclusions of {exclusion.file}: {exclusion.at!r} is on "
                            f"{len(lines)} lines, must be on one")
    return [p for p in mine if p.kind != "toggle" and p.line == lines[0]
            and exclusion.what in (None, p.what)]


def apply(exclusions, counts, root="."):
    """Finds the points of each entry. Returns what is wrong with the entries, as lines of text."""
    problems = []
    for exclusion in exclusions:
        exclusion.points = find_points(exclusion, counts, root)
        if not exclusion.points:
            problems.append(f"{exclusion.name()}: excludes nothing")
        for point in exclusion.points:
            if counts[point]:
                problems.append(f"{point.file}:{point.line}: {point.kind} {point.what} is excluded "
                                f"and was hit {counts[point]} times")
    return problems

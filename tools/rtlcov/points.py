# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Coverage points and their counts, from files in Verilator's format."""
import re
from typing import NamedTuple

RECORD = re.compile(r"C '(.*)' (\d+)")
CLOCKS = ("clk_i", "hclk")


class CoverageError(Exception):
    """Something is wrong with a file; the text is one line for the user."""


class Point(NamedTuple):
    """A place of the RTL; instances and parametrised copies of a module share it."""
    file: str
    line: int
    column: int
    kind: str   # line, branch or toggle
    what: str   # block, case, elsif / if, else / signal[bit]:0->1


def parse(text, where):
    fields = dict(part.split("\2", 1) for part in text.split("\1")[1:])
    try:
        return Point(fields["f"], int(fields["l"]), int(fields["n"]), fields["t"], fields["o"])
    except (KeyError, ValueError):
        raise CoverageError(f"{where}: not a coverage point: {text!r}") from None


def is_clock(point):
    # The simulator leaves out falling edges of the clock (sim/node/model_edge.hpp).
    return point.kind == "toggle" and point.what.split(":")[0] in CLOCKS


def add_file(path, counts, known):
    """Adds the counts of one file; `known` keeps the parsed texts from file to file."""
    with open(path, encoding="utf-8") as file:
        head = file.readline()
        if not head.startswith("# SystemC::Coverage-3"):
            raise CoverageError(f"{path}: not a coverage file, its first line is {head.strip()!r}")
        for number, line in enumerate(file, 2):
            record = RECORD.fullmatch(line.rstrip("\n"))
            if not record:
                raise CoverageError(f"{path}:{number}: not a record: {line.strip()!r}")
            text = record[1]
            if text not in known:
                known[text] = parse(text, f"{path}:{number}")
            point = known[text]
            if not is_clock(point):
                counts[point] = counts.get(point, 0) + int(record[2])


def read_counts(paths):
    """Point -> how often it was hit, over all files."""
    counts, known = {}, {}
    for path in paths:
        add_file(path, counts, known)
    return counts

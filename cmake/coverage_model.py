#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""coverage_model.py DIR NAME ROOT: prepares a model that was Verilated with coverage (5.006).

Verilator counts in the model and writes nothing when it is destroyed; and its toggle points count
a rise like a fall. This rewrites the sources in DIR: the counts of all instances of class NAME are
one array of the program, a toggle has two counts (none while the reset is active), and the points
become a table that cmake/coverage_writer.cpp writes when the program ends. Files outside of
ROOT/rtl, such as the hollow engine of the split core, are not counted.
"""
import glob
import os
import re
import sys

INSERT = re.compile(
    r'vlSelf->__vlCoverInsert\(&\(vlSymsp->__Vcoverage\[(\d+)\]\), first,\s*"([^"]*)",\s*(\d+),'
    r'\s*(\d+),\s*"([^"]*)",\s*"([^"]*)",\s*"([^"]*)",\s*"([^"]*)"\);')
COUNT = r"vlSymsp->__Vcoverage\s*\[(\d+)\]\s*\.fetch_add\(1, std::memory_order_relaxed\);"
TOGGLE = re.compile(COUNT + r"\s*(vlSelf->\w*__Vtogcov__\w+(?:\s*\[\w+\])*)\s*=\s*([^;]*);")
# One bit of a signal: if ((4U & (now ^ was))) {count; was = ...;}
BIT = re.compile(r"if \(((?:[^{};])*?)\) \{\s*" + COUNT
                 + r"\s*(vlSelf->\w*__Vtogcov__\w+)\s*=[^;]*;\s*\}")
SIGNAL = re.compile(r"(?:vlSelf->|\b)[A-Za-z_]\w*(?:__DOT__|vlSelf->)\w+|vlSelf->\w+")
# The resets of the tops, and how to tell in C++ that they are not active.
RESETS = {"rst_ni": "", "hresetn": "", "presetn": "", "aresetn": "", "wb_rst_i": "!"}


def fail(text):
    sys.exit(f"coverage_model.py: {text} (is this Verilator 5.006?)")


def read(pattern):
    files = {}
    for name in sorted(glob.glob(pattern)):
        with open(name, encoding="utf-8") as file:
            files[name] = file.read()
    return files


def take_points(files):
    """The points of the model, in order: (counter, file, line, column, hierarchy, page, what)."""
    points = []
    for name, text in files.items():
        for found in INSERT.findall(text):
            points.append((int(found[0]), found[1], int(found[2]), int(found[3]), *found[4:7]))
        files[name] = INSERT.sub("", text)
        if "__vlCoverInsert(&" in files[name]:
            fail(f"{name} has a coverage point of an unknown form")
    if not points:
        fail("the model has no coverage points")
    return points


def compared(condition, was):
    """The signal that a toggle's condition compares with `was`, bit by bit, or None."""
    text = re.sub(r"\(IData\)|\s", "", condition)
    names = set(SIGNAL.findall(text)) - {was}
    shifts = re.findall(r"(\w+)>>(\w+)U", text)
    places = {name.rsplit(">", 1)[-1]: place for name, place in shifts}
    rest = re.sub(r"\b(?:0x[0-9a-f]+|\d+)U(?:LL)?", "", SIGNAL.sub("", text))
    if len(names) != 1 or set(rest) - set("()^&>"):
        return None
    name = names.pop()
    own, other = (places.get(n.rsplit(">", 1)[-1]) for n in (name, was))
    return name if own == other and text.count(name) == text.count(was) == 1 else None


def guard(text):
    """Puts the bits of a signal, which Verilator looks at one by one, behind one comparison."""
    out, position = [], 0
    matches = list(BIT.finditer(text))
    while matches:
        run = [matches.pop(0)]
        while matches and matches[0][3] == run[0][3] \
                and not text[run[-1].end():matches[0].start()].strip():
            run.append(matches.pop(0))
        signals = {compared(m[1], m[3]) for m in run}
        signal = signals.pop()
        if len(run) == 1 or signals or signal is None:
            continue
        out += [text[position:run[0].start()], f"if ({signal} != {run[0][3]}) {{\n",
                text[run[0].start():run[-1].end()], "\n}"]
        position = run[-1].end()
    return "".join(out) + text[position:]


def rewrite_counts(files, name, size, points, active):
    toggles = {p[0] for p in points if p[5].startswith("v_toggle")}
    resets = {p[0] for p in points if p[6] in RESETS}
    done = set()

    def toggle(match):
        index, was, now = int(match[1]), match[2], match[3]
        if index not in toggles:
            fail(f"counter {index} looks like a toggle and is none")
        done.add(index)
        step = "1" if index in resets else active
        return (f"const auto before = {was}; {was} = {now};\n"
                f"{name}_coverage[{was} < before ? {index + size} : {index}] += {step};")

    def plain(match):
        if int(match[1]) in toggles:
            fail(f"toggle counter {match[1]} has an unknown form")
        done.add(int(match[1]))
        return f"++{name}_coverage[{match[1]}];"

    for file, text in files.items():
        files[file] = re.sub(COUNT, plain, TOGGLE.sub(toggle, guard(text)))
        if file.endswith(".cpp") and "__Vcoverage" in files[file]:
            fail(f"{file} has a counter of an unknown form")
    if not done <= {p[0] for p in points}:
        fail("a counter has no point")


def key(short, value):
    return f"\\001{short}\\002{value}"


def table(points, size, root):
    """Lines of C++: counter and text of each point, as in Verilator's coverage files."""
    lines = []
    for index, file, line, column, hierarchy, page, what in points:
        path = os.path.relpath(file, root)
        if not path.startswith("rtl/"):
            continue
        kind = page.split("/")[0].removeprefix("v_")
        ways = [(0, what)]
        if kind == "toggle":
            ways = [(0, what + ":0->1"), (size, what + ":1->0")]
        for offset, comment in ways:
            text = (key("f", path) + key("l", line) + key("n", column) + key("t", kind)
                    + key("page", page) + key("o", comment) + key("h", hierarchy[1:]))
            # Octal escapes: a digit that follows must not become part of one.
            lines.append(f'    {{{index + offset}, "{text}"}},\n')
    return lines


def armed(top):
    """C++: 1 unless the reset of the model is active; `top`: its header. 1: it has none."""
    ports = set(re.findall(r"VL_IN8\(&(\w+),", top))
    return next((f"{no}vlSelf->{reset}" for reset, no in RESETS.items() if reset in ports), "1")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.split("\n", maxsplit=1)[0])
    directory, name, root = sys.argv[1:]
    files = read(f"{directory}/*.cpp") | read(f"{directory}/*.h")
    points = take_points(files)
    top = files[f"{directory}/{name}.h"]
    size = max(p[0] for p in points) + 1
    rewrite_counts(files, name, size, points, armed(top))
    symbols = f"{directory}/{name}__Syms.h"
    files[symbols], hits = re.subn(r"std::atomic<uint32_t> __Vcoverage\[(\d+)\];", "",
                                   files[symbols])
    if hits != 1:
        fail(f"{symbols} has no counters")
    files[symbols] = files[symbols].replace(
        "// SYMS CLASS", f"extern uint32_t {name}_coverage[];\n\n// SYMS CLASS", 1)
    if f"{name}_coverage" not in files[symbols]:
        fail(f"{symbols} has no symbol class")
    for slow in [file for file in files if file.endswith("__Slow.cpp")]:   # packages have one, too
        files[slow] = re.sub(r"(::__vlCoverInsert\([^{]*\{).*?\n\}", r"\1}", files[slow],
                             flags=re.DOTALL)
    for file, text in files.items():
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)
    lines = table(points, size, root)
    with open(f"{directory}/{name}__coverage.cpp", "w", encoding="utf-8") as out:
        out.write('#include "coverage_writer.hpp"\n'
                  f"uint32_t {name}_coverage[{2 * size}];\n"
                  f"static const vericansim::CoveragePoint {name}_points[] = {{\n"
                  + "".join(lines) + "};\n"
                  f"static const vericansim::CoverageModel {name}_model{{{name}_points, "
                  f"{len(lines)}, {name}_coverage}};\n")


if __name__ == "__main__":
    main()

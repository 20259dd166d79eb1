#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""declared_first.py FILE..: names of a module that are used above their declaration, which strict
tools refuse (IEEE 1800, 6.10) and those of the project do not. As plain as the sources are: a
declaration begins a line, and names that mean something else elsewhere in a file do not occur.
Exit code 1 if there are any."""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True

# ruff: noqa: E402  (no folder of bytecode beside the sources)
from plain_end import run

COMMENT = re.compile(r"//.*")
PORTS_END = re.compile(r"\);")
DECLARATION = re.compile(r"\s*(?:logic|int|state_e|\w+_pkg::\w+_t)\b(?:\s*\[[^\]]*\])*\s+([^;]*)")
CONNECTION = re.compile(r"\.\w+\s*(?=\()")  # a port of another module
LOCAL = re.compile(r"\s*(?:input|output)\b|.*\bfunction\b")


def statement(lines, begin):
    """The text from a line up to its semicolon."""
    text = lines[begin]
    while ";" not in text and begin + 1 < len(lines):
        begin += 1
        text += lines[begin]
    return text


def declarations(lines, body):
    """Names and the lines of their first declarations, behind the ports."""
    found = {}
    for number in range(body, len(lines)):
        match = lines[number].strip() and DECLARATION.match(statement(lines, number))
        if not match or LOCAL.match(lines[number]):
            continue
        for item in re.sub(r"\[[^\]]*\]|/\*.*?\*/|\{[^}]*\}", "", match.group(1)).split(","):
            name = item.split("=")[0].strip()
            if re.fullmatch(r"\w+", name):
                found.setdefault(name, number)
    return found


def too_early(path):
    """What is wrong in a file, as messages."""
    lines = [COMMENT.sub("", line) for line in Path(path).read_text(encoding="utf-8").split("\n")]
    body = next((n for n, line in enumerate(lines) if PORTS_END.match(line)), len(lines))
    for name, declared in declarations(lines, body).items():
        word = re.compile(rf"\b{name}\b")
        for number in range(body, declared):
            if word.search(CONNECTION.sub("", lines[number])) and not LOCAL.match(lines[number]):
                yield (f"{path}:{number + 1}: '{name}' is used above its declaration in line "
                       f"{declared + 1}")
                break


def main():
    """See above."""
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    found = [message for path in sys.argv[1:] for message in too_early(path)]
    print("\n".join(found), end="\n" if found else "")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    run(main)

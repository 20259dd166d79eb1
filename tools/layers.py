#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""layers.py [DIR]: no folder of the simulator includes from one above it.

DIR is a folder like sim/ (default: this project's). Prints each include that goes up, and each
folder that has no layer; status 1 if there is one.
"""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True

# ruff: noqa: E402  (no folder of bytecode beside the sources)
from plain_end import run

# From the bottom up: a folder includes only from itself and from those before it. Data flows the
# same way: clock, bit, frame, files of recordings, nodes, judges, what a user wants, what came out.
LAYERS = ("version", "bus", "model", "trace", "signals", "node", "judge", "timing", "scenario",
          "results", "report", "simulation", "firmware", "session", "paper", "linux", "bridge",
          "systemc", "timesync", "cli")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([a-z_]+)/', re.MULTILINE)
SOURCES = ("*.cpp", "*.hpp", "*.c", "*.h")


def wrong(root):
    """Each include that goes up, as a line; that there is nothing to look at, too."""
    level = {folder: index for index, folder in enumerate(LAYERS)}
    if not any(path for pattern in SOURCES for path in root.glob(f"*/{pattern}")):
        yield f"{root}: no folder with sources"
    for folder in sorted(path for path in root.iterdir() if path.is_dir()):
        sources = sorted(path for pattern in SOURCES for path in folder.rglob(pattern))
        if sources and folder.name not in level:
            yield f"{folder}: no layer; add it to LAYERS of tools/layers.py"
            continue
        for source in sources:
            for match in INCLUDE.finditer(source.read_text(encoding="utf-8")):
                if level.get(match[1], -1) > level[folder.name]:
                    line = source.read_text(encoding="utf-8").count("\n", 0, match.start(1)) + 1
                    yield f"{source}:{line}: {folder.name} includes from {match[1]}, a layer above"


def main():
    """The simulator's folders, or those of a directory that is given."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent.parent / "sim"
    if not root.is_dir():
        sys.exit(f"layers: {root} is no directory")
    found = list(wrong(root))
    print("\n".join(found), end="\n" if found else "")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    run(main)

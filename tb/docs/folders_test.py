# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test docs.pages_name_every_folder: whoever looks for a test, or for a part of the simulator, finds
# each folder on the page that lists them.
"""usage: folders_test.py SOURCE"""
import pathlib
import re
import subprocess
import sys

# Page, the folder whose folders it lists, and what a row of its table begins with.
LISTS = (("docs/testing.md", "tb", r"^\| \[`tb/(\w+)`\]\(\.\./tb/\1\) \|"),
         ("docs/simulator.md", "sim", r"^\| (`\w+`(?:, `\w+`)*) \|"))


def folders(source, parent):
    """The folders of a folder that hold files of the project."""
    names = subprocess.run(["git", "ls-files", "-z", "--", f"{parent}/*/*"], cwd=source, check=True,
                           capture_output=True, text=True).stdout.split("\0")
    return {pathlib.Path(name).parts[1] for name in names if name}


def listed(page, row):
    """The folders that the rows of a page name, from the top down."""
    return [name for cell in re.findall(row, page, re.MULTILINE)
            for name in (re.findall(r"`(\w+)`", cell) or [cell])]


def main():
    """Every folder is in its list, and every row is a folder; the simulator's are in layers."""
    source = pathlib.Path(sys.argv[1])
    sys.path.insert(0, str(source / "tools"))
    from layers import LAYERS  # pylint: disable=import-outside-toplevel
    wrong = []
    for page, parent, row in LISTS:
        there = folders(source, parent)
        named = listed((source / page).read_text(encoding="utf-8"), row)
        wrong += [f"{page}: {parent}/{name}: not named" for name in sorted(there - {*named})]
        wrong += [f"{page}: {parent}/{name}: no such folder" for name in sorted({*named} - there)]
        layers = [name for name in named if name in LAYERS]
        if parent == "sim" and layers != [name for name in LAYERS if name in layers]:
            wrong.append(f"{page}: not in the order of LAYERS: {', '.join(layers)}")
        if not there:
            wrong.append(f"{parent}: no folder")
    if wrong:
        sys.exit("\n".join(wrong))


main()

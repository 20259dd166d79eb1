# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What docs/tool.md and docs/recordings.md show of the tool is what it prints.

A block of four blanks whose first line is "$ COMMAND" shows commands and the beginning of what each
prints; "$ cat FILE" shows a file that the next ones use. A block without outputs only shows how to
call the tool. Run by ctest: python3 -m unittest shown_test, with VERICAN_BINARY.
"""
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^\n((?:    .*\n|\n(?=    ))+)", re.MULTILINE)


def steps(page):
    """The commands of each block that shows outputs, with the lines that each prints."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    for lines in BLOCK.findall(text):
        block = re.sub("^    ", "", lines, flags=re.MULTILINE)
        found = re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE)
        if found and any(shown for _, shown in found):
            yield found


class Shown(unittest.TestCase):
    """Each block in a folder of its own."""

    def follow(self, page):
        """How many commands were run."""
        count = 0
        for block in steps(page):
            with tempfile.TemporaryDirectory(prefix="verican-shown-") as folder:
                for command, shown in block:
                    words = shlex.split(command)
                    if words[0] == "cat":
                        (pathlib.Path(folder) / words[1]).write_text(shown, encoding="utf-8")
                        continue
                    self.assertEqual(words[0], "verican", command)
                    done = subprocess.run(
                        [os.environ["VERICAN_BINARY"], *words[1:]], cwd=folder, text=True,
                        capture_output=True, check=True)
                    printed = done.stdout + done.stderr  # as a terminal shows them
                    self.assertTrue(printed.startswith(shown),
                                    f"{page}: {command}\n{shown}\nprints\n{printed}")
                    count += 1
        return count

    def test_tool(self):
        self.assertEqual(self.follow("tool.md"), 1)

    def test_recordings(self):
        self.assertEqual(self.follow("recordings.md"), 1)


if __name__ == "__main__":
    unittest.main()

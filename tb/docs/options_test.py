# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Each option of the tool is described in its pages, and they show none that is not there.

Run by ctest: python3 -m unittest options_test, with VERICAN_BINARY.
"""
import functools
import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
# A call in a page, up to the end of its line or whatever a shell does next.
CALL = re.compile(r"(?<![\w-])verican ([a-z]+)\b((?:\\\n|[^`|#\n;&>])*)")


@functools.lru_cache(maxsize=None)
def help_of(*command):
    """What --help of a command says, without the tool's last line."""
    said = subprocess.run([os.environ["VERICAN_BINARY"], *command, "--help"], text=True,
                          capture_output=True, check=True).stdout
    return said.split("\nExit codes: ")[0]


def subcommands(*command):
    """The commands that a command has."""
    return re.findall(r"^  (\w+) ", help_of(*command).partition("\nSubcommands:\n")[2], re.M)


def options(command):
    """The long options of a command and of its subcommands."""
    lines = [line for words in [(command,), *((command, sub) for sub in subcommands(command))]
             for line in re.findall(r"^  (-.*)", help_of(*words), re.MULTILINE)]
    names = [re.sub(r" (Excludes|Needs): .*", "", line) for line in lines]
    return {option for name in names for option in OPTION.findall(name)} - {"--help"}


def page(name):
    """The text of a page."""
    return (ROOT / name).read_text(encoding="utf-8")


def description(command):
    """What describes a command: its section of tool.md, the pages that its help names, and what it
    shares with others."""
    head, *rest = re.split(r"^## ", page("docs/tool.md"), flags=re.MULTILINE)
    sections = dict(section.split("\n", 1) for section in rest)
    named = re.findall(r"docs/(?!tool\.md)[\w-]+\.md", help_of(command))
    return "\n".join([head, *(sections.get(name, "") for name in ("run", "report", command)),
                      page("docs/recordings.md"), *map(page, named)])


class Options(unittest.TestCase):
    """Of every command."""

    def test_each_is_described(self):
        missing = {command: options(command) - set(OPTION.findall(description(command)))
                   for command in subcommands()}
        self.assertEqual({command: names for command, names in missing.items() if names}, {})

    def test_pages_show_none_that_is_not_there(self):
        commands = {command: options(command) | {"--help"} for command in subcommands()}
        count = 0
        for name in ["README.md", *sorted(map(str, (ROOT / "docs").glob("*.md")))]:
            for command, words in CALL.findall(page(name)):
                shown = set(OPTION.findall(words)) if command in commands else set()
                self.assertEqual(shown - commands.get(command, set()), set(),
                                 f"{name}: verican {command}{words}")
                count += len(shown)
        self.assertGreater(count, 100)


if __name__ == "__main__":
    unittest.main()

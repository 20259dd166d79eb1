# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# ToolCase: tests of the tool as a user meets it. Their first argument is its path.
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = sys.argv.pop(1)


class ToolCase(unittest.TestCase):
    """Each test has a folder of its own, self.path."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def file(self, name, text):
        """Writes a file; returns its path."""
        (self.path / name).write_text(text)
        return self.path / name

    def tool(self, *arguments):
        return subprocess.run([TOOL, *map(str, arguments)], capture_output=True, text=True)

    def passes(self, *arguments, code=0):
        """What it prints; it ends with `code`."""
        result = self.tool(*arguments)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout

    def refused(self, *arguments):
        """The one line that says why."""
        result = self.tool(*arguments)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result.stderr

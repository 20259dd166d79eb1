# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The examples of docs/python.md."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import verican

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples" / "python"


class PythonPage(unittest.TestCase):
    """The programs that the page prints, in its order."""

    def programs(self):
        page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        return [subprocess.run([sys.executable, "-B", "-c", program], capture_output=True,
                               text=True, check=True).stdout
                for program in re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.M)]

    def test_they_do_what_the_page_says(self):
        """b wins the arbitration, c reads both; b's error frame and its counter."""
        module, plug_in = self.programs()
        self.assertRegex(module, r"(?s)us  b  Frame\(0x100.*us  a  Frame\(0x300.*"
                                 r"\[Message\(id=0x100, .*Message\(id=0x300, ")
        self.assertRegex(plug_in, r"ID: 0123 .* 01 02 .*\n.* E .*NodeState\(active, tec 0, rec 8\)")

    def test_it_has_every_name_of_the_package(self):
        """Classes and functions, what they have, and what their objects are made with."""
        page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        names = {name for of in (verican, verican.Bus, verican.Frame, verican.Message,
                                 verican.NodeState) for name in dir(of)}
        named = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`\n]+)`", page))))
        self.assertEqual({name for name in names if not name.startswith("_")} - named, set())


class PythonExample(unittest.TestCase):
    def test_the_delay_of_low_priorities_grows_with_load(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "delay.svg"
            program = EXAMPLES / "arbitration_delay.py"
            done = subprocess.run([sys.executable, "-B", program, picture],
                                  capture_output=True, text=True, check=True)
            self.assertIn("<svg", picture.read_text())
        last = done.stdout.splitlines()[-1].split()
        high, middle, low = (float(last[i]) for i in (2, 5, 8))
        self.assertTrue(high < middle < low, last)

    def test_outputs_that_cannot_be_written(self):
        program = EXAMPLES / "arbitration_delay.py"
        with open("/dev/full", "w", encoding="utf-8") as full:
            for picture, output, said in (
                    ("/nonexistent/x.svg", subprocess.DEVNULL, "No such file"),
                    ("/dev/full", subprocess.DEVNULL, "No space left"),
                    ("/dev/null", full, "standard output: No space left")):
                done = subprocess.run([sys.executable, "-B", program, picture], stdout=output,
                                      stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
                self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()

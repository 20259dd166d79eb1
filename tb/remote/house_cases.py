# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the sources of the remote node's tests must be. Run by ctest:
python3 -m unittest house_cases.Model.test_alone
"""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Model(unittest.TestCase):
    """RN-100: the model shares no code with the RTL and the clients."""

    def test_alone(self):
        """It includes the standard library and other files of sim/model alone."""
        files = sorted((ROOT / "sim/model").glob("remote_*.[ch]pp"))
        self.assertGreater(len(files), 15)
        for file in files:
            for name in re.findall(r'#include\s+"([^"]+)"', file.read_text(encoding="utf-8")):
                self.assertTrue(name.startswith("model/"), f"{file.name} includes {name}")


class Proofs(unittest.TestCase):
    """RN-102: P-1 to P-12 are proven, but for what docs/formal.md says is not."""

    def test_properties(self):
        """Each is named above a property; P-8, which none is about, among what is not proven."""
        named = set()
        for file in (ROOT / "tb/formal/remote").glob("*.sv"):
            text = file.read_text(encoding="utf-8")
            for comment in re.findall(r"//([^\n]*RN-102[^\n]*)", text):
                named |= set(map(int, re.findall(r"P-(\d+)", comment)))
        self.assertEqual(named, set(range(1, 13)) - {8})
        page = (ROOT / "docs/formal.md").read_text(encoding="utf-8")
        self.assertIn("(P-8)", page[page.index("## What is not proven"):])

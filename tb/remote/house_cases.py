# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the sources of the remote node's tests must be. Run by ctest:
python3 -m unittest house_cases.Model.test_alone
"""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tb/formal"))
from runner import catalogue  # pylint: disable=wrong-import-position


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
        """A property that is proven names each; P-8, which none is about, is among what is not
        proven."""
        named = set()
        for proof in catalogue.load(ROOT / "tb/formal"):
            for one in proof.checked() if proof.part == "remote" else ():
                if one.is_property and "RN-102" in one.rules:
                    named |= set(map(int, re.findall(r"\bP-(\d+)", one.text)))
        self.assertEqual(named, set(range(1, 13)) - {8})
        page = (ROOT / "docs/formal.md").read_text(encoding="utf-8")
        self.assertIn("(P-8)", page[page.index("## What is not proven"):])

    def test_files(self):
        """There is no file of properties that no proof takes."""
        taken = set()
        for proof in catalogue.load(ROOT / "tb/formal"):
            for name in sum(proof.splice.values(), proof.files):
                taken.add((proof.folder / name).resolve())
        self.assertEqual(set((ROOT / "tb/formal/remote").glob("*.sv")) - taken, set())

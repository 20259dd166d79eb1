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


# What proves each of P-1 to P-12: written down here, since a property may name one of which it is
# but a part.
PROVEN = {
    1: "check.p_write guard.p_denied guard.p_stays",
    2: "port.p_alone",
    3: "check.p_room send.p_full send.p_no_underflow",
    4: "send.p_own_id",
    5: "state.p_flush state.p_numbered",
    6: "check.p_locked",
    7: "step.p_asked step.p_int2 step.p_once step.p_one_kind",
    8: "jobs.p_hold jobs.p_waits jobs_small.p_hold jobs_small.p_waits",
    9: "jobs.p_begin jobs.p_ends jobs.p_hold jobs.p_over jobs.p_waits "
       "jobs_small.p_begin jobs_small.p_ends jobs_small.p_hold jobs_small.p_over "
       "jobs_small.p_waits "
       "step.p_ends step.p_no_wait step.p_rejoins",
    10: "state.p_operate",
    11: "state.p_illegal",
    12: "tally.p_no_wrap"}


class Proofs(unittest.TestCase):
    """RN-102: P-1 to P-12 are proven."""

    def test_properties(self):
        """Those that name one are those that prove it."""
        named = {number: set() for number in PROVEN}
        for proof in catalogue.load(ROOT / "tb/formal"):
            for one in proof.checked() if proof.part == "remote" else ():
                if one.is_property and "RN-102" in one.rules:
                    for number in map(int, re.findall(r"\bP-(\d+)", one.text)):
                        named[number].add(f"{proof.name}.{one.label}")
        self.assertEqual(named, {number: set(labels.split())
                                 for number, labels in PROVEN.items()})

    def test_files(self):
        """There is no file of properties that no proof takes."""
        taken = set()
        for proof in catalogue.load(ROOT / "tb/formal"):
            for name in sum(proof.splice.values(), proof.files):
                taken.add((proof.folder / name).resolve())
        self.assertEqual(set((ROOT / "tb/formal/remote").glob("*.sv")) - taken, set())

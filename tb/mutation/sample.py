#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The mutation run's machinery, tested: it kills, and it spares.
"""usage: sample.py PROGRAM

PROGRAM is the unit test of can_fault on a model with all mutants of that module. Without a mutant
it passes, with a wrong rule it fails, and a mutant that changes nothing passes.
"""
import os
import subprocess
import sys
import tempfile

import models
from mutants import Design

MODULE = "can_fault"
# Rule, what stands in the RTL, what the mutant has instead.
KILLED = [
    ("FC-05: 8 for an error", "i < 3", "!(i < 3)"),
    ("FC-02: 1 for a receiver", "!plus8_q", "plus8_q"),
    ("FC-10: back to 127", "8'd127", "8'h80"),
    ("FC-11: either counter", "tec_q[7] || rec_q[7]", "tec_q[7]"),
    ("FC-08: every eighth bit", "3'd0", "3'h1"),
    ("BO-02: automatic recovery unless held", "!tec_q[8] || !boff_rec_i", "!tec_q[8]"),
    ("FC-13: cleared on entry", "tec_q[7:0] <= '0;", ""),
]
# good_tx counts for a transmitter alone, so that it need not ask; proven by equivalence.py.
SPARED = [
    ("FC-09: the role is asked twice",
     "(field_i == can_pkg::FldEof) && last_i && bit_i && transmitter_i",
     "(field_i == can_pkg::FldEof) && last_i && bit_i"),
]


def passes(program, number):
    """Do all tests pass with this mutant?"""
    with tempfile.TemporaryDirectory() as work:              # a mutant that hangs is killed
        environment = {**os.environ, "VERICAN_MUTANT": str(number), "TMPDIR": work}
        try:
            return subprocess.run([program, "--gtest_brief=1"], env=environment,
                                  capture_output=True, timeout=120).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def main():
    """Entry point."""
    program = sys.argv[1]
    design = Design(models.rtl_files())
    mine = [mutant for mutant in design.candidates() if mutant.module == MODULE]
    numbers = {}
    for number, mutant in enumerate(mine, 1):        # as in transform.py
        numbers.setdefault((mutant.original, mutant.mutated), number)
    wrong = [] if passes(program, 0) else ["without a mutant the tests fail"]
    for wanted, rows in ((False, KILLED), (True, SPARED)):
        for why, original, mutated in rows:
            number = numbers.get((original, mutated))
            if number is None:
                wrong.append(f"{why}: the RTL has no mutant {original} -> {mutated} any more")
            elif passes(program, number) != wanted:
                wrong.append(f"{why}: {original} -> {mutated} is "
                             + ("killed" if wanted else "not noticed"))
    print("\n".join(wrong) if wrong else
          f"{len(KILLED)} of {len(mine)} mutants killed, {len(SPARED)} spared, as expected")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()

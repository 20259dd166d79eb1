#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""time_rules.py: the same as rules.py for the rules of time: checks tb/time/plan.yaml against the
tests and writes docs/time-rules.md. Tests and proofs that docs/time-spec.md names have to exist.
"""
import re

import yaml
from plain_end import run
from test_plan import ROOT, TEST, Plan, blank_opaque, main

SHOWN_BY = re.compile(r"\*\*\[(TM-\d+)\].*\*Test:\*(.*)")
# Suite.Test, Suite.* for all of a suite, and .Test for another of the suite named before.
NAME = re.compile(r"(?:\b([A-Z]\w+)|(?<=\s))\.([A-Z]\w*|\*)")
PROOF = re.compile(r"\bproof `time\.(\w+)`")


def tests():
    """Suite.Test of every GoogleTest, and Suite.* of every suite."""
    found = set()
    for path in (ROOT / "tb").glob("*/*_test.cpp"):
        for _, suite, name in TEST.findall(blank_opaque(path.read_text())):
            found |= {f"{suite}.{name}", f"{suite}.*"}
    return found


def proofs():
    """Names of the proofs of time."""
    plan = yaml.safe_load((ROOT / "tb/formal/time/proofs.yaml").read_text())
    return {proof["name"] for proof in plan["proofs"]}


def unknown_names(text, known_tests, known_proofs):
    """One line for every test and proof that the rules in `text` name and that is none."""
    for rule, shown_by in SHOWN_BY.findall(text):
        suite = ""
        for first, name in NAME.findall(shown_by):
            suite = first or suite
            if f"{suite}.{name}" not in known_tests:
                yield f"{rule}: no test {suite}.{name}"
        for name in PROOF.findall(shown_by):
            if name not in known_proofs:
                yield f"{rule}: no proof time.{name}"


class TimePlan(Plan):
    """Looks at the names in the book, too."""

    def problems(self, entries, cited):
        yield from super().problems(entries, cited)
        yield from unknown_names(self.book.read_text(), tests(), proofs())


PLAN = TimePlan(noun="rule", file=ROOT / "tb/time/plan.yaml", page=ROOT / "docs/time-rules.md",
            ids=re.compile(r"\bTM-\d{2,3}\b"), heading="Rules of time and their tests",
            command="make rules", book=ROOT / "docs/time-spec.md")


if __name__ == "__main__":
    run(lambda: main(PLAN, __doc__))

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""rules.py: checks that every rule of the plan has a test and writes docs/rules.md (rule -> tests).

Exit status 1 if a required rule has no test, a cited id is not in the plan, a rule that cannot
apply is cited, or, with --check, docs/rules.md is not what this script would write. What counts as
a citation: test_plan.py.
"""
import re
import sys

from test_plan import ROOT, Plan, main

RULE_BOOK = ROOT.parent / "shared/can-rules.md"  # present on the authors' machines only

FAMILIES = "FF|ST|CR|AK|IF|AR|RO|ED|EF|OV|FC|IN|BO|TL|BT|SY|VA|MO|TS|MX|TH|PF"
PLAN = Plan(noun="rule", file=ROOT / "tb/plan.yaml", page=ROOT / "docs/rules.md",
            ids=re.compile(rf"\b(?:(?:{FAMILIES})-\d\d[a-c]?|GV-\d)\b"),
            heading="Rules and their tests", command="make rules")


def differences_from_the_book(rules):
    """One line for every rule that only the rule book or only the plan has."""
    if not RULE_BOOK.exists():
        return
    book = set(re.findall(r"^- \*\*([A-Z]{2}-\d+[a-c]?)\*\*", RULE_BOOK.read_text(), re.M))
    book = {rule for rule in book if PLAN.ids.fullmatch(rule)}
    for rule in sorted(book ^ set(rules)):
        yield f"{rule}: in the rule book or in tb/plan.yaml, but not in both"


if __name__ == "__main__":
    sys.exit(main(PLAN, __doc__, differences_from_the_book))

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""rules.py: checks that every rule of the plan has a test and writes docs/rules.md (rule -> tests).

Exit status 1 if a required rule has no test, a cited id is not in the plan, a rule that cannot
apply is cited, or, with --check, docs/rules.md is not what this script would write. What counts as
a citation: test_plan.py.
"""
import re

from plain_end import run
from test_plan import ROOT, Plan, main

FAMILIES = "FF|ST|CR|AK|IF|AR|RO|ED|EF|OV|FC|IN|BO|TL|BT|SY|VA|MO|TS|MX|TH|PF"
PLAN = Plan(noun="rule", file=ROOT / "tb/plan.yaml", page=ROOT / "docs/rules.md",
            ids=re.compile(rf"\b(?:(?:{FAMILIES})-\d\d[a-c]?|GV-\d)\b"),
            heading="Rules and their tests", command="make rules",
            book=ROOT / "docs/can-rules.md")


if __name__ == "__main__":
    run(lambda: main(PLAN, __doc__))

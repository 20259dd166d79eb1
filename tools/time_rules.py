#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""time_rules.py: the same as rules.py for the rules of time: checks tb/time/plan.yaml against the
tests and writes docs/time-rules.md.
"""
import re
import sys

from test_plan import ROOT, Plan, main

PLAN = Plan(noun="rule", file=ROOT / "tb/time/plan.yaml", page=ROOT / "docs/time-rules.md",
            ids=re.compile(r"\bTM-\d{2,3}\b"), heading="Rules of time and their tests",
            command="make rules", book=ROOT / "docs/time-spec.md")


if __name__ == "__main__":
    sys.exit(main(PLAN, __doc__))

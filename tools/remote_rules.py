#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""remote_rules.py: the same as rules.py for the rules of the node without a processor: checks
tb/remote/plan.yaml against the tests and writes docs/remote-rules.md.
"""
import re

from plain_end import run
from test_plan import ROOT, Plan, main

PLAN = Plan(noun="rule", file=ROOT / "tb/remote/plan.yaml", page=ROOT / "docs/remote-rules.md",
            ids=re.compile(r"\bRN-\d{2,3}\b"),
            heading="Rules of the node without a processor and their tests",
            command="make rules", book=ROOT / "docs/remote-node.md")


if __name__ == "__main__":
    run(lambda: main(PLAN, __doc__))

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""flexcan_rows.py: checks that every row of tb/flexcan.yaml has a test and writes its page.

Exit status 1 if a required row has no test, a cited id is not in the file, a row that cannot apply
is cited, or, with --check, docs/flexcan-rows.md is not what this script would write. What counts as
a citation: test_plan.py.
"""
import re

from plain_end import run
from test_plan import ROOT, Plan, main

PLAN = Plan(noun="row", file=ROOT / "tb/flexcan.yaml", page=ROOT / "docs/flexcan-rows.md",
            ids=re.compile(r"\bFX-[0-9A-Za-z]+\.[0-9A-Za-z_]+(?:\.[a-z]\b)?"),
            heading="FlexCAN rows and their tests", command="make rows")

if __name__ == "__main__":
    run(lambda: main(PLAN, __doc__))

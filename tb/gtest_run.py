# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A test program of GoogleTest, as stages of the campaign run it."""
import os
import re
import subprocess


def run(command, log, cwd, timeout=None, **variables):
    """Runs a program with these variables into a log: tests passed, tests failed (a crash counts as
    one). Throws subprocess.TimeoutExpired if it takes longer than timeout, s."""
    with open(log, "w", encoding="utf-8") as file:
        status = subprocess.run(command, cwd=cwd, env={**os.environ, **variables}, stdout=file,
                                stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                timeout=timeout, check=False).returncode
    return counts(log.read_text(errors="replace"), status)


def counts(text, status):
    """The same of its output and exit code."""
    passed = re.search(r"^\[  PASSED  \] (\d+) tests?\.", text, re.MULTILINE)
    failed = re.search(r"^ *(\d+) FAILED TEST", text, re.MULTILINE)
    bad = int(failed[1]) if failed else 0
    if status and not bad:
        bad = 1
    return int(passed[1]) if passed else 0, bad

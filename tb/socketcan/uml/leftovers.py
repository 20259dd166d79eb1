# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A guest that does not end, or whose test is killed, leaves no process and no file."""
import os
import signal
import time
from pathlib import Path

import guest
from canlog import expect, expect_true


def _left(directory):
    """(processes, directory of the memory if it is still there) of the guest."""
    scratch, session = (directory / "guest.txt").read_text().splitlines()
    return guest.session_members(int(session)), [scratch] if Path(scratch).exists() else []


def _wait(condition, what, limit=60):
    end = time.monotonic() + limit
    while not condition():
        expect_true(time.monotonic() < end, f"{what}: not within {limit} s")
        time.sleep(0.02)


def time_limit(setup):
    """The limit ends a guest whatever runs in it."""
    directory = setup.directory("hang")
    try:
        guest.boot("hang", directory, setup.shim, limit=4)
    except guest.Failed as failure:
        expect_true("did not end within 4 s" in str(failure), f"another failure: {failure}")
    else:
        expect_true(False, "the limit did nothing")
    expect_true((directory / "console.txt").exists(), "no console")
    expect(_left(directory), ([], []), "left over")


def killed(setup):
    """A test that is killed takes its guest along."""
    directory = setup.directory("killed")
    child = os.fork()
    if child == 0:
        try:
            guest.boot("hang", directory, setup.shim)
        finally:
            os._exit(1)
    try:
        _wait((directory / "hanging").exists, "start of the guest")
        expect([bool(found) for found in _left(directory)], [True, True], "while it runs")
    finally:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    _wait(lambda: _left(directory) == ([], []), "end of the guest's processes and files")

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""guard.py DIRECTORY: waits for the end of its standard input, which comes when the process that
started it ends it or dies; then kills the session whose number was written there and removes
DIRECTORY. The processes of a guest outlive even the kill of their test otherwise."""
import os
import shutil
import signal
import sys
import time

from guest import session_members


def end(session):
    """Kills until nobody is left: a process may be born between the look and the kill."""
    try:
        os.killpg(session, signal.SIGKILL)
    except ProcessLookupError:
        pass
    while members := session_members(session):
        for pid in members:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.005)


def main():
    """Out of reach first: neither in the session nor in the family of the test."""
    if os.fork() != 0:
        os._exit(0)
    os.setsid()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    line = sys.stdin.readline().strip()
    sys.stdin.read()
    if line.isdigit():
        end(int(line))
    shutil.rmtree(sys.argv[1], ignore_errors=True)


if __name__ == "__main__":
    main()

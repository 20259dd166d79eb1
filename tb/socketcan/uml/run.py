#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Runs one SocketCAN case: a guest with a script of tb/socketcan/guest, then its judge.

Exit code: 0 passed, 1 failed, 77 this machine cannot run it (it says why).
"""
import argparse
import os
import subprocess
import sys
from pathlib import Path

import cases
import guest
from canlog import Failed

SKIPPED = 77


def options():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", choices=sorted(cases.CASES), metavar="CASE",
                        help=", ".join(sorted(cases.CASES)))
    parser.add_argument("--verican", type=Path, required=True)
    parser.add_argument("--shim", type=Path, required=True, help="the library of wide_xstate.c")
    parser.add_argument("--client", type=Path, help="remote_golden_client")
    parser.add_argument("--out", type=Path, required=True, help="directory of all cases' results")
    parser.add_argument("--sanitized", action="store_true", help="verican has sanitizers")
    parser.add_argument("--limit", type=int, default=240, help="seconds for the guest")
    args = parser.parse_args()
    args.verican = args.verican.resolve()
    return args


def main():
    """Runs, judges, tells."""
    args = options()
    # The administrator's programs, of which ip is one, are not on everybody's path.
    os.environ["PATH"] = f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"
    try:
        for line in cases.CASES[args.case](cases.Setup(args)) or []:
            print(line)
    except guest.Impossible as reason:
        print(f"{args.case}: skipped: {reason}")
        sys.exit(SKIPPED)
    except (Failed, guest.Failed) as reason:
        sys.exit(f"{args.case}: {reason}")
    except subprocess.CalledProcessError as error:
        said = error.stderr or b""
        said = said if isinstance(said, str) else said.decode(errors="replace")
        sys.exit(f"{args.case}: {error}\n{said}")
    print(f"{args.case}: passed")


if __name__ == "__main__":
    main()

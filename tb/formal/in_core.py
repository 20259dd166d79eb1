#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""in_core.py [--check] [--seeds N] [--jobs N]: does the core keep what its proofs assume?

Proofs assume things of the blocks beside the one that they are of. The files of in_core/, each
named like a module, say the same as assertions. They are spliced into a copy of the RTL; the random
software of the buffers and random buses run on it, which end with the first that does not hold.
--check: looks only whether the files fit the RTL (Verilator's lint).
"""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BUILD = ROOT / "build/formal-in-core"
PROGRAMS = ("buffer_random_test", "buffer_burst_test", "stamp_random_test", "random_campaign")
STATEMENT = re.compile(r"^( *)(m_\w+): assert (\(.*?\));$", re.M | re.S)


def assertions(path):
    """The text of a file, each statement as one that Verilator obeys without --assert."""
    text, count = STATEMENT.subn(
        r'\1if (!\3) begin $display("%m: \2 does not hold"); $stop; end', path.read_text())
    if count == 0:
        sys.exit(f"in_core: {path.name} asserts nothing")
    return text


def splice(rtl):
    """All files into the folder `rtl`, a copy of the RTL."""
    for path in sorted((HERE / "in_core").glob("*.sv")):
        module, = rtl.glob(f"*/{path.name}")
        head, end, tail = module.read_text().rpartition("endmodule")
        module.write_text(head + assertions(path) + end + tail)


def run(*command):
    done = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"in_core: {' '.join(map(str, command))}\n"
                 f"{done.stdout[-2000:]}{done.stderr[-2000:]}")


def check():
    with tempfile.TemporaryDirectory() as folder:
        rtl = Path(shutil.copytree(ROOT / "rtl", Path(folder) / "rtl"))
        splice(rtl)
        run("verilator", "--lint-only", "-Wno-fatal", "-Wno-lint", "-Wno-style", "-GNumMb=16",
            "-GTimeUnit=1", "--top-module", "can_ahb", "-F", rtl / "can.f")


def count(text):
    """A number of the command line, 1 or more: none would hold whatever the core does."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"'{text}'; allowed: whole numbers from 1 on")
    return int(text)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only whether they fit the RTL")
    parser.add_argument("--seeds", type=count, default=100, help="random buses (100)")
    parser.add_argument("--jobs", type=count, default=2, help="of the build (2)")
    options = parser.parse_args()
    if options.check:
        return check()
    shutil.rmtree(BUILD / "rtl", ignore_errors=True)
    rtl = Path(shutil.copytree(ROOT / "rtl", BUILD / "rtl"))
    splice(rtl)
    run("cmake", "--preset", "release", "-B", BUILD / "build", f"-DVERICAN_RTL_DIR={rtl}")
    run("cmake", "--build", BUILD / "build", "-j", str(options.jobs), "--target", *PROGRAMS)
    for program in PROGRAMS[:-1]:
        run(BUILD / "build/tb" / program, "--gtest_brief=1")
        print(f"{program}: all assumptions hold", flush=True)
    run(BUILD / "build/tb/random/random_campaign", "--runs", str(options.seeds), "--frames-a-run",
        "300", "--no-shrink", "--directory", BUILD / "random")
    print(f"{options.seeds} random buses: all assumptions hold")
    return 0


if __name__ == "__main__":
    sys.exit(main())

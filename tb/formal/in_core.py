#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""in_core.py [--check]: does the core keep what its proofs assume? (stage `assumptions`)

Proofs assume things of the blocks beside the one that they are of. The files of in_core/, each
named like a module, say the same as assertions. They are spliced into a copy of the RTL; the random
software of the buffers and random buses run on it, which end with the first that does not hold.
Writes figures to CAMPAIGN_OUT if that is set. Ends with status 1 if one does not hold.
--check: looks only whether the files fit the RTL (Verilator's lint).
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.append(str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position
import gtest_run  # noqa: E402  pylint: disable=wrong-import-position
from runner.model import spliced  # noqa: E402  pylint: disable=wrong-import-position

BUILD = ROOT / "build/formal-in-core"
TESTS = ("buffer_random_test", "buffer_burst_test", "stamp_random_test")
SOFTWARE = 0.1    # part of the stage `buffers`, beside the seeds of the tests
BUSES = 100       # random buses
STATEMENT = re.compile(r"^( *)(m_\w+): assert (\(.*?\));$", re.M | re.S)


def assertions(path):
    """The text of a file, each statement as one that Verilator obeys without --assert, and how many
    there are."""
    text, count = STATEMENT.subn(
        r'\1if (!\3) begin $display("%m: \2 does not hold"); $stop; end', path.read_text())
    if count == 0:
        sys.exit(f"in_core: {path.name} asserts nothing")
    return text, count


def splice(rtl):
    """All files into the folder `rtl`, a copy of the RTL; returns how many assertions there are."""
    number = 0
    for path in sorted((HERE / "in_core").glob("*.sv")):
        module, = rtl.glob(f"*/{path.name}")
        text, count = assertions(path)
        module.write_text(spliced(module.read_text(), module.stem, text))
        number += count
    return number


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


def build(jobs):
    """The programs on a core with the assertions; returns how many there are."""
    shutil.rmtree(BUILD / "rtl", ignore_errors=True)
    rtl = Path(shutil.copytree(ROOT / "rtl", BUILD / "rtl"))
    number = splice(rtl)
    run("cmake", "--preset", "release", "-B", BUILD / "build", f"-DVERICAN_RTL_DIR={rtl}")
    run("cmake", "--build", BUILD / "build", "-j", str(jobs), "--target", *TESTS, "random_campaign")
    return number


def passes(name, log, command, **variables):
    """Whether a program ends well; if not, its log is named."""
    with open(log, "w", encoding="utf-8") as file:
        code = subprocess.run(list(map(str, command)), cwd=ROOT, stdout=file, stderr=file,
                              env={**os.environ, **variables}, check=False).returncode
    print(f"{name}: " + ("all assumptions hold" if code == 0 else f"failed, see {log}"), flush=True)
    return code == 0


def campaign(scratch):
    """The result of the stage."""
    scale, jobs = campaign_settings.scale(), campaign_settings.jobs()
    number, tests = build(jobs), []
    for program in TESTS:
        log = scratch / f"{program}.log"
        passed, bad = gtest_run.run([BUILD / "build/tb" / program], log, ROOT)
        print(f"{program}: {passed} passed, {bad} failed" + (f", see {log}" if bad else ""),
              flush=True)
        tests.append((passed, bad or int(passed == 0)))
    buses = max(1, round(BUSES * scale))
    good = [
        passes("random software", scratch / "software.log",
               ["tb/mailbox/campaign.py", "--program", BUILD / "build/tb/buffer_random_test"],
               CAMPAIGN_SCALE=str(scale * SOFTWARE), CAMPAIGN_OUT="",
               CAMPAIGN_DIR=str(scratch / "software"), CAMPAIGN_JOBS=str(jobs)),
        passes("random buses", scratch / "buses.log",
               [BUILD / "build/tb/random/random_campaign", "--runs", buses, "--frames-a-run", 300,
                "--no-shrink", "--directory", scratch / "random"], CAMPAIGN_OUT="")]
    passed, failed = (sum(column) for column in zip(*tests))
    figures = [
        {"name": "assumptions that stand in the core as assertions", "value": number, "bar": None,
         "ok": None},
        {"name": "tests passed on it", "value": passed, "text": f"{passed} of {passed + failed}",
         "bar": "all", "ok": failed == 0},
        {"name": "random software and random buses that ended early", "value": good.count(False),
         "bar": "0", "ok": all(good)}]
    notes = [f"Random software: {SOFTWARE * scale:g} of the runs of the stage `buffers`. "
             f"Random buses: {buses}, some 300 frames each."]
    return {"figures": figures, "tables": [], "notes": notes}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only whether they fit the RTL")
    if parser.parse_args().check:
        return check()
    campaign_settings.scale(), campaign_settings.jobs()  # refused before the work
    out = campaign_settings.result_file()
    scratch = Path(os.environ.get("CAMPAIGN_DIR", BUILD / "run")).resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    return campaign_settings.write_result(out, campaign(scratch))


if __name__ == "__main__":
    sys.exit(main())

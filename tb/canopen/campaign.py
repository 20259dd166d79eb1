#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Stage canopen of the campaign: ten minutes of the robot (examples/robot), and where CANOPENNODE
names the user's copy ten minutes of a drive of CANopenNode, SYNC and a set point each
millisecond."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "build/release"
SECONDS = 600
sys.path[:0] = [str(ROOT / "tb/canopen"), str(ROOT / "tb")]
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position


def robot(seconds):
    """Figures of examples/robot."""
    done = subprocess.run([sys.executable, "-B", str(ROOT / "examples/robot/robot.py"), "--json",
                           "--seconds", f"{seconds:g}"], stdout=subprocess.PIPE, check=False,
                          env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
    if done.returncode not in (0, 1) or not done.stdout:
        sys.exit(f"campaign canopen: robot.py: exit code {done.returncode}")
    return json.loads(done.stdout)


def drive(seconds):
    """SYNCs, and TPDOs lost, of a drive of CANopenNode; None: there is no copy of it."""
    if not os.environ.get("CANOPENNODE"):
        return None
    with tempfile.TemporaryDirectory() as folder:
        os.environ["VERICAN_CANOPEN_FIRMWARE"] = folder
        os.environ["VERICAN_BINARY"] = str(BUILD / "verican")
        subprocess.run([sys.executable, "-B", str(ROOT / "sw/canopennode/build.py"), folder, "1"],
                       check=True)
        from drive_cases import cycles  # pylint: disable=import-outside-toplevel
        return cycles(folder, round(seconds * 1000))


def figure(name, value, text, ok, bar):
    """A figure of the stage."""
    return {"name": name, "value": value, "text": text, "bar": bar, "ok": ok}


def main():
    """Runs both, side by side, and writes the result; returns 1 if a figure misses its bar."""
    seconds = max(1.0, SECONDS * campaign_settings.scale())
    out = campaign_settings.result_file()
    with ThreadPoolExecutor() as both:
        of_robot, of_drive = both.submit(robot, seconds), both.submit(drive, seconds)
        found, stack = of_robot.result(), of_drive.result()
    wanted = round(seconds * 1000)
    figures = [
        figure("robot: milliseconds with a SYNC", found["syncs"], f"{found['syncs']:,}",
               found["syncs"] == wanted, "all"),
        figure("robot: PDOs lost", found["lost"], f"{found['lost']:,}", found["lost"] == 0, "0"),
        figure("robot: checks that hold", sum(c["ok"] for c in found["checks"]),
               f"{sum(c['ok'] for c in found['checks'])} of {len(found['checks'])}",
               all(c["ok"] for c in found["checks"]), "all")]
    notes = [] if os.environ.get("CANOPENNODE") else ["CANOPENNODE was not set: no CANopenNode."]
    if stack is not None:
        syncs, lost, right = stack
        figures += [figure("CANopenNode: milliseconds with a SYNC", syncs, f"{syncs:,}",
                           syncs == wanted, "all"),
                    figure("CANopenNode: PDOs lost", lost, f"{lost:,}", lost == 0 and right, "0")]
    table = {"title": "The robot, us from event to end", "columns": ["message", "largest"],
             "rows": [[name, f"{value:.1f}"] for name, value in found["largest_us"].items()]}
    for item in figures:
        print(f"{item['name']}: {item['text']}")
    return campaign_settings.write_result(
        out, {"figures": figures, "tables": [table], "notes": notes})


if __name__ == "__main__":
    sys.exit(main())

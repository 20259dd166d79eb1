# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Netlists of the whole core, and recorded pins on them (tb/four_state/run.py)."""
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT / "tb/four_state"))
from devices import DEVICES  # noqa: E402  pylint: disable=wrong-import-position


def rtl_files():
    """The files of rtl/can.f."""
    lines = (line.split("#")[0].strip() for line in (ROOT / "rtl/can.f").read_text().splitlines())
    return [str(ROOT / "rtl" / line) for line in lines if line]


def netlist_of(kind, device, size, path):
    """Writes a device of tb/four_state as tools/netlist/KIND.sh makes it; `size`: buffers of
    ahb."""
    top = DEVICES[device]
    settings = [f"{name}={value}" for name, value in top.parameters(size).items()]
    subprocess.run([ROOT / f"tools/netlist/{kind}.sh", path, top.top, *settings, "--",
                    *rtl_files()], check=True, stdin=subprocess.DEVNULL)


def replay(recordings, num_mb, build, netlist=None, json=None, jobs=1, device="ahb"):
    """Plays recordings (all if there are none named) to the RTL or a netlist; status and text.
    `num_mb`: of the core, device ahb; None: of another device, which has one size."""
    command = [sys.executable, ROOT / "tb/four_state/run.py", *recordings, "--build", build,
               "--jobs", str(jobs), "--device", device]
    if num_mb:
        command += ["--num-mb", str(num_mb)]
    if netlist:
        command += ["--netlist", netlist]
    if json:
        command += ["--json", json]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout + done.stderr

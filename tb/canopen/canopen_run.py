# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What the cases of CANopen share: a scenario that runs, programs of Node.js on its bus."""
import contextlib
import json
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import unittest

import yaml

HERE = pathlib.Path(__file__).resolve().parent
FIRMWARE = pathlib.Path(os.environ["VERICAN_CANOPEN_FIRMWARE"])
CLOCK = "16 MHz"  # of the drives, as sw/canopennode/build.py has it
needs_stack = unittest.skipUnless(os.environ.get("CANOPENNODE"),
                                  "CANOPENNODE names no copy of CANopenNode 4")
LIMIT = 1400  # s of real time


def drive(number, name=None):
    """A node of a scenario: the drive with that node-ID."""
    return {"name": name or f"drive{number}", "clock": CLOCK,
            "firmware": str(FIRMWARE / f"drive{number}.elf")}


def program_node(clients=1, name="can0"):
    """A node that programs work by TCP."""
    return {"name": name, "clock": "8 MHz", "socketcand": "127.0.0.1:0",
            "wait_for_clients": clients}


def scenario(folder, **keys):
    """The file of a scenario at 1 Mbit/s."""
    file = pathlib.Path(folder) / "scenario.yaml"
    file.write_text(yaml.safe_dump({"bitrate": "1000k", **keys}, sort_keys=False),
                    encoding="utf-8")
    return file


def simulate(file, *options):
    """Runs a scenario to its end: exit code and report."""
    done = subprocess.run([os.environ["VERICAN_BINARY"], "run", str(file), "--json", *options],
                          stdout=subprocess.PIPE, check=False)
    return done.returncode, json.loads(done.stdout)["runs"][0]


@contextlib.contextmanager
def live(file, *options):
    """A scenario with programs: yields the port of socketcand, ends the run afterwards."""
    with tempfile.TemporaryFile("w+") as output, subprocess.Popen(
            [os.environ["VERICAN_BINARY"], "run", str(file), *options], stdout=output,
            stderr=subprocess.PIPE, text=True) as process:
        try:
            line = process.stderr.readline()
            found = re.search(r" at 127\.0\.0\.1:(\d+)$", line)
            if not found:
                raise AssertionError(f"no port in: {line}")
            yield int(found[1])
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)


def start_program(script, *arguments):
    """A program of Node.js in this folder, with canopen within its reach."""
    return subprocess.Popen(["node", str(HERE / script), *map(str, arguments)],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def program(script, *arguments):
    """Runs it: exit code and what it printed."""
    with start_program(script, *arguments) as process:
        try:
            text, _ = process.communicate(timeout=LIMIT)
        finally:
            process.kill()
    return process.returncode, text

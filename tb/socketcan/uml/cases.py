# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The cases: each a function that prepares, runs and judges, and returns lines to print."""
import json
import re
import shutil
from pathlib import Path

import failures
import guest
import leftovers
import recordings
import tools
import traffic
from canlog import expect, expect_true


class Setup:
    """What a case works with: tools, and its directory."""

    def __init__(self, args):
        self.verican = args.verican
        self.shim = args.shim
        self.out = args.out.resolve()
        self.limit = args.limit

    def directory(self, name):
        """An empty directory for the results of a case without a guest."""
        path = self.out / name
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def run(self, script, files=None, **settings):
        """A guest with guest/SCRIPT.sh, which finds `files` (name: text); returns what it left."""
        directory = self.out / script
        settings = {"VERICAN": self.verican, **settings}
        console = guest.boot(script, directory, self.shim, settings, files, self.limit).console
        run = Run(directory)
        bad = [line for line in console.splitlines() if "FAILED" in line]
        expect(bad, [], "the guest complains")
        pattern = re.compile("WARNING:|BUG:|Call Trace|Out of memory|segfault")
        expect([line for line in run.text("dmesg.txt").splitlines() if pattern.search(line)], [],
               "messages of the kernel")
        return run


class Run:
    """The files that a guest left."""

    def __init__(self, directory):
        self.dir = directory

    def text(self, name):
        """A whole file; Failed if it is missing."""
        path = self.dir / name
        expect_true(path.exists(), f"{name} is missing")
        return path.read_text(errors="replace")

    def packets(self, name):
        """(received, sent, dropped) of ip's statistics in a file."""
        stats = json.loads(self.text(name))[0]["stats64"]
        dropped = sum(stats[way][key] for way in ("rx", "tx") for key in ("dropped", "errors"))
        return stats["rx"]["packets"], stats["tx"]["packets"], dropped

    def ended(self, name, code=0):
        """The bridge NAME ended with this code."""
        expect(self.text(f"{name}.code").strip(), str(code),
               f"exit code of {name} ({self.text(name + '.err').strip()[-300:]})")


def tshark(setup):
    """A pcap of `verican run` in Wireshark's dissector."""
    recordings.tshark(setup.verican, setup.directory("tshark"))


def asc(setup):
    """A log of `verican run` to Vector's format and back."""
    recordings.asc(setup.verican, setup.directory("asc"))


def canplayer(setup):
    """A log of `verican run` played onto a vcan."""
    source = setup.directory("canplayer-source")
    sent = recordings.record(setup.verican, source, raw_dlc=False)
    run = setup.run("canplayer", VERICAN_LOG=source / "bus.log", VERICAN_FRAMES=len(sent))
    run.sent = sent
    recordings.canplayer(run)


def flood(setup):
    """10,000 frames each way through a vcan."""
    return traffic.flood(setup.run("flood", {"flood.yaml": traffic.FLOOD}))


def duel(setup):
    """Two interfaces as two nodes of one bus, both flooding."""
    return traffic.duel(setup.run("duel", traffic.duel_files()))


def everyday_tools(setup):
    """can-utils and python-can."""
    source = setup.directory("tools-source")
    sent = recordings.record(setup.verican, source, raw_dlc=False)
    run = setup.run("tools", **tools.settings(source, sent))
    run.sent = sent
    return tools.tools(run)


def errors(setup):
    """Error messages: nobody acknowledges, bus-off and recovery, a receiver, arbitration."""
    failures.errors(setup.run("errors", failures.files(), **failures.settings()))


CASES = {
    "errors": errors,
    "flood": flood,
    "duel": duel,
    "tools": everyday_tools,
    "guest-time-limit": leftovers.time_limit,
    "guest-killed": leftovers.killed,
    "recording-tshark": tshark,
    "recording-asc": asc,
    "recording-canplayer": canplayer,
}

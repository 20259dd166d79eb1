# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The cases: each a function that prepares, runs and judges, and returns lines to print."""
import json
import shutil

import failures
import guest
import lifetimes
import leftovers
import recordings
import red
import remote
import stacks
import tools
import traffic
from canlog import expect, expect_true

# canlog has made sw/linux known.
import kernel_log  # pylint: disable=wrong-import-order


class Setup:
    """What a case works with: tools, and its directory."""

    def __init__(self, args):
        self.verican = args.verican
        self.shim = args.shim
        self.client = args.client and args.client.resolve()
        self.out = args.out.resolve()
        self.limit = args.limit
        self.sanitized = args.sanitized

    def directory(self, name):
        """An empty directory for the results of a case without a guest."""
        path = self.out / name
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def check_verican(self):
        """Raises Impossible if it cannot run in a guest."""
        if self.sanitized:
            raise guest.Impossible("a verican with sanitizers needs more address space than "
                                   "user-mode Linux gives its processes")

    def run(self, script, files=None, **settings):
        """A guest with guest/SCRIPT.sh, which finds `files` (name: text); returns what it left."""
        directory = self.out / script
        settings = {"VERICAN": self.verican, **settings}
        console = guest.boot(script, directory, self.shim, settings, files, self.limit)
        run = Run(directory)
        bad = [line for line in console.splitlines() if "FAILED" in line]
        expect(bad, [], "the guest complains")
        expect(kernel_log.complaints(run.text("dmesg.txt")), [], "messages of the kernel")
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


def tools_source(setup):
    """A recording for canplayer, and its frames."""
    source = setup.directory("tools-source")
    return source, recordings.record(setup.verican, source, raw_dlc=False)


def judge_tools(run):
    """The judge of `tools` wants to know what was recorded."""
    run.sent = recordings.every_frame(raw_dlc=False)
    tools.tools(run)


# Of each guest script: what it finds in its directory, its variables, its judge.
SCRIPTS = {
    "flood": (lambda setup: ({"flood.yaml": traffic.FLOOD}, {}), traffic.flood),
    "duel": (lambda setup: (traffic.duel_files(), {}), traffic.duel),
    "tools": (lambda setup: ({}, tools.settings(*tools_source(setup))), judge_tools),
    "errors": (lambda setup: (failures.files(), failures.settings()), failures.errors),
    "interfaces": (lambda setup: (failures.files(), {}), lifetimes.interfaces),
    "vxcan": (lambda setup: ({"vxcan.yaml": lifetimes.VXCAN},
                             {"VERICAN_STRANGE": " ".join(lifetimes.STRANGE)}), lifetimes.vxcan),
    "signals": (lambda setup: ({}, {}), lifetimes.signals),
    "remote": (remote.files, remote.remote),
    "stacks": (stacks.prepare, stacks.stacks),
}


def _guest_case(script):
    prepare, judge = SCRIPTS[script]

    def case(setup):
        setup.check_verican()
        files, settings = prepare(setup)
        return judge(setup.run(script, files, **settings))
    return case


def _red_case(script):
    judge = SCRIPTS[script][1]

    def case(setup):
        setup.check_verican()
        source = setup.out / script
        expect_true((source / "ended").exists(), f"{script} has not run")
        return red.notices(script, lambda directory: judge(Run(directory)), source,
                           setup.out / f"red-{script}")
    return case


CASES = {
    "guest-time-limit": leftovers.time_limit,
    "guest-killed": leftovers.killed,
    "recording-tshark": tshark,
    "recording-asc": asc,
    "recording-canplayer": canplayer,
    **{script: _guest_case(script) for script in SCRIPTS},
    **{f"red-{script}": _red_case(script) for script in SCRIPTS},
}

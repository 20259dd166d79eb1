# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes without a processor on a virtual CAN: both clients and `verican memory` (RN-93, RN-95)."""
import json
import re
from pathlib import Path

import yaml

import guest
from canlog import expect, expect_true

ROOT = Path(__file__).resolve().parents[3]
VECTORS = ROOT / "sw/remote/vectors.yaml"
LIVES = yaml.safe_load(VECTORS.read_text(encoding="utf-8"))["lives"]
FEATURES = {"small": {"stage"}, "full": {"stage", "block"}}  # that vectors ask for (RN-25)
# What each client says that was content.
CONTENT = {"c": "[  PASSED  ] 1 test.", "python": "\nOK\n"}


def scenario(profile, life):
    """A bus with the RTL of the node of a life."""
    return ("bitrate: 500k\nnodes:\n"
            f"  - {{name: unit, type: remote, profile: {profile}, made_of: rtl, number: "
            f"{life['number']}, name_bits: {life['name_bits']}, serial: 0x{life['serial']:X}}}\n")


def files(setup):
    """A bus with the RTL of the node of each life and profile, and the clients' variables."""
    if setup.client is None:
        raise guest.Impossible("the client of the golden vectors is not built")
    buses = {f"{profile}-{i}.yaml": scenario(profile, life)
             for profile in FEATURES for i, life in enumerate(LIVES)}
    return buses, {"VERICAN_CLIENT": setup.client, "VERICAN_VECTORS": VECTORS,
                   "VERICAN_PYTHON_CLIENT": ROOT / "tb/remote/guest/golden_client.py"}


def wanted_frames(life, profile):
    """What is on the bus, other frames in between: requests and answers."""
    frames = [life["boot"]]
    for vector in life["vectors"]:
        if not set(vector.get("needs", ())) <= FEATURES[profile]:
            continue
        for step in vector["steps"]:
            answers = step.get("answers", [])
            answers = answers[profile] if isinstance(answers, dict) else answers
            frames += [step["send"], *answers]
    return frames


def missing_frame(log, life, profile):
    """The first of these that is not in a log of candump's in its order; None: all are."""
    seen = iter(line.split()[2] for line in log.splitlines())
    return next((frame for frame in wanted_frames(life, profile) if frame not in seen), None)


def check_life(run, client, profile, i):
    """The client was content, and the frames of the vectors were on the bus in their order."""
    name = f"{client}-{profile}-{i}"
    expect_true(CONTENT[client] in run.text(f"{name}.txt"), run.text(f"{name}.txt")[-800:])
    expect(run.text(f"{name}.client").strip(), "0", f"exit code of the client, {name}")
    run.ended(name)
    expect(missing_frame(run.text(f"{name}.log"), LIVES[i], profile), None,
           f"{name}: first frame of the vectors that is not on the bus")
    return len(wanted_frames(LIVES[i], profile))


def remote(run):
    """All that guest/remote.sh left."""
    count = sum(check_life(run, client, profile, i) for client in CONTENT for profile in FEATURES
                for i in range(len(LIVES)))
    run.ended("memory")
    for name, code in (("scan", 0), ("write", 0), ("read", 0), ("refused", 1), ("down", 2)):
        expect(run.text(f"{name}.code").strip(), str(code), f"memory {name}: exit code")
    expect_true(re.search("cafe1234", run.text("scan.out"), re.I)
                or str(0xCAFE1234) in run.text("scan.out"), "scan: the serial number")
    data = json.dumps(json.loads(run.text("read.out")))
    expect_true(re.search(r"5A.?A5.?00|90, 165, 0", data, re.I), f"read: {data}")
    expect_true(re.search("illegal address", run.text("refused.err")), run.text("refused.err"))
    expect_true(re.search("'vcan0': Network is down; allowed: a CAN interface that is up",
                          run.text("down.err")), run.text("down.err"))
    return [f"{count} frames of the golden vectors through a socket and the RTL"]

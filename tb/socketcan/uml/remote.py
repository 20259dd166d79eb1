# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes without a processor on a virtual CAN: the C client and `verican memory` (RN-93, RN-95)."""
import json
import re
from pathlib import Path

import yaml

import guest
from canlog import expect, expect_true

VECTORS = Path(__file__).resolve().parents[3] / "sw/remote/vectors.yaml"
LIVES = yaml.safe_load(VECTORS.read_text(encoding="utf-8"))["lives"]
SMALL = {"stage"}  # features of the profile (RN-25)


def files(setup):
    """A bus with the RTL of the node of each life, and the client's variables."""
    if setup.client is None:
        raise guest.Impossible("the client of the golden vectors is not built")
    buses = {}
    for i, life in enumerate(LIVES):
        buses[f"life{i}.yaml"] = (
            "bitrate: 500k\nnodes:\n"
            f"  - {{name: unit, type: remote, profile: small, made_of: rtl, number: "
            f"{life['number']}, name_bits: {life['name_bits']}, serial: 0x{life['serial']:X}}}\n")
    return buses, {"VERICAN_CLIENT": setup.client, "VERICAN_VECTORS": VECTORS}


def wanted_frames(life):
    """What is on the bus, other frames in between: requests and answers."""
    frames = [life["boot"]]
    for vector in life["vectors"]:
        if not set(vector.get("needs", ())) <= SMALL:
            continue
        for step in vector["steps"]:
            answers = step.get("answers", [])
            answers = answers["small"] if isinstance(answers, dict) else answers
            frames += [step["send"], *answers]
    return frames


def check_life(run, name, life):
    """The client was content, and the frames of the vectors were on the bus in their order."""
    expect_true("[  PASSED  ] 1 test." in run.text(f"{name}.txt"), run.text(f"{name}.txt")[-800:])
    expect(run.text(f"{name}.client").strip(), "0", f"exit code of the client, {name}")
    run.ended(name)
    seen = iter(line.split()[2] for line in run.text(f"{name}.log").splitlines())
    wanted = wanted_frames(life)
    missing = next((frame for frame in wanted if frame not in seen), None)
    expect(missing, None, f"{name}: first frame of the vectors that is not on the bus")
    return len(wanted)


def remote(run):
    """All that guest/remote.sh left."""
    count = sum(check_life(run, f"life{i}", life) for i, life in enumerate(LIVES))
    run.ended("memory")
    for name, code in (("scan", 0), ("write", 0), ("read", 0), ("refused", 1)):
        expect(run.text(f"{name}.code").strip(), str(code), f"memory {name}: exit code")
    expect_true(re.search("cafe1234", run.text("scan.out"), re.I)
                or str(0xCAFE1234) in run.text("scan.out"), "scan: the serial number")
    data = json.dumps(json.loads(run.text("read.out")))
    expect_true(re.search(r"5A.?A5.?00|90, 165, 0", data, re.I), f"read: {data}")
    expect_true(re.search("illegal address", run.text("refused.err")), run.text("refused.err"))
    return [f"{count} frames of the golden vectors through a socket and the RTL"]

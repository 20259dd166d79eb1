#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""bench_page.py RESULTS PAGE: docs/performance.md from the JSON files of `make bench`.

RESULTS holds *_bench.json (Google Benchmark), replay_*.json (verican replay --json) and, if the
tests have run, ctest.log.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

# Measured once beside other cores by the authors, all in one run on one machine: CPU time, medians
# of nine interleaved rounds, two nodes on a saturated bus, million node-cycles a second.
BESIDE_OTHERS = """## Beside other cores

Of November 2026, before clocks were passed over: one run on one machine, CPU time, medians of nine
interleaved rounds, two nodes on a saturated bus, million node-cycles a second. Not to be set beside
the figures above, which are of another machine and another state of the simulator.

| clock | this simulator, whole cores | noasic, engine alone | OpenCores |
|---|---|---|---|
| 8 MHz | 10.3 | does not work | 3.5 |
| 10 MHz | 10.5 | 7.1 | 3.3 |
| 16 MHz | 13.7 | 7.6 | 3.5 |
| 50 MHz | 18.5 | 8.2 | 3.5 |

The others are plainly Verilated. The lead comes from the split of engine and host, not from the
RTL: one plain model of `can_ahb` does 2.7 to 3.2.
"""

# The shares and the evaluations: counted once, saturated_bus/nodes:2/drift:1.
SHARES = """Of the time of two saturated nodes with clocks of their own at 80 MHz, the host side's
model takes 34 %, the engine's 24 %, the bus and what ties them together the rest. At 8, 16 and
80 MHz the engine is evaluated in full 1.4 times a bit, and 2.7, 2.8 and 3.0 times for what follows
from its inputs alone; the host side 75 to 87 times a frame and node, 16 of them for accesses. The
floor of this way is the sample point, an evaluation of some 750 instructions."""


def benchmarks(results):
    """Name without suffix -> median entry, of all benchmark files; and the machine."""
    medians, context = {}, {}
    for path in sorted(results.glob("*_bench.json")):
        data = json.loads(path.read_text())
        context = data["context"]
        for entry in data["benchmarks"]:
            if entry.get("aggregate_name") == "median":
                medians[entry["run_name"]] = entry
    return medians, context


def arguments(name):
    """ "saturated_bus/nodes:2/MHz:8/drift:1" -> {"nodes": 2, "MHz": 8, "drift": 1} """
    return {key: int(value) for key, value in re.findall(r"(\w+):(\d+)", name)}


def mega(entry):
    return f"{entry['node_cycles/s'] / 1e6:.2f}"


def saturated(medians):
    """The table of saturated buses, ideal and drifting clocks side by side."""
    text = ["| nodes | clock | node-cycles/s, one clock | simulated/CPU | "
            "node-cycles/s, own clocks | simulated/CPU |", "|---|---|---|---|---|---|"]
    for name, entry in medians.items():
        args = arguments(name)
        if not name.startswith("saturated_bus") or args["drift"]:
            continue
        own = medians[name.replace("drift:0", "drift:1")]
        text.append(f"| {args['nodes']} | {args['MHz']} MHz | {mega(entry)} M | "
                    f"{entry['real_time']:.3f} | {mega(own)} M | {own['real_time']:.3f} |")
    return text


def parts(medians):
    """Beside the first table: nodes with the time unit, and what each part does alone."""
    text = ["| what | node-cycles/s |", "|---|---|"]
    for name, entry in medians.items():
        if not name.startswith("saturated_bus") and "node_cycles/s" in entry:
            what, _, detail = name.partition("/")
            detail = detail.replace("/", ", ").replace(":", " ")
            text.append(f"| {what.replace('_', ' ')}{', ' + detail if detail else ''} | "
                        f"{mega(entry)} M |")
    return text


def replays(results):
    """Recordings replayed whole; empty if none was there."""
    rows = []
    for path in sorted(results.glob("replay_*.json")):
        data = json.loads(path.read_text())
        rows.append(f"| {path.stem.removeprefix('replay_')} | {data['frames']} | "
                    f"{len(data['nodes'])} | {data['duration_ps'] / 1e12:.1f} s | "
                    f"{data['wall_seconds']:.1f} s |")
    if not rows:
        return []
    return ["", "## Recordings, replayed whole", "",
            "As fast as the bus allows; every node received every frame, bit by bit.", "",
            "| recording | frames | nodes | simulated | wall |", "|---|---|---|---|---|", *rows]


def suite(results):
    log = results / "ctest.log"
    if not log.exists():
        return []
    text = log.read_text()
    tests = re.search(r"tests passed, .* out of (\d+)", text)
    wall = re.search(r"Total Test time \(real\) = +([\d.]+) sec", text)
    if not tests or not wall:
        return []
    return ["", "## The test suite", "",
            f"{tests.group(1)} tests in {float(wall.group(1)):.0f} s of wall time."]


def machine(context):
    model = "unknown processor"
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.partition(":")[2].strip()
            break
    run = subprocess.run(["verilator", "--version"], capture_output=True, text=True, check=True)
    return f"{model}, {context['num_cpus']} CPUs; {run.stdout.split(' rev')[0].strip()}"


def page(results):
    medians, context = benchmarks(results)
    if not medians:
        sys.exit(f"bench_page.py: {results} has no medians in a *_bench.json; run: make bench")
    text = ["# Speed of the simulator", "",
            "Written by `make bench`; medians of three or more runs on one CPU core, CPU time.",
            f"Machine: {machine(context)}.", "",
            "## Saturated bus, 1 Mbit/s, whole cores", "", *saturated(medians), "",
            "A node-cycle is one clock of one Verilated `can_ahb`; simulated/CPU 1 is real time.",
            "The time is that of the processor, not of the clock on the wall. A node runs as two",
            "models, engine and host side, which rest while nothing changes for them; what is done",
            "in closed form meanwhile is listed in [simulator.md](simulator.md).",
            "", BESIDE_OTHERS.rstrip()]
    text += ["", "## Where the time goes", "", *parts(medians), "",
             "*Bus with time* is the saturated bus with nodes that have the time unit, *kernel*",
             "the bus with nodes that do nothing, *engine* `can_core` and *core* `can_ahb` on an",
             "idle bus without observers; *remote nodes* are two without a processor, of profile",
             "full, with so many reads of a host in 10 ms."]
    text += ["", SHARES]
    return "\n".join(text + replays(results) + suite(results)) + "\n"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    Path(sys.argv[2]).write_text(page(Path(sys.argv[1])))

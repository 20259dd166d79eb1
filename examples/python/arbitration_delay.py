# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""arbitration_delay.py OUT.svg: how long frames of three priorities wait as the load of the bus
grows. Needs python3-matplotlib; PYTHONPATH=build/release/python."""
import random
import sys

import matplotlib
from verican import Bus, Frame

matplotlib.use("svg")
import matplotlib.pyplot as plot  # noqa: E402  the backend comes first

NODES = {"high": 0x010, "middle": 0x200, "low": 0x700}
SECONDS = 0.5
FRAME_BITS = 130  # 8 bytes, about


def waits(load, seed=1):
    """Mean time from queue to end of the frame, ms, of each node at a load 0..1."""
    bus, dice = Bus(list(NODES), bitrate=500e3), random.Random(seed)
    rate = load / len(NODES) / (FRAME_BITS * bus.bit_time)
    due = sorted((at, node) for node in NODES
                 for at in [dice.uniform(0, SECONDS) for _ in range(int(rate * SECONDS))])
    queued = {node: [] for node in NODES}
    for at, node in due:
        bus.pass_time(max(0.0, at - bus.now))
        bus.send(node, Frame(NODES[node], dice.randbytes(8)))
        queued[node].append(at)
    bus.run_until_quiet(10)
    ends = {node: [end for _, end, sender, _ in frames if sender == node]
            for frames in [bus.frames()] for node in NODES}
    return {node: 1e3 * sum(e - q for e, q in zip(ends[node], queued[node])) / len(ends[node])
            for node in NODES}


def figures(loads):
    """The waits at each load, printed as well."""
    results = [waits(load) for load in loads]
    for load, result in zip(loads, results):
        print(f"{load:4.0%}", *(f"{node} {result[node]:.3f} ms" for node in NODES))
    sys.stdout.flush()
    return results


def draw(picture, loads, results):
    for node in NODES:
        plot.plot([100 * load for load in loads], [r[node] for r in results], "o-",
                  label=f"{node}, {NODES[node]:#05x}")
    plot.xlabel("load of the bus, %")
    plot.ylabel("mean time from queue to end, ms")
    plot.legend()
    plot.savefig(picture, format="svg")


def main():
    loads = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
    place = "standard output"
    try:
        results = figures(loads)
        place = sys.argv[1]
        with open(place, "wb") as picture:
            draw(picture, loads, results)
    except OSError as error:
        sys.stdout = None  # what it holds goes nowhere
        sys.exit(f"arbitration_delay.py: {place}: {error.strerror}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: arbitration_delay.py OUT.svg")
    main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""run.py [--kind gates] [--kind ice40] [--only TEST]: the tests of the RTL, on netlists of it.

Every Verilated model is replaced by what Yosys makes of it (tools/netlist/netlist.sh), in a build
directory of its own, and the tests of tb/protocol, tb/mailbox and of the leaf modules in tb/unit
run unchanged. Then each module of the netlists is proven equal to its RTL in every state, and
recorded pins are played in Icarus Verilog, with X before the reset, to the RTL and to netlists of
the whole core. Writes figures to CAMPAIGN_OUT if that is set. Ends with status 1
if a test fails or an output differs.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import equal
from replay import netlist_of, replay

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position
import gtest_run  # noqa: E402  pylint: disable=wrong-import-position

KINDS = {"gates": "generic gates", "ice40": "iCE40 cells"}
# Minutes on iCE40 cells, and nothing in them that the other tests do not reach.
TOO_LONG = {"ice40": {"can_saturation_test", "rx_fifo_saturation_test"}}
# Unit tests of a block besides the one that has its name.
PARTS = {"can_mb_tx_loss", "can_mb_tx_status"}


def programs():
    """The test programs that are about the RTL."""
    modules = {path.stem for path in ROOT.glob("rtl/**/*.sv")} | PARTS
    leaves = [p for p in ROOT.glob("tb/unit/*_test.cpp") if p.stem.removesuffix("_test") in modules]
    others = [p for folder in ("protocol", "mailbox")
              for p in (ROOT / "tb" / folder).glob("*_test.cpp")]
    return sorted(path.stem for path in leaves + others)


def quiet(log, *command):
    with open(log, "w", encoding="utf-8") as file:
        status = subprocess.run(command, cwd=ROOT, stdout=file, stderr=subprocess.STDOUT,
                                stdin=subprocess.DEVNULL, check=False).returncode
    if status:
        sys.exit(f"netlist: {' '.join(command)} failed, see {log}")


def build(kind, names, jobs, scratch):
    start = time.monotonic()
    quiet(scratch / f"{kind}.configure.log", "cmake", "--preset", kind)
    quiet(scratch / f"{kind}.build.log", "cmake", "--build", f"build/{kind}", "-j", str(jobs),
          "--target", *names)
    return time.monotonic() - start


def run(kind, name, scratch):
    """One program: tests passed, tests failed (a crash counts as one)."""
    log = scratch / f"{kind}.{name}.log"
    passed, bad = gtest_run.run([f"build/{kind}/tb/{name}"], log, ROOT)
    if bad:
        print(f"{KINDS[kind]}: {name}: {bad} failed, see {log}", flush=True)
    return passed, bad


def area(kind):
    """Cells of the whole core around its engine, as Yosys counted them."""
    cells = {}
    for model in ("Vcan_core", "Vcan_host64"):
        stat = (ROOT / f"build/{kind}/sim/{model}.transformed.v.stat").read_text()
        hierarchy = stat[stat.rindex("==="):]
        for name, count in re.findall(r"^ +((?:SB_|\$_)\w+) +(\d+)$", hierarchy, re.MULTILINE):
            cells[name] = cells.get(name, 0) + int(count)
    flops = sum(n for name, n in cells.items() if "DFF" in name)
    return flops, sum(cells.values()) - flops


def proofs(kinds, jobs, scratch):
    """Each module of a netlist of the whole core against its RTL, in every state: figures."""
    figures = []
    for kind in kinds:
        netlist = scratch / f"{kind}64.v"
        netlist_of(kind, "ahb", 64, netlist)
        modules, faults = equal.compare(netlist, 64, scratch / f"equal.{kind}", jobs)
        print(f"{KINDS[kind]}: {modules - len(faults)} of {modules} modules equal to the RTL in "
              "every state", *faults, sep="\n  ", flush=True)
        figures.append({"name": f"modules proven equal to the RTL in every state, {KINDS[kind]}",
                        "value": modules - len(faults),
                        "text": f"{modules - len(faults)} of {modules}", "bar": "all",
                        "ok": not faults and modules > 0})
    return figures


# What is replayed in four states: name, kind of netlist (None: the RTL), device, sizes.
REPLAYS = [("RTL", None, "ahb", [16, 64]), ("RTL, profile small", None, "small", [None]),
           ("RTL with the time unit", None, "time", [None]),
           ("RTL of the node without a processor", None, "remote", [None]),
           ("RTL of the clock without a processor", None, "follower", [None]),
           ("generic gates", "gates", "ahb", [16, 64]), ("iCE40 cells", "ice40", "ahb", [16]),
           ("generic gates with the time unit", "gates", "time", [None]),
           ("generic gates of the node without a processor", "gates", "remote", [None]),
           ("generic gates of the clock without a processor", "gates", "follower", [None])]


def four_states(kinds, jobs, scratch):
    """Recorded pins on the RTL and on netlists: figures and the rows of one table."""
    build = ROOT / "build/release"
    figures, rows = [], []
    for name, kind, device, sizes in REPLAYS:
        if kind and kind not in kinds:
            continue
        bad = clocks = flops = 0
        for size in sizes:
            out, netlist = scratch / f"four_state.{kind}.{device}.{size}.json", None
            if kind:
                netlist = scratch / f"{kind}.{device}.{size}.v"
                netlist_of(kind, device, size, netlist)
            out.unlink(missing_ok=True)
            status, text = replay([], size, build, netlist, out, jobs, device)
            if not out.exists():
                sys.exit(f"netlist: replay on {name} ended with status {status}:\n{text}")
            values = [figure["value"] for figure in json.loads(out.read_text())["figures"]]
            clocks, flops, bad = clocks + values[0], max(flops, values[1]), bad + values[2]
        print(f"four states, {name}: {clocks} clocks, {bad} differences", flush=True)
        figures.append({"name": f"four states, {name}: unknown values after reset and outputs that "
                        "differ", "value": bad, "bar": "0", "ok": bad == 0 and clocks > 0})
        rows.append([name, " and ".join(str(size) for size in sizes if size), f"{clocks:,}",
                     flops or "outputs only"])
    table = {"title": "Recorded pins in Icarus Verilog, all X before the reset",
             "columns": ["core", "buffers", "clocks", "flip-flops watched"], "rows": rows}
    return figures, table


def campaign(kinds, only, jobs, scale, scratch):
    figures, rows = [], []
    for kind in kinds:
        names = [n for n in programs() if n not in TOO_LONG.get(kind, ())]
        names = [n for n in names if only in n][: max(1, round(len(names) * scale))]
        if not names:
            sys.exit(f"netlist: no test program has '{only}' in its name")
        print(f"{KINDS[kind]}: building {len(names)} test programs", flush=True)
        built = build(kind, names, jobs, scratch)
        start = time.monotonic()
        with ThreadPoolExecutor(jobs) as pool:
            counts = list(pool.map(lambda name, kind=kind: run(kind, name, scratch), names))
        passed, failed = (sum(column) for column in zip(*counts))
        print(f"{KINDS[kind]}: {passed} passed, {failed} failed", flush=True)
        figures.append({"name": f"tests passed on the netlist of {KINDS[kind]}", "value": passed,
                        "text": f"{passed} of {passed + failed}", "bar": "all",
                        "ok": failed == 0 and passed > 0})
        flops, others = area(kind)
        rows.append([KINDS[kind], len(names), flops, others, f"{built:.0f} s",
                     f"{time.monotonic() - start:.0f} s"])
    tables = [{"title": "Netlists", "columns": ["netlist", "test programs", "flip-flops",
                                                "other cells", "build", "run"], "rows": rows}]
    figures += proofs(kinds, jobs, scratch)
    more, table = four_states(kinds, jobs, scratch)
    return {"figures": figures + more, "tables": tables + [table], "notes": []}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kind", action="append", choices=KINDS, help="netlist (default: both)")
    parser.add_argument("--only", default="", help="only programs with this in their names")
    arguments = parser.parse_args()
    jobs, scale = campaign_settings.jobs(), campaign_settings.scale()
    out = campaign_settings.result_file()
    scratch = Path(os.environ.get("CAMPAIGN_DIR", ROOT / "build/netlist"))
    scratch.mkdir(parents=True, exist_ok=True)
    result = campaign(arguments.kind or list(KINDS), arguments.only, jobs, scale, scratch)
    sys.exit(campaign_settings.write_result(out, result))


if __name__ == "__main__":
    main()

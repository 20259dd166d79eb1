#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Stage `fuzz` of the campaign: every parser by libFuzzer, and the register interface.

Builds the libFuzzer programs (cmake --preset fuzz, build/fuzz) and runs them two at a time, a
million cases each at scale 1, then fuzz_registers of build/release. The result goes to
CAMPAIGN_OUT. Ends with status 1 if there is a finding or a figure misses its bar.
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

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position
from shards import Shard  # noqa: E402  pylint: disable=wrong-import-position

FULL = 1_000_000
# Longest input, bytes; those that need most time first.
TARGETS = {"board": 160, "wave": 32, "guest": 200, "client": 200, "scenario": 300, "vcd": 400,
           "splitter": 200, "elf": 400, "log": 256, "candump": 256, "gvret": 256, "trc": 256,
           "capture": 200, "gzip": 200, "screen": 200, "pcap": 512, "pcapng": 512, "options": 64,
           "words": 80, "can_frame": 16}
LIMITS = ["-timeout=20", "-rss_limit_mb=600", "-malloc_limit_mb=64", "-print_final_stats=1"]
REGISTER_JOBS = 2


def build(log):
    with open(log, "w", encoding="utf-8") as out:
        for command in (["cmake", "--preset", "fuzz"], ["cmake", "--build", "build/fuzz", "-j2"]):
            if subprocess.run(command, cwd=ROOT, stdout=out, stderr=out, check=False).returncode:
                sys.exit(f"campaign fuzz: {' '.join(command)} failed; see {log}")


def run_parser(name, runs, seed, directory):
    """One libFuzzer program from the kept corpus on; what it finds is kept in `directory`."""
    scratch = directory / f"corpus-{name}"
    scratch.mkdir(parents=True, exist_ok=True)
    corpus = ROOT / "tb/fuzz/corpus" / name
    words = ROOT / "tb/fuzz/dict" / f"{name}.dict"
    command = [ROOT / "build/fuzz/tb/fuzz" / f"fuzz_{name}", f"-runs={runs}", f"-seed={seed}",
               f"-max_len={TARGETS[name]}", *LIMITS, f"-artifact_prefix={directory}/{name}-"]
    command += [f"-dict={words}"] if words.exists() else []
    start = time.monotonic()
    environment = dict(os.environ, ASAN_OPTIONS="quarantine_size_mb=16")
    log = directory / f"{name}.log"
    with open(log, "w", encoding="utf-8") as out:
        code = subprocess.run([*map(str, command), str(scratch), str(corpus)], stdout=out,
                              stderr=out, env=environment, check=False).returncode
    text = log.read_text(errors="replace")
    covered = re.findall(r"cov: (\d+) ft: (\d+) corp: (\d+)", text)[-1:] or [("0", "0", "0")]
    cases = re.search(r"number_of_executed_units:\s*(\d+)", text)
    result = {"name": name, "cases": int(cases.group(1)) if cases else 0,
              "seconds": time.monotonic() - start, "edges": int(covered[0][0]),
              "features": int(covered[0][1]), "corpus": len(list(corpus.iterdir())),
              "findings": 0 if code == 0 else 1}
    print(f"{name}: {result['cases']} cases, {result['seconds']:.0f} s, "
          f"{result['edges']} edges" + (f"; FINDING, see {log}" if code else ""), flush=True)
    return result


def run_registers(number, cases, seed, directory):
    out = directory / f"registers-{number}.json"
    out.unlink(missing_ok=True)  # of a run before
    log = directory / f"registers-{number}.log"
    command = [ROOT / "build/release/tb/fuzz/fuzz_registers", "--cases", cases, "--seed",
               seed * 1000 + number, "--out", out, "--keep", directory]
    with open(log, "w", encoding="utf-8") as stream:
        code = subprocess.run(list(map(str, command)), stdout=stream, stderr=stream,
                              check=False).returncode
    if not out.exists():
        sys.exit(f"campaign fuzz: fuzz_registers ended with {code}; see {log}")
    result = json.loads(out.read_text())
    print(f"registers {number}: {result['cases']} cases, {result['seconds']:.0f} s"
          + (f"; FINDING, see {log}" if code else ""), flush=True)
    return result


def add_up(parts):
    """The sum of numbers, key by key; the largest of what is a maximum."""
    total = {}
    for part in parts:
        for key, value in part.items():
            if isinstance(value, dict):
                total[key] = add_up([total.get(key, {}), value])
            elif key in ("max_waits", "longest_acknowledge"):
                total[key] = max(total.get(key, 0), value)
            else:
                total[key] = total.get(key, 0) + value
    return total


def figure(name, value, bar=None, ok=None, text=None):
    result = {"name": name, "value": value, "bar": bar, "ok": ok}
    return result | ({"text": text} if text else {})


def summary(parsers, registers, wanted):
    """The stage's figures and tables."""
    findings = sum(p["findings"] for p in parsers)
    fewest = min(p["cases"] for p in parsers)
    transfers = sum(mode["transfers"] for mode in registers["modes"].values())
    figures = [
        figure("parsers fuzzed", len(parsers)),
        figure("cases of the parser with fewest", fewest, f"{wanted:,}", fewest >= wanted),
        figure("findings in parsers", findings, "0", findings == 0),
        figure("register cases", registers["cases"], f"{wanted:,}", registers["cases"] >= wanted),
        figure("register transfers", transfers),
        figure("register cases that broke a rule or hung", registers["failed"], "0",
               registers["failed"] == 0),
        figure("most wait states of a transfer", registers["max_waits"], "1",
               registers["max_waits"] <= 1),
        figure("longest acknowledge, clocks at 8 a bit", registers["longest_acknowledge"]),
    ]
    rows = [[p["name"], p["cases"], round(p["seconds"]), p["edges"], p["features"], p["corpus"],
             p["findings"]] for p in sorted(parsers, key=lambda p: p["name"])]
    modes = [[name, mode["cases"], mode["transfers"]] for name, mode in registers["modes"].items()]
    tables = [
        {"title": "Parsers", "rows": rows,
         "columns": ["target", "cases", "s", "edges", "features", "kept inputs", "findings"]},
        {"title": "Register interface: mode of the core when the case began", "rows": modes,
         "columns": ["mode", "cases", "transfers"]}]
    notes = [f"Register interface: {registers['episodes']} episodes of 16 cases, each ended by a "
             f"recovery that sends and receives a frame; {registers['clocks']} clocks, "
             f"{registers['bus_frames']} frames on the bus, {registers['excused_errors']} error "
             "frames that the core or the bench may cause.",
             "A case: an input of libFuzzer; 8 to 64 AHB transfers under traffic."]
    return {"figures": figures, "tables": tables, "notes": notes}


def run_all(units, seed, wanted, directory, jobs):
    """What became of each unit, [name or number of the registers' job, result]."""
    def one(unit):
        if isinstance(unit, int):
            return unit, run_registers(unit, -(-wanted // REGISTER_JOBS), seed, directory)
        return unit, run_parser(unit, wanted, seed, directory)
    with ThreadPoolExecutor(jobs) as pool:
        return [job.result() for job in [pool.submit(one, unit) for unit in units]]


def parsers_asked_for():
    """What --only names; empty: all, and the registers."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", default=[], metavar="PARSER",
                        help="these parsers alone, without the registers")
    only = parser.parse_args().only
    for name in only:
        if name not in TARGETS:
            parser.error(f"no parser '{name}'; there are {', '.join(sorted(TARGETS))}")
    return only


def main():
    only = parsers_asked_for()
    scale, seed = campaign_settings.scale(), campaign_settings.seed()
    jobs, out = campaign_settings.jobs(), campaign_settings.result_file()
    directory = Path(os.environ.get("CAMPAIGN_DIR", ROOT / "build/fuzz/campaign")).resolve()
    directory.mkdir(parents=True, exist_ok=True)
    wanted = max(1, round(FULL * scale))
    shard = Shard()
    if shard.kind in ("whole", "prepare"):
        build(directory / "build.log")
    if shard.kind == "prepare":
        return 0
    names = [name for name in TARGETS if not only or name in only]
    units = names + ([] if only else list(range(REGISTER_JOBS)))
    if shard.kind == "merge":
        results = [result for part in shard.read(directory) for result in part]
    else:
        results = run_all(shard.mine(units), seed, wanted, directory, jobs)
    if shard.kind == "part":
        shard.write(directory, results)
        return 0
    parsers = [result for unit, result in results if not isinstance(unit, int)]
    register_parts = [result for unit, result in results if isinstance(unit, int)]
    if only:
        return int(any(p["findings"] for p in parsers))
    result = summary(parsers, add_up(register_parts), wanted)
    for entry in result["figures"]:
        print(f"{entry['name']}: {entry['value']}")
    return campaign_settings.write_result(out, result)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""campaign.py [--only STAGE,...] [--page]: the verification campaign of tb/campaign.yaml.

Builds and runs every stage, keeps its result in build/campaign/STAGE.json and its output in
STAGE.log, prints all figures, and writes those of a whole run (SCALE=1) to
docs/campaign/STAGE.md, with a line in docs/verification.md between <!-- campaign STAGE --> and
<!-- end STAGE -->. --page only writes the pages, from the results that are there. Ends with
status 1 if a stage failed or a figure misses its bar.

Environment: SEED (1), SCALE (1: everything; 0.01: a hundredth of it), JOBS (2),
RESUME (0; 1: lockstep and mutation go on where the same programs were interrupted).
"""
import argparse
import datetime
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent
PLAN = ROOT / "tb/campaign.yaml"
OUT = ROOT / "build/campaign"
PAGE = ROOT / "docs/verification.md"
STAGE_PAGES = ROOT / "docs/campaign"


def fail(text):
    sys.exit(f"campaign: {text}")


def output(*command):
    """What a command prints, first line only; "" if there is no such command."""
    try:
        text = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT).stdout
    except OSError:
        return ""
    return text.strip().splitlines()[0] if text.strip() else ""


def number(name, convert, default, allowed, text):
    """An environment variable as a number, or an end with a clear message."""
    value = os.environ.get(name) or default
    try:
        result = convert(value)
    except ValueError:
        result = None
    if result is None or not allowed(result):
        fail(f"{name} is '{value}'; allowed: {text}")
    return result


def settings():
    return {"seed": number("SEED", int, "1", lambda v: 0 <= v < 2**31, "0 to 2147483647"),
            "scale": number("SCALE", float, "1", lambda v: 0 < v <= 1, "above 0 up to 1"),
            "jobs": number("JOBS", int, "2", lambda v: 1 <= v <= 256, "1 to 256"),
            "resume": number("RESUME", int, "0", lambda v: v in (0, 1), "0 and 1")}


def versions():
    """The tools that results may depend on."""
    found = {
        "Verilator": output("verilator", "--version").removeprefix("Verilator "),
        "Yosys": output("yosys", "-V").removeprefix("Yosys ").split(" (")[0],
        "Icarus Verilog": output("iverilog", "-V").removeprefix("Icarus Verilog version ")
                          .split(" ")[0],
        "Z3": output("z3", "--version").removeprefix("Z3 version ").split(" - ")[0],
        "Boolector": output("boolector", "--version"),
        "g++": output("g++", "-dumpfullversion"),
        "clang": output("clang", "-dumpversion"),
    }
    return {name: text for name, text in found.items() if text}


def quiet(log, *command):
    """Runs a command into a log; its end is shown if it fails."""
    with open(log, "a", encoding="utf-8") as file:
        status = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=file,
                                stderr=subprocess.STDOUT, check=False).returncode
    if status:
        print("\n".join(Path(log).read_text(errors="replace").splitlines()[-15:]))
        print(f"campaign: {' '.join(map(str, command))} failed, see {log}")
    return status == 0


def build(stage, jobs):
    preset = stage.get("preset", "release")
    log = OUT / f"{stage['name']}.build.log"
    log.unlink(missing_ok=True)
    if not quiet(log, "cmake", "--preset", preset):
        return False
    targets = stage.get("targets") or []
    return not targets or quiet(log, "cmake", "--build", f"build/{preset}", "-j", str(jobs),
                                "--target", *targets)


def run_command(stage, options, out):
    """Runs the stage's command; its output goes to the terminal and to its log."""
    scratch = OUT / stage["name"]
    scratch.mkdir(parents=True, exist_ok=True)
    environment = dict(os.environ, CAMPAIGN_OUT=str(out), CAMPAIGN_DIR=str(scratch),
                       CAMPAIGN_SEED=str(options["seed"]), CAMPAIGN_SCALE=str(options["scale"]),
                       CAMPAIGN_JOBS=str(options["jobs"]),
                       CAMPAIGN_RESUME=str(options["resume"]))
    with open(OUT / f"{stage['name']}.log", "w", encoding="utf-8") as log:
        process = subprocess.Popen(["bash", "-c", stage["command"]], cwd=ROOT, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, errors="replace")
        for line in process.stdout:
            log.write(line)
            log.flush()
            print("  " + line, end="", flush=True)
        return process.wait()


def check_result(result, where):
    for figure in result.get("figures", []):
        missing = {"name", "value", "bar", "ok"} - set(figure)
        if missing:
            fail(f"{where}: figure {figure.get('name')} lacks {', '.join(sorted(missing))}")
    if not result.get("figures"):
        fail(f"{where}: no figures")


def run_stage(stage, options, about):
    """One stage; its result, or None if it could not be obtained."""
    print(f"\n== {stage['name']}: {stage['title']}", flush=True)
    if not build(stage, options["jobs"]):
        return None
    out = OUT / f"{stage['name']}.json"
    out.unlink(missing_ok=True)
    start = time.monotonic()
    status = run_command(stage, options, out)
    if not out.exists():
        print(f"campaign: {stage['name']} ended with status {status} and left no result")
        return None
    result = json.loads(out.read_text())
    check_result(result, out)
    result |= about | options | {"stage": stage["name"], "status": status,
                                 "seconds": round(time.monotonic() - start),
                                 "command": stage["command"]}
    out.write_text(json.dumps(result, indent=1) + "\n")
    print(f"{stage['name']}: {duration(result['seconds'])}", flush=True)
    return result


def duration(seconds):
    return f"{seconds // 60} min {seconds % 60} s" if seconds >= 60 else f"{seconds} s"


def grouped(cell):
    """A cell of a table; whole numbers with commas, bars escaped."""
    text = str(cell).replace("|", "\\|")
    return f"{int(text):,}" if re.fullmatch("[1-9][0-9]{3,}", text) else text


def shown(figure):
    if figure.get("text"):
        return figure["text"]
    value = figure["value"]
    return f"{value:,.0f}" if value == int(value) else f"{value:,.2f}"


def verdict(figure):
    return {True: "met", False: "MISSED", None: ""}[figure["ok"]]


def rows(figures):
    lines = ["| figure | value | bar | |", "|---|---|---|---|"]
    lines += [f"| {f['name']} | {shown(f)} | {f['bar'] or ''} | {verdict(f)} |" for f in figures]
    return lines


def table(content):
    lines = ["", f"**{content['title']}**", "", "| " + " | ".join(content["columns"]) + " |",
             "|" + "---|" * len(content["columns"])]
    lines += ["| " + " | ".join(grouped(cell) for cell in row) + " |" for row in content["rows"]]
    return lines


def origin(result):
    """How to repeat a stage's result, and of what it is one."""
    return (f"`make campaign STAGES={result['stage']} SEED={result['seed']}`, commit "
            f"{result['commit']}, {result['date']}, {duration(result['seconds'])} on "
            f"{result['cpus']} cores.")


def stage_page(stage, result):
    """A page of its own: all figures and tables of a stage."""
    lines = [f"# Campaign: {stage['title']}", "",
             "Written by `make campaign`. What it means: "
             "[verification report](../verification.md).", "", origin(result), ""]
    lines += rows(result["figures"])
    for content in result.get("tables", []):
        lines += table(content)
    notes = result.get("notes", [])
    if notes:
        lines += [""] + [f"- {note}" for note in notes]
    return "\n".join(lines) + "\n"


def summary(stage, result):
    """The stage's line in the table at the head of the page."""
    figures = {figure["name"]: shown(figure).split(" (")[0] for figure in result["figures"]}

    def value(match):
        if match[1] not in figures and result.get("scale", 1) < 1:
            return "none"  # a part may leave out all that a figure counts
        if match[1] not in figures:
            fail(f"{PLAN}: stage {stage['name']} has no figure '{match[1]}'; figures: "
                 + ", ".join(figures))
        return figures[match[1]]
    return re.sub("{(.*?)}", value, stage["summary"])


def replace(text, begin, end, content):
    """The page with what stands between the two marks replaced."""
    text, count = re.subn(re.escape(begin) + ".*?" + re.escape(end),
                          lambda _: begin + content + end, text, flags=re.DOTALL)
    if count != 1:
        fail(f"{PAGE}: {count} places {begin} ... {end}, not one")
    return text


def write_page(stages):
    text = PAGE.read_text()
    STAGE_PAGES.mkdir(exist_ok=True)
    for stage in stages:
        path = OUT / f"{stage['name']}.json"
        if not path.exists():
            continue
        result = json.loads(path.read_text())
        if result.get("scale") != 1:
            continue
        name = stage["name"]
        (STAGE_PAGES / f"{name}.md").write_text(stage_page(stage, result))
        text = replace(text, f"<!-- campaign {name} -->", f"<!-- end {name} -->",
                       f"\n[Figures and tables](campaign/{name}.md): {origin(result)}\n")
        text = replace(text, f"<!-- summary {name} -->", "<!-- end -->", summary(stage, result))
        tools = ", ".join(f"{name} {version}" for name, version in result["versions"].items())
        text = replace(text, "<!-- tools -->", "<!-- end tools -->", f"\n{tools}.\n")
    PAGE.write_text(text)


def report(stages, results):
    """Prints all figures; whether every stage ran and every bar is met."""
    good = True
    print("\n== Figures")
    for stage in stages:
        result = results[stage["name"]]
        if result is None:
            print(f"{stage['name']:<10} FAILED")
            good = False
            continue
        for figure in result["figures"]:
            met = verdict(figure) or "not for a part of the campaign"
            bar = f"  (bar: {figure['bar']}: {met})" if figure["bar"] else ""
            print(f"{stage['name']:<10} {figure['name']}: {shown(figure)}{bar}")
        good &= result["status"] == 0 and all(f["ok"] is not False for f in result["figures"])
    print("\n== In short")
    for stage in stages:
        result = results[stage["name"]]
        print(f"{stage['name']:<10} {summary(stage, result) if result else 'FAILED'}")
    return good


def main():
    parser = argparse.ArgumentParser(description="The verification campaign.")
    parser.add_argument("--only", default="", help="stages, with commas between")
    parser.add_argument("--page", action="store_true", help="only write the pages in docs")
    arguments = parser.parse_args()
    stages = yaml.safe_load(PLAN.read_text())["stages"]
    names = [stage["name"] for stage in stages]
    wanted = [name for name in re.split(r"[,\s]+", arguments.only) if name]
    for name in wanted:
        if name not in names:
            fail(f"there is no stage '{name}'; stages: {', '.join(names)}")
    chosen = [stage for stage in stages if not wanted or stage["name"] in wanted]
    if arguments.page:
        write_page(chosen)
        return
    options = settings()
    OUT.mkdir(parents=True, exist_ok=True)
    about = {"commit": output("git", "rev-parse", "--short", "HEAD")
             + ("+" if output("git", "status", "--porcelain") else ""),
             "date": datetime.date.today().isoformat(), "cpus": os.cpu_count(),
             "versions": versions()}
    start = time.monotonic()
    results = {stage["name"]: run_stage(stage, options, about) for stage in chosen}
    good = report(chosen, results)
    write_page(chosen)
    print(f"\ncampaign: {len(chosen)} of {len(stages)} stages, seed {options['seed']}, scale "
          f"{options['scale']:g}, {duration(round(time.monotonic() - start))}: "
          + ("every bar met" if good else "NOT every bar met")
          + (", of those that a part can meet" if options["scale"] < 1 else ""))
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()

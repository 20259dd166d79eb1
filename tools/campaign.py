#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""campaign.py [--only STAGE,...] [--page] [--slurm]: the verification campaign of tb/campaign.yaml.

Builds and runs every stage, keeps its result in build/campaign/STAGE.json and its output in
STAGE.log, prints all figures, and writes those of a whole run (SCALE=1) to
docs/campaign/STAGE.md, and in short to docs/verification.md, between <!-- summary STAGE --> and
<!-- end -->. --page only writes the pages, from the results that are there. --slurm
runs the stages as jobs of a Slurm cluster (slurm_campaign.py, docs/cluster.md). Ends with status 1
if a stage failed or a figure misses its bar.

Environment: SEED (1), SCALE (1: everything; 0.01: a hundredth of it), JOBS (2),
RESUME (0; 1: lockstep and mutation go on where the same programs were interrupted; with --slurm
every shard that is there counts). With --slurm: SHARDS (100: at most so many of a stage), RETRIES
(2: how often a failed shard is queued again), SBATCH (options for sbatch).
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

import slurm_campaign

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "tb"))
from campaign_settings import JOBS  # noqa: E402  pylint: disable=wrong-import-position

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
            "jobs": number("JOBS", int, "2", lambda v: v in JOBS, str(JOBS)),
            "resume": number("RESUME", int, "0", lambda v: v in (0, 1), "0 and 1"),
            "shards": number("SHARDS", int, "100", lambda v: 1 <= v <= 1000, "1 to 1000"),
            "retries": number("RETRIES", int, "2", lambda v: 0 <= v <= 9, "0 to 9")}


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
    """Configures and builds what a stage needs; one without targets in the plan needs nothing."""
    if "targets" not in stage:
        return True
    preset = stage.get("preset", "release")
    log = OUT / f"{stage['name']}.build.log"
    log.unlink(missing_ok=True)
    if not quiet(log, "cmake", "--preset", preset):
        return False
    targets = stage.get("targets") or []
    return not targets or quiet(log, "cmake", "--build", f"build/{preset}", "-j", str(jobs),
                                "--target", *targets)


def run_command(stage, options, out, more=None, key="command"):
    """Runs the stage's command, or that under another key of its; the output goes to the terminal
    and to a log. more: variables of the environment beside those of every stage."""
    scratch = OUT / stage["name"]
    scratch.mkdir(parents=True, exist_ok=True)
    environment = dict(os.environ, CAMPAIGN_OUT=str(out), CAMPAIGN_DIR=str(scratch),
                       CAMPAIGN_SEED=str(options["seed"]), CAMPAIGN_SCALE=str(options["scale"]),
                       CAMPAIGN_JOBS=str(options["jobs"]),
                       CAMPAIGN_RESUME=str(options["resume"]))
    environment.update(more or {})
    log_file = OUT / f"{stage['name']}.log" if more is None else os.devnull  # jobs have their own
    with open(log_file, "w", encoding="utf-8") as log:
        process = subprocess.Popen(["bash", "-c", stage[key]], cwd=ROOT, env=environment,
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


def completed(stage, path, about):
    """What a stage has written, with what is known of the run."""
    result = json.loads(path.read_text())
    check_result(result, path)
    return result | about | {"stage": stage["name"], "command": stage["command"]}


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
    result = completed(stage, out, options | about | {
        "status": status, "seconds": round(time.monotonic() - start)})
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
    where = (f"in {result['pieces']} shards of a Slurm cluster, {duration(result['spent'])} of "
             "CPU time" if "pieces" in result else f"on {result['cpus']} cores")
    return (f"`make campaign STAGES={result['stage']} SEED={result['seed']}`, commit "
            f"{result['commit']}, {result['date']}, {duration(result['seconds'])} {where}.")


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
    """Writes the pages of the stages that ran whole; returns their names."""
    text = PAGE.read_text()
    STAGE_PAGES.mkdir(exist_ok=True)
    written = []
    for stage in stages:
        path = OUT / f"{stage['name']}.json"
        if not path.exists():
            continue
        result = json.loads(path.read_text())
        if result.get("scale") != 1:
            continue
        name = stage["name"]
        written.append(name)
        (STAGE_PAGES / f"{name}.md").write_text(stage_page(stage, result))
        run = f"[{result['commit']}, {result['date']}](campaign/{name}.md)"
        text = replace(text, f"<!-- summary {name} -->", "<!-- end -->",
                       f"{summary(stage, result)}; {run}")
        tools = ", ".join(f"{name} {version}" for name, version in result["versions"].items())
        text = replace(text, "<!-- tools -->", "<!-- end tools -->", f"\n{tools}.\n")
    if written:
        PAGE.write_text(text)
    return written


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


def about_this():
    """What a result says of the run besides its figures."""
    return {"commit": output("git", "rev-parse", "--short", "HEAD")
            + ("+" if output("git", "status", "--porcelain") else ""),
            "date": datetime.date.today().isoformat(), "cpus": os.cpu_count(),
            "versions": versions()}


def step(arguments, stage):
    """What one job of the cluster does; returns its exit code."""
    cluster = slurm_campaign.Cluster(OUT)
    plan = cluster.plan
    options = settings() | {name: plan[name] for name in ("seed", "scale")}
    options["jobs"] = int(os.environ.get("SLURM_CPUS_PER_TASK", "1"))
    name = stage["name"]
    out = OUT / f"{name}.new"

    def run(more, key="command"):
        return run_command(stage, options, out, more, key)

    if arguments.step == "build":
        return slurm_campaign.step_build(cluster, stage, build(stage, options["jobs"]))
    if arguments.step == "prepare":
        count = plan["stages"][name]["shards"]
        return slurm_campaign.step_build(
            cluster, stage, run({"CAMPAIGN_SHARD": f"prepare/{count}"}, "prepare") == 0)
    if arguments.step == "shard":
        return slurm_campaign.step_shard(cluster, stage, run)
    out.unlink(missing_ok=True)
    status, markers = slurm_campaign.step_merge(cluster, stage, run, arguments.again)
    if status is None:
        return 0
    if not out.exists():
        cluster.give_up(name, f"the merge ended with status {status} and left no result")
        return 1
    spent = [marker["cpu"] for marker in markers.values()]
    result = completed(stage, out, options | about_this() | {
        "status": status, "pieces": len(markers), "spent": round(sum(spent)),
        "seconds": round(time.time() - plan["began"])})
    out.write_text(json.dumps(result, indent=1) + "\n")
    out.replace(OUT / f"{name}.json")
    return 0


def on_cluster(arguments, chosen, options):
    """Runs the stages as jobs; their results, None where there is none."""
    plan = slurm_campaign.make_plan(chosen, options, ROOT, Path(__file__).resolve(),
                                    arguments.plan.resolve())
    cluster = slurm_campaign.Cluster(OUT, plan)
    slurm_campaign.start(cluster, options["resume"])
    slurm_campaign.wait(cluster)
    results = {}
    for stage in chosen:
        path = OUT / f"{stage['name']}.json"
        results[stage["name"]] = json.loads(path.read_text()) if path.exists() else None
    return results


def here(chosen, options):
    """Runs the stages on this machine, one after the other."""
    about = about_this()
    return {stage["name"]: run_stage(stage, options, about) for stage in chosen}


def arguments_of():
    """The command line."""
    parser = argparse.ArgumentParser(description="The verification campaign.")
    parser.add_argument("--only", default="", help="stages, with commas between")
    parser.add_argument("--page", action="store_true", help="only write the pages in docs")
    parser.add_argument("--slurm", action="store_true", help="as jobs of a Slurm cluster")
    parser.add_argument("--plan", type=Path, default=PLAN, help="file of the stages")
    parser.add_argument("--out", type=Path, default=OUT, help="directory of the results")
    parser.add_argument("--step", choices=("build", "prepare", "shard", "merge"),
                        help=argparse.SUPPRESS)
    parser.add_argument("--again", type=int, default=0, help=argparse.SUPPRESS)
    return parser.parse_args()


def stages_of(path):
    """The stages that a plan names."""
    try:
        plan = yaml.safe_load(path.read_text(encoding="utf-8"))
        stages = plan["stages"]
        missing = [key for stage in stages for key in ("name", "title", "command", "summary")
                   if key not in stage]
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        fail(f"--plan {path}: {getattr(error, 'strerror', None) or ' '.join(str(error).split())}")
    except (KeyError, TypeError):
        fail(f"--plan {path}: no list of stages")
    if missing or not stages:
        fail(f"--plan {path}: " + (f"a stage without {missing[0]}" if missing else "no stages"))
    return stages


def main():
    global OUT  # pylint: disable=global-statement
    arguments = arguments_of()
    OUT = arguments.out.resolve()
    stages = stages_of(arguments.plan)
    names = [stage["name"] for stage in stages]
    wanted = [name for name in re.split(r"[,\s]+", arguments.only) if name]
    for name in wanted:
        if name not in names:
            fail(f"there is no stage '{name}'; stages: {', '.join(names)}")
    if arguments.only and not wanted:
        fail(f"--only '{arguments.only}' names no stage; stages: {', '.join(names)}")
    chosen = [stage for stage in stages if not wanted or stage["name"] in wanted]
    if arguments.step:
        sys.exit(step(arguments, chosen[0]))
    if arguments.page:
        written = write_page(chosen)
        if not written:
            fail(f"{OUT} has no result of a whole run (SCALE=1) of a stage that is asked for")
        print(f"Written: {PAGE.relative_to(ROOT)}: {', '.join(written)}")
        return
    options = settings()
    try:
        OUT.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"--out {OUT}: {error.strerror}")
    start = time.monotonic()
    try:
        results = (on_cluster(arguments, chosen, options) if arguments.slurm
                   else here(chosen, options))
    except slurm_campaign.SlurmError as error:
        fail(error)
    good = report(chosen, results)
    if arguments.plan == PLAN:
        write_page(chosen)
    print(f"\ncampaign: {len(chosen)} of {len(stages)} stages, seed {options['seed']}, scale "
          f"{options['scale']:g}, {duration(round(time.monotonic() - start))}: "
          + ("every bar met" if good else "NOT every bar met")
          + (", of those that a part can meet" if options["scale"] < 1 else ""))
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()

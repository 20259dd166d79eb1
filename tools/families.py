#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""families.py FAMILY...|all [--builds BUILD ...] [--check] [--modules DIR]: area in FPGA families
by Yosys as an npm package (tools/synth/families), pinned by its lock file. Builds: core (can_core
alone), and the profiles small, standard, full of can_ahb.

Keeps what it measured in tools/synth/families/results.json and writes docs/synthesis-families.md.
--check: measures nothing; says which of the families named, or of all, were measured on another
state of RTL or tool.
"""
import argparse
import functools
import hashlib
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

# ruff: noqa: E402  (the path must be set first)
from pack.wrappers import ROOT, rtl_files
from plain_end import run
from synth.families_page import render

FOLDER = ROOT / "tools/synth/families"
RESULTS = FOLDER / "results.json"
PAGE = ROOT / "docs/synthesis-families.md"
BUILDS = ("core", "small", "standard", "full")
# What abc9 says where it stops (docs/errata.md, E-07).
STOPPED = "Boxes are not in a topological order"


def families():
    """name -> entry of families.yaml."""
    return yaml.safe_load((FOLDER / "families.yaml").read_text(encoding="utf-8"))


def code(text):
    """A file of RTL without comments and what white space they leave."""
    return re.sub(r"\s+", " ", re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)).strip()


@functools.cache
def modules():
    """name of module -> its code, of all files of RTL."""
    return {Path(name).stem: code((ROOT / name).read_text(encoding="utf-8"))
            for name in rtl_files()}


def used(tops, files):
    """Those of the files, name of module -> code, that the tops name, or what they name."""
    wanted, found = set(tops), set()
    while wanted:
        name = wanted.pop()
        found.add(name)
        wanted |= set(re.findall(r"\b[a-z]\w*\b", files[name])) & set(files) - found
    return sorted(found)


@functools.cache
def measured():
    """The code of what is measured, module by module."""
    files = modules()
    return [files[name] for name in used({settings(build)[0] for build in BUILDS}, files)]


def state(entry):
    """A hash of what a family's figures depend on: RTL, tool, settings, profiles."""
    digest = hashlib.sha256(json.dumps(entry, sort_keys=True).encode())
    for text in measured():
        digest.update(text.encode())
    for name in ("sw/profiles.yaml", "tools/synth/families/package-lock.json"):
        digest.update((ROOT / name).read_bytes())
    return digest.hexdigest()[:12]


def packages(given):
    """The folder node_modules, installed by npm from the lock file if need be."""
    if given:
        return Path(given)
    folder = ROOT / "build/families"
    if not (folder / "node_modules/@yowasp/yosys").is_dir():
        folder.mkdir(parents=True, exist_ok=True)
        for name in ("package.json", "package-lock.json", ".npmrc"):
            shutil.copy(FOLDER / name, folder)
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-progress",
                               "--loglevel=error"], cwd=folder, check=False)
        if done.returncode != 0:
            sys.exit("families.py: npm ci failed (packages nodejs and npm, a network)")
    return folder / "node_modules"


@functools.cache
def settings(build):
    """Top and parameters of a build."""
    if build == "core":
        return "can_core", []
    text = subprocess.run([sys.executable, ROOT / "tools/profiles.py", build], check=True,
                          capture_output=True, text=True).stdout
    return "can_ahb", [word.split("=") for word in text.split()]


def script(entry, build, option=""):
    """The Yosys script of a build."""
    top, parameters = settings(build)
    names = " ".join(Path(name).name for name in rtl_files())
    chparam = " ".join(f"-chparam {name} {value}" for name, value in parameters)
    apart = "blackbox *can_mb_ram*; " if entry.get("ram_apart") else ""
    return (f"read_verilog -sv {names}; hierarchy -check -top {top} {chparam}; {apart}"
            f"{entry['command']} {option} -top {top}; tee -o out/stat.json stat -json\n"
            ).replace("; ", "\n")


def synthesise(script_text, modules, out):
    """Runs Yosys; returns what it said if it failed."""
    done = subprocess.run(
        ["node", FOLDER / "run.mjs", modules, out, script_text,
         *(ROOT / name for name in rtl_files())], text=True, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.stdout or "no word of it" if done.returncode != 0 else ""


def measure(entry, build, modules, option=""):
    """Cells of a build: kind -> number; plain_abc: abc9 has stopped."""
    with tempfile.TemporaryDirectory() as out:
        complaint = synthesise(script(entry, build, option), modules, out)
        plain = STOPPED in complaint and "plain_abc" in entry
        if plain:
            complaint = synthesise(script(entry, build, f"{option} {entry['plain_abc']}"), modules,
                                   out)
        if complaint:
            sys.exit(f"families.py: {entry['title']}, {build}: {complaint}")
        cells = json.loads((Path(out) / "stat.json").read_text(encoding="utf-8"))
    kinds = cells["design"]["num_cells_by_type"]
    found = {kind: sum(number for name, number in kinds.items()
                       if re.fullmatch(entry[kind], name.lstrip("\\")))
             for kind in ("lut", "ff", "ram", "lut_ram") if kind in entry}
    return {**found, "plain_abc": True} if plain else found


def load():
    """What was measured: family -> {state, builds}."""
    return json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}


def stale(known, results):
    """Families whose figures are of another state, or not all there."""
    return [name for name, entry in known.items()
            if results.get(name, {}).get("state") != state(entry)
            or set(results[name]["builds"]) != set(BUILDS)]


def measure_family(name, entry, builds, modules, results):
    """Adds a family's figures; those of another state go."""
    now = state(entry)
    if results.get(name, {}).get("state") != now:
        results[name] = {"state": now, "builds": {}}
    for build in builds:
        found = measure(entry, build, modules)
        if found.get("lut_ram") and "no_lut_ram" in entry:
            found["without_lut_ram"] = measure(entry, build, modules, entry["no_lut_ram"])
        results[name]["builds"][build] = found
        print(f"{name} {build}: {found}", flush=True)
        RESULTS.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("family", nargs="*")
    parser.add_argument("--builds", nargs="+", choices=BUILDS, default=BUILDS)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--modules", help="node_modules that has the package")
    arguments = parser.parse_args()
    known, results = families(), load()
    wanted = list(known) if arguments.family == ["all"] else arguments.family
    for name in wanted:
        if name == "all":
            sys.exit("families.py: either all families, or names of some, not both")
        if name not in known:
            sys.exit(f"families.py: no family {name}; there are all, {', '.join(known)}")
    if arguments.check:
        if PAGE.read_text(encoding="utf-8") != render(known, results):
            sys.exit("docs/synthesis-families.md is not what results.json says: make synth FAMILY=")
        old = stale({name: known[name] for name in wanted or known}, results)
        if old:
            sys.exit("docs/synthesis-families.md is of another RTL or tool, or not whole: "
                     + ", ".join(old) + "; make synth FAMILY=all")
        return
    if wanted:
        modules = packages(arguments.modules)
        for build in arguments.builds:
            for name in wanted:
                measure_family(name, known[name], [build], modules, results)
    PAGE.write_text(render(known, results), encoding="utf-8")
    print(f"Written: {PAGE.relative_to(ROOT)}")


if __name__ == "__main__":
    run(main)

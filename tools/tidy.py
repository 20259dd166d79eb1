#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# tidy.py BUILD [--sample]: clang-tidy on every source of ours that the build compiles, two at a
# time. A file is looked at again only if it, a header of ours that it includes or the settings
# changed since it was found clean. --sample, for machines that start from nothing each time: only
# the sources of the last commits, and one in sixteen of the others, which ones by the commit.
import argparse
import concurrent.futures
import hashlib
import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
JOBS = 2
RECENT = 12   # commits whose sources are in every sample
PART = 16      # one in so many of the other sources
# By the compiler, for itself alone: as g++ is told of it, and clang++.
PRECOMPILED = re.compile(r"( -Xclang -include-pch -Xclang \S*\.pch -Xclang -include -Xclang"
                         r"| -include) \S*/cmake_pch\.hxx")
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
TOGETHER = re.compile(r"/Unity/unity_\w+\.cxx$")  # what verican_unity() compiles in one
FOR_GCC = re.compile(r" -Wno-subobject-linkage\b")
FINDING = re.compile(r": (error|warning):")


def output_of(*command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def our_files(*patterns):
    """Paths from the root, new files included, ignored ones left out."""
    names = output_of("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--",
                      *patterns).split("\0")
    return [name for name in names if name and (ROOT / name).is_file()]


class Includes:
    """Which headers of ours a source reads. A name in quotes is every header whose path ends so:
    one too many is one look too many, and none is missed."""

    def __init__(self):
        self.by_end = defaultdict(list)
        for name in our_files("*.hpp", "*.h"):
            parts = name.split("/")
            for n in range(len(parts)):
                self.by_end["/".join(parts[n:])].append(name)
        self.known = {}

    def direct(self, name):
        if name not in self.known:
            found = INCLUDE.findall((ROOT / name).read_bytes())
            self.known[name] = {header for include in found for header in self.by_end.get(
                include.decode().replace("../", ""), ())}
        return self.known[name]

    def all(self, name):
        seen, todo = set(), [name]
        while todo:
            new = self.direct(todo.pop()) - seen
            seen |= new
            todo += new
        return sorted(seen)


def key_of(name, includes, settings):
    digest = hashlib.sha256(settings)
    for path in (name, *includes.all(name)):
        digest.update(path.encode() + b"\0" + (ROOT / path).read_bytes())
    return digest.hexdigest()[:32]


def recent_sources():
    """Those of the last commits; none where the history is cut off."""
    if output_of("git", "rev-parse", "--is-shallow-repository").strip() == "true":
        return set()
    return set(output_of("git", "log", f"-{RECENT}", "--name-only", "--format=").split("\n"))


def sample_of(names):
    recent = recent_sources()
    turn = int(output_of("git", "rev-parse", "HEAD").strip(), 16) % PART

    def due(name):
        return int(hashlib.sha256(name.encode()).hexdigest(), 16) % PART == turn
    return [name for name in names if name in recent or due(name)]


def make_models(build):
    """Verilated classes are headers that the build makes."""
    targets = output_of("ninja", "-C", str(build), "-t", "targets", "all")
    models = re.findall(r"^(.*\.dir/V[A-Za-z0-9_]*\.h): CUSTOM_COMMAND$", targets, re.MULTILINE)
    if models:
        output_of("ninja", "-C", str(build), *models)


def commands_of(build):
    """How each source is compiled, also those that are compiled together."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        entry["command"] = FOR_GCC.sub("", PRECOMPILED.sub("", entry["command"]))
        if not TOGETHER.search(entry["file"]):
            yield entry
            continue
        for name in INCLUDE.findall(Path(entry["file"]).read_bytes()):
            name = name.decode()
            yield entry | {"file": name, "command": entry["command"].replace(entry["file"], name)}


def tidy(folder, name):
    """The findings in one source, None if it is clean; `folder` has the commands."""
    run = subprocess.run(("clang-tidy", "--quiet", "-p", str(folder), name), cwd=ROOT,
                         capture_output=True, text=True, check=False)
    if run.returncode == 0:
        return None
    lines = [line for line in run.stdout.splitlines() if FINDING.search(line)]
    return "\n".join(lines) or f"{name}: clang-tidy failed: {run.stderr.strip()[-500:]}"


def main():
    parser = argparse.ArgumentParser(description="clang-tidy on what changed")
    parser.add_argument("build", type=Path, help="configured build directory")
    parser.add_argument("--sample", action="store_true", help="last commits and one in sixteen")
    options = parser.parse_args()
    build = options.build.resolve()
    commands = list(commands_of(build))
    compiled = {entry["file"] for entry in commands}
    names = [name for name in our_files("sim/*.cpp", "sw/*.cpp", "tb/*.cpp")
             if str(ROOT / name) in compiled]
    if options.sample:
        names = sample_of(names)
    includes, stamps = Includes(), build / "tidy"
    stamps.mkdir(exist_ok=True)
    settings = (ROOT / ".clang-tidy").read_bytes()
    keys = {name: key_of(name, includes, settings) for name in names}
    todo = [name for name in names if not (stamps / keys[name]).exists()]
    if not todo:
        return 0
    make_models(build)
    (stamps / "compile_commands.json").write_text(json.dumps(commands))
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        for name, finding in zip(todo, pool.map(lambda name: tidy(stamps, name), todo)):
            if finding is None:
                (stamps / keys[name]).touch()
            else:
                failures += 1
                print(finding, flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

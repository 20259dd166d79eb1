# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the test programs with mutated models.
"""build() leaves what it has built, and makes anew only what has changed."""
import hashlib
import json
import os
import pathlib
import stat
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def rtl_files():
    """The files of rtl/can.f."""
    lines = (ROOT / "rtl" / "can.f").read_text(encoding="utf-8").split("\n")
    return [ROOT / "rtl" / line.strip() for line in lines if line.strip().endswith(".sv")]


def part_of(path):
    """The part that a file of the RTL belongs to (FOLDERS in regression.py)."""
    if path.stem in ("can_apb", "can_axil", "can_wb"):
        return "buses"
    if path.stem == "can_mb_stamp":
        return "time"
    return path.parent.name if path.parent.name in ("remote", "time") else "core"


def modules_of(part):
    """Modules of a part: the node without a processor, the time unit, buses, or the rest."""
    return {path.stem for path in rtl_files() if part_of(path) == part}


def write_if_new(path, text):
    """Leaves the time of a file alone that has this text already."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def transform(directory, numbers):
    """Writes the program for VERICAN_RTL_TRANSFORM; a new list or a new mutator make a new one."""
    directory.mkdir(parents=True, exist_ok=True)
    listing = json.dumps(numbers, indent=0, sort_keys=True)
    write_if_new(directory / "mutants.json", listing)
    digest = hashlib.sha256(listing.encode())
    for source in sorted(HERE.glob("*.py")):
        if source.stem in ("sv_tree", "sv_module", "mutants", "schemata", "transform"):
            digest.update(source.read_bytes())
    script = directory / "mutants.sh"
    write_if_new(script, "#!/bin/bash\n"
                 f"# {digest.hexdigest()}\n"
                 f"export VERICAN_MUTANT_LIST='{directory / 'mutants.json'}'\n"
                 f"exec '{HERE / 'transform.py'}' \"$@\"\n")
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    return script


def checked(command, log):
    """Runs a command; its output goes to a file, and to the screen if it fails."""
    with open(log, "a", encoding="utf-8") as file:
        code = subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, cwd=ROOT,
                              env={**os.environ, "CCACHE_BASEDIR": str(ROOT),
                                   "CCACHE_NOHASHDIR": "1"}).returncode
    if code != 0:
        tail = pathlib.Path(log).read_text(encoding="utf-8", errors="replace")[-4000:]
        sys.exit(f"{tail}\nrun.py: failed: {' '.join(map(str, command[:6]))} ...; all in {log}")


def build(directory, numbers, targets, jobs):
    """Configures and builds the targets in a directory.

    Without the simulator's short cuts (VERICAN_PLAIN_EDGES): with them an engine that has mutants,
    all of them off, does not do what its RTL says.
    """
    directory = pathlib.Path(directory)
    script = transform(directory, numbers)
    log = directory / "build.log"
    log.unlink(missing_ok=True)
    checked(["cmake", "-S", ROOT, "-B", directory, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             f"-DVERICAN_RTL_TRANSFORM={script}", "-DVERICAN_PLAIN_EDGES=ON"], log)
    checked(["cmake", "--build", directory, "-j", str(jobs), "--target", *targets], log)

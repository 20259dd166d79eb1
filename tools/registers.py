#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""registers.py: writes everything that is made from the register map, sw/registers.yaml.

With --check it writes nothing and exits with status 1 if one of the files is not what it would
write. Status 2: the map itself, or sw/profiles.yaml, is wrong.
"""
import argparse
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

# ruff: noqa: E402  (the path must be set first)
from plain_end import run
from regmap import c_header, chapter, model, svd, systemverilog, test_table

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "sw/registers.yaml"
PROFILES = ROOT / "sw/profiles.yaml"


def outputs(regmap):
    """path -> text."""
    return {
        "rtl/host/can_regs_pkg.sv": systemverilog.render(regmap),
        "sw/driver/include/verican/verican_regs.h": c_header.render(regmap),
        "tb/mailbox/register_table.inc": test_table.render(regmap),
        "tb/harness/core_builds.inc": test_table.render_builds(
            regmap, model.load_profiles(PROFILES, regmap)),
        "tb/harness/single_builds.inc": test_table.render_single_builds(regmap),
        "sw/verican.svd": svd.render(regmap),
        **chapter.render(regmap),
    }


def stale(files):
    """The paths whose content is not what it should be."""
    return [path for path, text in files.items()
            if not (ROOT / path).exists() or (ROOT / path).read_text() != text]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    arguments = parser.parse_args()
    try:
        files = outputs(model.load(SOURCE))
    except model.MapError as error:
        print(f"registers.py: {error}", file=sys.stderr)
        return 2
    changed = stale(files)
    if arguments.check:
        for path in changed:
            print(f"{path}: not what sw/registers.yaml says; run: make registers", file=sys.stderr)
        return 1 if changed else 0
    for path in changed:
        (ROOT / path).parent.mkdir(parents=True, exist_ok=True)
        (ROOT / path).write_text(files[path])
        print(f"wrote {path}")
    print(f"{len(files)} files from sw/registers.yaml, {len(changed)} of them changed")
    return 0


if __name__ == "__main__":
    run(main)

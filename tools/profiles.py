#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""profiles.py: what sw/profiles.yaml says, for CMake and shell scripts.

  profiles.py             one line a profile: NAME NumMb=16 Fifo=0 ...
  profiles.py NAME        the parameters of one profile
  profiles.py --features  one line a build that differs in one feature and what that needs: Fifo=0
  profiles.py --single    one line a build for tests that lacks one feature: no_fifo NumMb=64 Fifo=0
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

# ruff: noqa: E402  (the path must be set first)
from plain_end import run
from regmap import model

ROOT = Path(__file__).resolve().parent.parent


def words(parameters):
    return " ".join(f"{name}={value}" for name, value in parameters.items())


def main(arguments):
    try:
        regmap = model.load(ROOT / "sw/registers.yaml")
        profiles = model.load_profiles(ROOT / "sw/profiles.yaml", regmap)
    except model.MapError as error:
        sys.exit(f"profiles.py: {error}")
    if arguments == ["--single"]:
        lines = [f"{name} {words(one)}" for name, one in model.single_builds(regmap).items()]
    elif arguments == ["--features"]:
        lines = [f"{feature.name}={1 - feature.default}"
                 + (f" {feature.needs}=1" if feature.needs else "") for feature in regmap.features]
    elif not arguments:
        lines = [f"{name} {words(parameters)}" for name, parameters in profiles.items()]
    elif len(arguments) == 1 and arguments[0] in profiles:
        lines = [words(profiles[arguments[0]])]
    else:
        sys.exit(__doc__)
    print("\n".join(lines))


if __name__ == "__main__":
    run(lambda: main(sys.argv[1:]))

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What tools/campaign.py says to a stage by environment, read and checked, and the stage's result.

A variable that is empty counts as unset; one with a value that is not allowed ends the program with
status 2 and a line that names it. tb/harness/campaign_settings.hpp is the same for programs in C++.
"""
import argparse
import json
import os
import re
import sys
from pathlib import Path


class Allowed:
    """The values that a setting may have, in the environment as on the command line."""

    def __init__(self, least, most, above=False):
        """Of the type of `most`. above: `least` itself is not one of them."""
        self.least, self.most, self.above = least, most, above

    def __str__(self):
        return (f"above {self.least:g}, at most {self.most:g}" if self.above
                else f"{self.least} to {self.most}")

    def __contains__(self, value):
        enough = value > self.least if self.above else value >= self.least
        return enough and value <= self.most

    def read(self, text):
        """The number; None if the whole of the text is not one that is allowed."""
        try:
            value = type(self.most)(text)
        except ValueError:
            return None
        plain = re.fullmatch(r"[0-9.e+-]+", text, re.IGNORECASE)
        return value if plain and value in self else None

    def option(self, text):
        """The same as the type of an option for argparse."""
        value = self.read(text)
        if value is None:
            raise argparse.ArgumentTypeError(f"'{text}' is not allowed; allowed: {self}")
        return value

    def variable(self, name, otherwise):
        """The same for a variable of the environment; `otherwise` if it is not set."""
        text = os.environ.get(name, "")
        value = self.read(text) if text else otherwise
        if value is None:
            fail(f"{name} is '{text}'; allowed: {self}")
        return value


SEEDS = Allowed(0, 2**63 - 1)
SCALES = Allowed(0.0, 1.0, above=True)
JOBS = Allowed(1, 64)


def fail(text):
    """Ends the program as one that was called wrongly."""
    print(f"{Path(sys.argv[0]).name}: {text}", file=sys.stderr)
    sys.exit(2)


def seed():
    """CAMPAIGN_SEED, 1 by default."""
    return SEEDS.variable("CAMPAIGN_SEED", 1)


def scale():
    """CAMPAIGN_SCALE, 1 by default: the part of the stage that is run."""
    return SCALES.variable("CAMPAIGN_SCALE", 1.0)


def jobs():
    """CAMPAIGN_JOBS, 2 by default: how much is done at a time."""
    return JOBS.variable("CAMPAIGN_JOBS", 2)


def result_file():
    """The file for the result, None if none is wanted. To be asked before the work: ends the
    program if no file can be written there; what is there stays as it is."""
    return writable(os.environ.get("CAMPAIGN_OUT", ""))


def writable(name):
    """The same for the file `name`; none is wanted if that is empty or None."""
    if not name:
        return None
    path = Path(name)
    there = path.exists() or path.is_symlink()
    try:
        path.open("a", encoding="utf-8").close()
    except OSError as error:
        fail(f"cannot write '{path}': {error.strerror}")
    if not there:
        path.unlink(missing_ok=True)
    return path


def write_result(path, result):
    """Writes the result, unless path is None; returns the status of the stage: 1 if a figure misses
    its bar."""
    if path is not None:
        path.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    return int(any(figure["ok"] is False for figure in result["figures"]))

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""packaging_rules.py [--check]: holds tb/packaging.yaml against the tests that it names and writes
docs/packaging-rules.md. --check: writes nothing; status 1 if a test or a row is not there,
a row has neither test nor reason, a module has a foreign name, or the page is stale.

A test is a method test_... of a class in Python, a test or suite of GoogleTest, a proven property
(by a rule that the comment above it names) or, with proofs.yaml, a proof. A word that stands in the
file elsewhere is none.
"""
import argparse
import ast
import re
import sys
from pathlib import Path

import yaml

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

# ruff: noqa: E402  (the path must be set first)
from pack.wrappers import ROOT, rtl_files
from plain_end import run
from test_plan import TEST, blank_opaque

sys.path.insert(0, str(ROOT / "tb/formal"))
from runner import catalogue

PLAN = ROOT / "tb/packaging.yaml"
PAGE = ROOT / "docs/packaging-rules.md"
# All rows of the specification, first and last of each run of numbers.
RUNS = ((1, 7), (10, 26), (30, 35), (39, 53), (55, 57), (60, 63), (65, 67), (70, 78), (80, 80),
        (85, 90))
HEAD = """\
# Rules of packaging and their tests

Written by `make rules` from [`tb/packaging.yaml`](../tb/packaging.yaml), whose tests are looked
up; `make test` fails if one is missing, a row has none and no reason, or this page is stale.
*Measured* is what is seen by other means than a test of `make test`: another command, or a reader.
*Not run* is what of a row no tool here has seen.
"""


def foreign_modules():
    """PK-86: modules of the RTL that do not begin with can_."""
    names = [name for file in rtl_files() for name in
             re.findall(r"^(?:module|package) (\w+)", (ROOT / file).read_text(encoding="utf-8"),
                        re.MULTILINE)]
    return [name for name in names if not name.startswith("can_")]


def split(test):
    """File and word of an entry of `tests`."""
    file, _, word = test.partition(" ")
    return file, word.strip()


def python_tests(path):
    """Names of the methods that unittest runs."""
    groups = ast.parse(path.read_text(encoding="utf-8")).body
    return {test.name for group in groups if isinstance(group, ast.ClassDef)
            for test in group.body
            if isinstance(test, ast.FunctionDef) and test.name.startswith("test_")}


def google_tests(path):
    """Names of the tests of a program, and of their suites."""
    found = TEST.findall(blank_opaque(path.read_text(encoding="utf-8")))
    return {name for _, *names in found for name in names
            if not any(part.startswith("DISABLED_") for part in names)}


def proven_rules(path):
    """Rules that the comments above the properties of a file name, if a proof takes the file."""
    taken = {(proof.folder / name).resolve() for proof in catalogue.load(ROOT / "tb/formal")
             for name in sum(proof.splice.values(), proof.files)}
    return {rule for one in catalogue.read_properties(path) if path in taken
            for rule in one.rules if one.is_property and one.kind == "assert"}


def proofs(path):
    """Names of the proofs of a part."""
    return {proof.name for proof in catalogue.load(ROOT / "tb/formal")
            if proof.folder == path.parent}


READERS = {".py": python_tests, ".cpp": google_tests, ".sv": proven_rules, ".yaml": proofs}


def tests_of(path):
    """What in a file of tests an entry of `tests` may name."""
    return READERS.get(path.suffix, lambda path: set())(path)


def problems(sections):
    """What is wrong, a line each."""
    for section in sections:
        for name, row in section["rows"].items():
            if not any(row.get(key) for key in ("tests", "measured", "not_run")):
                yield f"{name} has neither a test nor a reason"
            for file, word in map(split, row.get("tests", [])):
                if not (ROOT / file).is_file():
                    yield f"{name}: {file}: no such file"
                elif not (names := tests_of(ROOT / file)) or (word and word not in names):
                    yield f"{name}: {file}: no test {word}".rstrip()
    listed = [name for section in sections for name in section["rows"]]
    for first, last in RUNS:
        for number in range(first, last + 1):
            if f"PK-{number:02}" not in listed:
                yield f"PK-{number:02} is not in {PLAN.relative_to(ROOT)}"
    for name in foreign_modules():
        yield f"PK-86: module {name} does not begin with can_"


def render(sections):
    """The page."""
    lines = [HEAD]
    for section in sections:
        lines.append(f"\n## {section['section']}\n\n| row | what | tests | measured, not run |\n"
                     "|---|---|---|---|\n")
        for name, row in section["rows"].items():
            tests = "<br>".join(
                f"[{Path(file).name}](../{file})" + (f": `{word}`" if word else "")
                for file, word in map(split, row.get("tests", [])))
            others = "<br>".join(f"*{key.replace('_', ' ')}:* {row[key]}"
                                 for key in ("measured", "not_run") if key in row)
            lines.append(f"| {name} | {row['title']} | {tests} | {others} |\n")
    return "".join(lines)


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split(":", maxsplit=1)[0])
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    sections = yaml.safe_load(PLAN.read_text(encoding="utf-8"))
    found = list(problems(sections))
    text = render(sections)
    if not check:
        PAGE.write_text(text, encoding="utf-8")
    elif not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
        found.append(f"{PAGE.relative_to(ROOT)} is stale: run `make rules` and commit it")
    for line in found:
        print(f"packaging: {line}", file=sys.stderr)
    print(f"packaging: {sum(len(s['rows']) for s in sections)} rows, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    run(main)

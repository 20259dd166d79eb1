#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""rules.py: checks that every rule of the plan has a test and writes docs/rules.md (rule -> tests).

A test cites a rule where the id (such as AR-02) stands in the body of a TEST, TEST_F or TEST_P
block, in the comment lines directly above it, or directly above or inside an
INSTANTIATE_TEST_SUITE_P (then for every TEST_P of that suite). DISABLED_ tests do not count.
A range such as "SY-05..SY-09" cites its two ends only. Tests of the judges (model_*_test.cpp) are
listed, but what they cite still needs a test of the core.

Exit status 1 if a required rule has no test, a cited id is not in the plan, a rule that cannot
apply is cited, or, with --check, docs/rules.md is not what this script would write.
"""
import argparse
import re
import sys
from collections import defaultdict
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent
PLAN = ROOT / "tb/plan.yaml"
TABLE = ROOT / "docs/rules.md"
RULE_BOOK = ROOT.parent / "shared/can-rules.md"  # present on the authors' machines only

FAMILIES = "FF|ST|CR|AK|IF|AR|RO|ED|EF|OV|FC|IN|BO|TL|BT|SY|VA|MO|TS|MX|TH|PF"
RULE_ID = re.compile(rf"\b(?:(?:{FAMILIES})-\d\d[a-c]?|GV-\d)\b")
TEST = re.compile(r"^(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.M)
INSTANCE = re.compile(r"^INSTANTIATE_TEST_SUITE_P\(\s*\w*\s*,\s*(\w+)\s*,", re.M)
JUDGE = re.compile(r"/model_\w+_test\.cpp$")
# What braces and parentheses must not be counted in: raw strings, strings, characters, comments.
OPAQUE = re.compile(r'R"\((?s:.*?)\)"|"(?:\\.|[^"\\\n])*"|'
                    r"'(?:\\.|[^'\\\n])'|//[^\n]*|/\*(?s:.*?)\*/")


def blank_opaque(text):
    """The same text, same offsets, with strings and comments turned into spaces."""
    return OPAQUE.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def end_of_group(plain, start, opening, closing):
    """Offset just behind the group that opens first at or after `start`."""
    depth = 0
    for offset in range(plain.index(opening, start), len(plain)):
        if plain[offset] == opening:
            depth += 1
        elif plain[offset] == closing:
            depth -= 1
            if depth == 0:
                return offset + 1
    return len(plain)


def comment_start(text, start):
    """Offset where the run of // lines directly above `start` begins."""
    lines = text[:start].split("\n")[:-1]
    begin = start
    while lines and lines[-1].lstrip().startswith("//"):
        begin -= len(lines.pop()) + 1
    return begin


def citations(path):
    """Yields (rule id, "Suite.Test") for every citation in one test file."""
    text = path.read_text()
    plain = blank_opaque(text)
    tests_of_suite = defaultdict(list)
    for match in TEST.finditer(plain):
        kind, suite, name = match.groups()
        if name.startswith("DISABLED_") or suite.startswith("DISABLED_"):
            continue
        tests_of_suite[suite].append(name)
        end = end_of_group(plain, match.end(), "{", "}")
        for rule in RULE_ID.findall(text[comment_start(text, match.start()):end]):
            yield rule, f"{suite}.{name}"
    for match in INSTANCE.finditer(plain):
        end = end_of_group(plain, match.start(), "(", ")")
        for rule in RULE_ID.findall(text[comment_start(text, match.start()):end]):
            for name in tests_of_suite[match.group(1)]:
                yield rule, f"{match.group(1)}.{name}"


def all_citations():
    """rule id -> file -> set of test names."""
    cited = defaultdict(lambda: defaultdict(set))
    for path in sorted((ROOT / "tb").glob("*/*_test.cpp")):
        for rule, test in citations(path):
            cited[rule][path.relative_to(ROOT).as_posix()].add(test)
    return cited


def load_plan():
    """rule id -> (title, reason or None, required); exits with one line if the plan is bad."""
    rules = {}
    for section in yaml.safe_load(PLAN.read_text()):
        for rule, entry in section["rules"].items():
            if not RULE_ID.fullmatch(rule) or rule in rules:
                sys.exit(f"{PLAN}: {rule}: not a rule id, or there twice")
            title, reason = entry, None
            if isinstance(entry, dict):
                title, reason = entry["title"], entry["not_applicable"]
            rules[rule] = (title, reason, not section.get("optional") and reason is None)
    return rules


def has_test(rule, cited):
    """Whether a test that is not only about a judge cites the rule."""
    return any(not JUDGE.search(path) for path in cited.get(rule, ()))


def problems(rules, cited):
    """One line for everything that makes the plan and the tests disagree."""
    for rule, (title, reason, required) in rules.items():
        if required and not has_test(rule, cited):
            yield f"{rule} ({title}): no test cites it"
        if reason is not None and rule in cited:
            yield f"{rule}: cited by {sorted(cited[rule])[0]}, but the plan says it does not apply"
    for rule in sorted(set(cited) - set(rules)):
        yield f"{rule}: cited by {sorted(cited[rule])[0]}, but not in tb/plan.yaml"
    if RULE_BOOK.exists():
        book = set(re.findall(r"^- \*\*([A-Z]{2}-\d+[a-c]?)\*\*", RULE_BOOK.read_text(), re.M))
        book = {rule for rule in book if RULE_ID.fullmatch(rule)}
        for rule in sorted(book ^ set(rules)):
            yield f"{rule}: in the rule book or in tb/plan.yaml, but not in both"


def cell(rule, reason, cited):
    """The table cell that names the tests of a rule."""
    if reason is not None:
        return f"*does not apply:* {reason}"
    parts = []
    for path, tests in sorted(cited.get(rule, {}).items()):
        names = ", ".join(f"`{test}`" for test in sorted(tests))
        parts.append(f"[{Path(path).stem}](../{path}): {names}")
    return "<br>".join(parts) or "–"


def table(rules, cited):
    """docs/rules.md as text."""
    required = [rule for rule, entry in rules.items() if entry[2]]
    tests = {test for files in cited.values() for names in files.values() for test in names}
    out = ["# Rules and their tests", "",
           "Written by `make rules` from [`tb/plan.yaml`](../tb/plan.yaml) and the rule ids that",
           "the tests cite; `make test` fails if a rule lacks a test or this page is stale.", "",
           f"{sum(has_test(rule, cited) for rule in required)} of {len(required)} rules have a "
           "test; "
           f"{sum(entry[1] is not None for entry in rules.values())} rules do not apply; "
           f"{len(tests)} tests cite rules."]
    for section in yaml.safe_load(PLAN.read_text()):
        note = " (optional)" if section.get("optional") else ""
        out += ["", f"## {section['section']} {section['name']}{note}", "",
                "| rule | title | tests |", "|---|---|---|"]
        for rule in section["rules"]:
            title, reason, _ = rules[rule]
            out.append(f"| {rule} | {title} | {cell(rule, reason, cited)} |")
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="only compare the page")
    check = parser.parse_args().check
    rules, cited = load_plan(), all_citations()
    found = list(problems(rules, cited))
    text = table(rules, cited)
    if not check:
        TABLE.write_text(text)
    elif not TABLE.exists() or TABLE.read_text() != text:
        found.append("docs/rules.md is stale: run `make rules` and commit it")
    for line in found:
        print(f"rules: {line}", file=sys.stderr)
    tested = sum(has_test(rule, cited) for rule in rules)
    print(f"rules: {tested} of {len(rules)} have a test, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

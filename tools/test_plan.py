# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""test_plan: holds a plan (a YAML file of ids with titles) against the tests that cite its ids.

A test cites an id where it stands in the body of a TEST, TEST_F or TEST_P block, in the comment
lines directly above it, or directly above or inside an INSTANTIATE_TEST_SUITE_P (then for every
TEST_P of that suite). DISABLED_ tests do not count. A range such as "SY-05..SY-09" cites its two
ends only. In a unittest module (*_cases.py) a test cites what stands in its text, and what stands
in the docstring of its class. A judge of `make test-linux` (sw/linux/judge_*.py, one function a
script) cites what stands in its docstring. A test of a page (tb/report/*_test.mjs) cites what
stands in the comment at its head, which is about the whole file. Tests of the judges
(model_*_test.cpp) are listed, but what they cite still needs a test of the core.

The plan is a list of sections: `section`, `name`, `optional` (ids may be cited but need no test)
and the ids with their titles; an id with {title, not_applicable: reason} must not be cited, and one
with {title, measured: how} needs no test: a command that is not one measures it.
"""
import argparse
import ast
import re
import sys
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent

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


def citations(path, ids):
    """Yields (id, "Suite.Test") for every citation in one test file."""
    text = path.read_text()
    plain = blank_opaque(text)
    tests_of_suite = defaultdict(list)
    for match in TEST.finditer(plain):
        _, suite, name = match.groups()
        if name.startswith("DISABLED_") or suite.startswith("DISABLED_"):
            continue
        tests_of_suite[suite].append(name)
        end = end_of_group(plain, match.end(), "{", "}")
        for cited in ids.findall(text[comment_start(text, match.start()):end]):
            yield cited, f"{suite}.{name}"
    for match in INSTANCE.finditer(plain):
        end = end_of_group(plain, match.start(), "(", ")")
        for cited in ids.findall(text[comment_start(text, match.start()):end]):
            for name in tests_of_suite[match.group(1)]:
                yield cited, f"{match.group(1)}.{name}"


def python_citations(path, ids):
    """Yields (id, "Class.test_name") for every citation in a unittest module."""
    text = path.read_text()
    for group in ast.parse(text).body:
        if not isinstance(group, ast.ClassDef):
            continue
        shared = ids.findall(ast.get_docstring(group) or "")
        for test in group.body:
            if isinstance(test, ast.FunctionDef) and test.name.startswith("test_"):
                for cited in shared + ids.findall(ast.get_source_segment(text, test)):
                    yield cited, f"{group.name}.{test.name}"


def judge_citations(path, ids):
    """Yields (id, "script") for every citation in the judges of the guests' scripts."""
    for judge in ast.parse(path.read_text()).body:
        if isinstance(judge, ast.FunctionDef):
            for cited in ids.findall(ast.get_docstring(judge) or ""):
                yield cited, judge.name


def page_citations(path, ids):
    """Yields (id, "report.name") for every citation at the head of a test of a page."""
    head = re.match(r"(//[^\n]*\n)+", path.read_text())
    for cited in ids.findall(head[0] if head else ""):
        yield cited, f"report.{path.stem.removesuffix('_test')}"


@dataclass
class Entry:
    """What the plan says of one id."""
    title: str
    not_applicable: str = None   # why
    measured: str = None         # by what, in place of a test
    optional: bool = False

    @property
    def required(self):
        """It needs a test."""
        return not (self.optional or self.not_applicable or self.measured)


@dataclass
class Plan:
    """One plan, its page, and how to speak of it."""
    noun: str           # what an id stands for, singular; its plural is the key in the file
    file: Path          # the plan
    page: Path          # the table that is written
    ids: re.Pattern     # one id, without groups
    heading: str        # of the page
    command: str        # that writes the page
    book: Path = None   # the page that says in full what the ids say; each is an anchor there

    @property
    def key(self):
        return self.noun + "s"

    def sections(self):
        return yaml.safe_load(self.file.read_text())

    def in_book(self):
        """The ids that the book says."""
        if self.book is None:
            return set()
        return set(re.findall(r'<a id="[^"]+"></a>\*\*\[([^\]]+)\]', self.book.read_text()))

    def differences_from_the_book(self, entries):
        """One line for every id that only the book or only the plan has."""
        book = {name for name in self.in_book() if self.ids.fullmatch(name)}
        for name in sorted(book ^ set(entries) if self.book else ()):
            yield f"{name}: in {self.book.name} or in {self.file.name}, but not in both"

    def load(self):
        """id -> Entry; exits with one line if the plan is bad."""
        entries = {}
        for section in self.sections():
            for name, entry in section[self.key].items():
                if not self.ids.fullmatch(name) or name in entries:
                    sys.exit(f"{self.file}: {name}: not the id of a {self.noun}, or there twice")
                fields = entry if isinstance(entry, dict) else {"title": entry}
                if not {"title"} <= set(fields) <= {"title", "not_applicable", "measured"}:
                    sys.exit(f"{self.file}: {name}: a title, and not_applicable or measured")
                entries[name] = Entry(**fields, optional=bool(section.get("optional")))
        return entries

    def citations(self):
        """id -> file -> set of test names."""
        cited = defaultdict(lambda: defaultdict(set))
        for path in sorted((ROOT / "tb").glob("*/*_test.cpp")):
            for name, test in citations(path, self.ids):
                cited[name][path.relative_to(ROOT).as_posix()].add(test)
        for path in sorted((ROOT / "tb").glob("*/*_cases.py")):
            for name, test in python_citations(path, self.ids):
                cited[name][path.relative_to(ROOT).as_posix()].add(test)
        for path in sorted((ROOT / "sw/linux").glob("judge_*.py")):
            for name, test in judge_citations(path, self.ids):
                cited[name][path.relative_to(ROOT).as_posix()].add(test)
        for path in sorted((ROOT / "tb/report").glob("*_test.mjs")):
            for name, test in page_citations(path, self.ids):
                cited[name][path.relative_to(ROOT).as_posix()].add(test)
        return cited

    def problems(self, entries, cited):
        """One line for everything that makes the plan and the tests disagree."""
        where = self.file.relative_to(ROOT)
        for name, entry in entries.items():
            if entry.required and not has_test(name, cited):
                yield f"{name} ({entry.title}): no test cites it"
            if entry.not_applicable and name in cited:
                yield (f"{name}: cited by {sorted(cited[name])[0]}, "
                       f"but {where} says it does not apply")
        for name in sorted(set(cited) - set(entries)):
            yield f"{name}: cited by {sorted(cited[name])[0]}, but not in {where}"

    def linked(self, name, book):
        """The id, an anchor itself, as a link to where the book says it."""
        if name not in book:
            return name
        anchor = name.lower()
        return f'<a id="{anchor}"></a>[{name}]({self.book.name}#{anchor})'

    def table(self, entries, cited):
        """The page as text."""
        counts = f"{share(required(entries), cited)} {self.key} have a test"
        if optional(entries):
            counts += f", and {share(optional(entries), cited)} optional ones"
        unfit = sum(entry.not_applicable is not None for entry in entries.values())
        others = sum(entry.measured is not None for entry in entries.values())
        if others:
            counts += f", {others} are measured otherwise"
        tests = {test for files in cited.values() for names in files.values() for test in names}
        name = self.file.relative_to(ROOT)
        out = [f"# {self.heading}", "",
               f"Written by `{self.command}` from [`{name}`](../{name}) and the {self.noun} "
               "ids that",
               f"the tests cite; `make test` fails if a {self.noun} lacks a test or this page is "
               "stale.", "",
               f"{counts}; {unfit} {self.key} "
               f"do not apply; {len(tests)} tests cite {self.key}."]
        book = self.in_book()
        for section in self.sections():
            note = " (optional)" if section.get("optional") else ""
            out += ["", f"## {section['section']} {section['name']}{note}", "",
                    f"| {self.noun} | title | tests |", "|---|---|---|"]
            for name in section[self.key]:
                entry = entries[name]
                out.append(f"| {self.linked(name, book)} | {entry.title} | "
                           f"{cell(name, entry, cited)} |")
        return "\n".join(out) + "\n"


def has_test(name, cited):
    """Whether a test that is not only about a judge cites the id."""
    return any(not JUDGE.search(path) for path in cited.get(name, ()))


def required(entries):
    """Ids that need a test."""
    return [name for name, entry in entries.items() if entry.required]


def optional(entries):
    """Ids that may be cited but need no test."""
    return [name for name, entry in entries.items()
            if entry.optional and not (entry.not_applicable or entry.measured)]


def share(names, cited):
    """How many of the ids have a test, as "5 of 7"."""
    return f"{sum(has_test(name, cited) for name in names)} of {len(names)}"


def cell(name, entry, cited):
    """The table cell that names the tests of an id."""
    if entry.not_applicable:
        return f"*does not apply:* {entry.not_applicable}"
    parts = [f"*measured:* {entry.measured}"] if entry.measured else []
    for path, tests in sorted(cited.get(name, {}).items()):
        names = ", ".join(f"`{test}`" for test in sorted(tests))
        parts.append(f"[{Path(path).stem}](../{path}): {names}")
    return "<br>".join(parts) or "–"


def main(plan, description):
    """Checks the plan and writes its page, or with --check compares it; the exit status."""
    parser = argparse.ArgumentParser(description=description.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="only compare the page")
    check = parser.parse_args().check
    entries, cited = plan.load(), plan.citations()
    found = [*plan.problems(entries, cited), *plan.differences_from_the_book(entries)]
    text = plan.table(entries, cited)
    if not check:
        plan.page.write_text(text)
    elif not plan.page.exists() or plan.page.read_text() != text:
        page = plan.page.relative_to(ROOT)
        found.append(f"{page} is stale: run `{plan.command}` and commit it")
    for line in found:
        print(f"{plan.key}: {line}", file=sys.stderr)
    print(f"{plan.key}: {share(entries, cited)} have a test, {len(found)} problems")
    return 1 if found else 0

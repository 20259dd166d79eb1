# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.tree: installs, moves the tree, and looks at what is in it.
"""usage: install_tree.py SOURCE BUILD SANITIZED"""
import os
import re

import tree

EXPECTED = [
    "bin/verican", "include/vericansim/bus/bus.hpp", "include/vericansim/node/host.hpp",
    "include/verican/verican.h", "include/verican/verican_regs.h", "share/verican/rtl/can.f",
    "share/verican/rtl/host/can_ahb.sv", "share/verican/verican.svd",
    "share/verican/driver/src/init.c", "share/verican/driver/include/verican/verican.h",
    "share/verican/remote/verican_remote.h", "share/verican/remote/src/ask.c",
    "share/verican/remote/verican_remote.py", "share/verican/remote/vectors.yaml",
    "share/verican/python/verican_helper.py", "share/verican/examples/two-nodes.yaml",
    "share/verican/examples/external/two_nodes.cpp",
    "share/verican/firmware/common/a2f500.ld", "share/verican/firmware/common/semihost.h",
    "share/doc/verican/LICENSE", "share/doc/verican/docs/first-bus.md",
]
TEXT = {".hpp", ".h", ".c", ".cmake", ".pc", ".f", ".sv", ".vlt", ".yaml", ".svd", ".md", ".py"}


def look_for_paths(installed, first):
    """No text file names the sources, the build, or the place of the installation."""
    secrets = [str(path) for path in (installed.source, installed.build, first)]
    for file in installed.prefix.rglob("*"):
        if file.suffix in TEXT:
            text = file.read_text(encoding="utf-8")
            for secret in secrets:
                tree.check(secret not in text, f"{file} names {secret}")


def check_rtl(installed):
    """can.f names files that are there, and nothing of the RTL is missing."""
    rtl = installed.prefix / "share" / "verican" / "rtl"
    lines = [line.split("#")[0].strip() for line in (rtl / "can.f").read_text().splitlines()]
    for line in filter(None, lines):
        tree.check((rtl / line).is_file(), f"{rtl / 'can.f'} names {line}, which is missing")


def check_links(installed):
    """Every link of the pages leads to something that is installed."""
    pages = list((installed.prefix / "share" / "doc").rglob("*.md"))
    tree.check(len(pages) > 20, f"only {len(pages)} pages are installed")
    for page in pages:
        for target in re.findall(r"\]\(([^)\s#]+)[^)]*\)", page.read_text(encoding="utf-8")):
            tree.check(":" in target or (page.parent / target).exists(),
                       f"{page} has a link to {target}, which is not installed")


def check_examples(installed):
    """The files that the examples' scenarios read are installed where they say; programs can be
    run."""
    examples = installed.prefix / "share" / "verican" / "examples"
    read = [(file, name) for file in examples.rglob("*.yaml")
            for name in re.findall(r"\b(?:firmware|replay|dbc): ([\w./-]+)",
                                   file.read_text(encoding="utf-8"))]
    tree.check(len(read) >= 4, f"the scenarios name too few files: {read}")
    for file, name in read:
        tree.check((file.parent / name).is_file(), f"{file} names {name}, which is not installed")
    for program in examples.rglob("*.py"):
        tree.check(not program.read_bytes().startswith(b"#!") or os.access(program, os.X_OK),
                   f"{program} may not be executed")


def check_versions(installed):
    """Tool, pkg-config files and project() agree."""
    want = installed.project_version()
    seen = {"the tool": installed.run([installed.prefix / "bin" / "verican", "--version"],
                                      installed.root).split()[-1]}
    for file in installed.prefix.rglob("*.pc"):
        said = installed.run(["pkg-config", "--modversion", file], installed.root)
        seen[file.name] = said.strip()
    tree.check(len(seen) >= 3, f"too few versions: {seen}")
    for what, version in seen.items():
        tree.check(version == want, f"version of {what} is {version}, of the project {want}")


def check_tool(installed):
    """The tool works from where it lies now, the page of reports included."""
    work = installed.work("tool")
    scenario = installed.prefix / "share" / "verican" / "examples" / "two-nodes.yaml"
    command = [installed.prefix / "bin" / "verican", "run", scenario, "--candump", "bus.log"]
    cache = (installed.build / "CMakeCache.txt").read_text(encoding="utf-8")
    with_page = re.search(r"^VERICAN_REPORT_PAGE:INTERNAL=.+$", cache, re.MULTILINE)
    installed.run(command + (["--report", "bus.html"] if with_page else []), work)
    log = (work / "bus.log").read_text(encoding="utf-8")
    tree.check(log.count(" 123#") == 10,  # 50 ms, every 5 ms
               f"{scenario} did not send 0x123 ten times:\n{log}")
    if with_page:
        page = (work / "bus.html").read_text(encoding="utf-8")
        tree.check("</html>" in page and f"verican {installed.project_version()}" in page,
                   "the page of the report is not complete")


def test(installed):
    """Installs to root/first, moves that to root/moved/here."""
    root = installed.make_root()
    first = root / "first"
    installed.install(first)
    installed.prefix.parent.mkdir()
    first.rename(installed.prefix)
    for name in EXPECTED:
        tree.check((installed.prefix / name).is_file(), f"{name} is not installed")
    empty = [str(path) for path in installed.prefix.rglob("*") if path.is_dir() and
             not any(path.iterdir())]
    tree.check(not empty, f"empty directories are installed: {', '.join(empty)}")
    look_for_paths(installed, first)
    check_rtl(installed)
    check_links(installed)
    check_examples(installed)
    check_versions(installed)
    check_tool(installed)


tree.main(test)

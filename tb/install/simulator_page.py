# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.simulator_page: the programs of docs/simulator.md compile and do what they say.
"""usage: simulator_page.py SOURCE BUILD SANITIZED"""
import re

import tree


def test(installed):
    """Every C++ block with a main() is a program; it ends with 0 if its frame has arrived."""
    page = (installed.source / "docs" / "simulator.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```cpp\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    programs = [block for block in blocks if "int main(" in block]
    tree.check(programs, "docs/simulator.md has no program")
    work = installed.work("simulator_page")
    env = installed.environment()
    flags = {what: installed.run(["pkg-config", what, "vericansim"], work, env).split()
             for what in ("--cflags", "--libs")}
    for number, program in enumerate(programs):
        source = work / f"program{number}.cpp"
        source.write_text(program, encoding="utf-8")
        installed.run(["g++", "-std=c++20", "-Wall", "-Werror", *env["CXXFLAGS"].split(),
                       *flags["--cflags"], source, "-o", source.with_suffix(""),
                       *flags["--libs"]], work, env)
        installed.run([source.with_suffix("")], work)
    print(f"{len(programs)} programs")


tree.main(test)

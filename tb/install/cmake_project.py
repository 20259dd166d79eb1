# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.cmake_project: a user's project finds the installed tree with find_package.
"""usage: cmake_project.py SOURCE BUILD SANITIZED"""
import json
import re

import external
import tree


def check_compile_commands(installed, build):
    """Neither commands nor the headers that were really read lead back into the sources."""
    commands = json.loads((build / "compile_commands.json").read_text())
    tree.check(len(commands) >= 4, f"only {len(commands)} compile commands")
    for entry in commands:
        for place in (installed.source, installed.build):
            tree.check(str(place) not in entry["command"], f"{place} in: {entry['command']}")
    read = re.findall(r"^ +(/.*)$", installed.run(["ninja", "-C", build, "-t", "deps"], build),
                      re.MULTILINE)
    installed.check_outside(read, "the CMake project")


def check_page(installed, project):
    """What docs/install.md shows of a CMakeLists.txt is part of the one that is built here."""
    page = (installed.source / "docs" / "install.md").read_text(encoding="utf-8")
    shown = re.findall(r"^```cmake\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    built = (project / "CMakeLists.txt").read_text(encoding="utf-8").splitlines()
    tree.check(shown, "docs/install.md shows no CMake")
    for line in "".join(shown).splitlines():
        tree.check(line in built, f"docs/install.md: not in the example project: {line}")


def test(installed):
    """Configures, builds, runs."""
    project = external.copy_project(installed, "cmake")
    check_page(installed, project)
    build = project / "build"
    env = installed.environment()
    said = installed.run(["cmake", "-S", project, "-B", build, "-G", "Ninja",
                          f"-DCMAKE_PREFIX_PATH={installed.prefix}",
                          "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"], project, env)
    tree.check(f"verican {installed.project_version()}: {installed.prefix}" in said,
               f"another verican was found:\n{said}")
    installed.run(["ninja", "-C", build, "-j", "1"], project, env)
    check_compile_commands(installed, build)
    external.check_programs(installed, build)


tree.main(test)

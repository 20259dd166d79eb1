# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.archives_are_complete: whatever of a library is used, pkg-config's flags link it.
"""usage: whole_archive.py SOURCE BUILD SANITIZED"""
import tree

# SystemC's library asks every program for sc_main.
MAIN = 'int main() {}\nextern "C" int sc_main(int, char **) { return 0; }\n'


def test(installed):
    """Links each archive as a whole, as if a program used everything in it."""
    work = installed.work("archives")
    (work / "main.cpp").write_text(MAIN)
    env = installed.environment()
    packages = sorted(installed.prefix.rglob("*.pc"))
    tree.check(len(packages) >= 2, f"only {packages}")
    for package in packages:
        flags = installed.run(["pkg-config", "--libs", package.stem], work, env).split()
        own = [flag for flag in flags if flag.startswith("-lverican")]
        archive = next(installed.prefix.rglob(f"lib{own[0][2:]}.a"))
        installed.run(["g++", *env["CXXFLAGS"].split(), "main.cpp", "-o", package.stem,
                       "-Wl,--whole-archive", archive, "-Wl,--no-whole-archive",
                       *(flag for flag in flags if flag != own[0])], work, env)
        installed.run([work / package.stem], work)


tree.main(test)

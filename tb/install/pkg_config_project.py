# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.pkg_config_project: a plain Makefile finds the installed tree with pkg-config.
"""usage: pkg_config_project.py SOURCE BUILD SANITIZED"""
import external
import tree


def dependencies(directory):
    """All files that the dependency files of a compiler name."""
    words = []
    for file in directory.glob("*.d"):
        words += file.read_text().replace("\\\n", " ").split()
    return [word for word in words if word.startswith("/")]


def test(installed):
    """Builds, runs; then without the installation: a clear end."""
    project = external.copy_project(installed, "make")
    env = installed.environment()
    for name in ("CFLAGS", "CXXFLAGS"):
        env[name] += " -MMD"
    said = installed.run(["make", "OUT=out"], project, env)
    for place in (installed.source, installed.build):
        tree.check(str(place) not in said, f"{place} in the commands:\n{said}")
    installed.check_outside(dependencies(project / "out"), "the Makefile project")
    external.check_programs(installed, project / "out")
    env["PKG_CONFIG_PATH"] = str(project)
    said = installed.run(["make", "OUT=other"], project, env, expect=2)
    tree.check("pkg-config does not find vericansim" in said, f"unclear message:\n{said}")


tree.main(test)

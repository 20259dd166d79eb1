# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.components: what find_package says when a part or a version is not there.
"""usage: components.py SOURCE BUILD SANITIZED"""
import tree

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(probe LANGUAGES {languages})
find_package(verican {request})
message(STATUS "result: ${{verican_FOUND}}; ${{verican_driver_FOUND}}; ${{verican_sim_FOUND}}")
"""


def configure(installed, prefix, request, expect=0, languages="C", more=None):
    """What CMake prints, blanks folded: its messages are wrapped."""
    work = installed.work("components")
    (work / "CMakeLists.txt").write_text(PROJECT.format(languages=languages, request=request))
    said = installed.run(["cmake", "-S", work, "-B", work / "build", "-G", "Ninja",
                          f"-DCMAKE_PREFIX_PATH={prefix}"], work,
                         installed.environment(prefix) | (more or {}), expect)
    return " ".join(said.split())


def expect_text(said, *wanted):
    """All the texts are there."""
    for text in wanted:
        tree.check(text in said, f"\"{text}\" is not in: {said}")


def check_dependency(installed):
    """A library of the system that is missing is named with its package; an optional component
    that needs it is left out."""
    work = installed.work("no_unicorn")
    # A pkg-config that knows libpcap only.
    (work / "libpcap.pc").write_text("Name: libpcap\nDescription: x\nVersion: 1\n")
    env = {"PKG_CONFIG_LIBDIR": str(work)}
    expect_text(configure(installed, installed.prefix, "REQUIRED COMPONENTS sim", 1, "C CXX", env),
                'component "sim" needs unicorn (Debian: libunicorn-dev)')
    if installed.has_systemc():
        expect_text(configure(installed, installed.prefix, "REQUIRED COMPONENTS systemc", 1,
                              "C CXX", env),
                    'component "systemc" needs', "(Debian: lib")
    expect_text(configure(installed, installed.prefix,
                          "REQUIRED COMPONENTS driver OPTIONAL_COMPONENTS sim systemc",
                          languages="C CXX", more=env), "result: 1; TRUE; --")


def test(installed):
    """A tree with the driver alone, and the whole one."""
    driver_only = installed.work("driver_only") / "prefix"
    installed.install(driver_only, "driver")
    expect_text(configure(installed, driver_only, "REQUIRED COMPONENTS driver"),
                "result: 1; TRUE; ")
    expect_text(configure(installed, driver_only, "REQUIRED COMPONENTS sim driver", 1),
                'no component "sim" here; installed are: driver')
    expect_text(configure(installed, driver_only, "REQUIRED COMPONENTS wheel", 1),
                'no component "wheel" here; installed are: driver')
    expect_text(configure(installed, driver_only, "COMPONENTS driver OPTIONAL_COMPONENTS sim"),
                "result: 1; TRUE; ")
    expect_text(configure(installed, driver_only, "REQUIRED"), "result: 1; TRUE; ")
    expect_text(configure(installed, installed.prefix, "REQUIRED", languages="C CXX"),
                "result: 1; TRUE; TRUE")
    major, minor, _ = installed.project_version().split(".")
    expect_text(configure(installed, driver_only, f"{major}.{int(minor) + 1} REQUIRED", 1),
                f"requested version \"{major}.{int(minor) + 1}\"")
    check_dependency(installed)


tree.main(test)

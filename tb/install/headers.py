# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.headers_compile_alone: each installed header is enough by itself.
"""usage: headers.py SOURCE BUILD SANITIZED"""
import concurrent.futures

import tree

WARNINGS = ["-Wall", "-Wextra", "-Werror", "-fsyntax-only"]


def compile_alone(installed, include, header, language, package):
    """One header as the whole translation unit. A header of the simulator is found as its users
    write it: relative to the include directory."""
    env = installed.environment()
    flags = installed.run(["pkg-config", "--cflags", package], installed.root, env).split()
    name = header.relative_to(include)
    stub = installed.root / "work" / "headers" / f"{'_'.join(name.parts)}.{language[0]}"
    stub.write_text(f'#include "{name}"\n', encoding="utf-8")
    compiler, standard = {"cpp": ("g++", "-std=c++20"), "c99": ("gcc", "-std=c99")}[language]
    try:
        installed.run([compiler, standard, *WARNINGS, *flags, "-x",
                       "c++" if language == "cpp" else "c", stub], stub.parent, env)
    except tree.Failed as failure:
        return f"{name} does not compile alone:\n{failure}"
    return None


def test(installed):
    """All of include/: the simulator's as C++, the driver's as C99 and as C++."""
    include = installed.prefix / "include"
    installed.work("headers")
    jobs = []
    for header in sorted((include / "vericansim").rglob("*.hpp")):
        folder = header.relative_to(include / "vericansim").parts[0]
        package = "vericansystemc" if folder == "systemc" else "vericansim"
        jobs.append((include / "vericansim", header, "cpp", package))
    tree.check(len(jobs) > 40, f"only {len(jobs)} headers in {include}")
    for header in sorted((include / "verican").rglob("*.h")):
        jobs += [(include, header, "c99", "verican-driver"),
                 (include, header, "cpp", "verican-driver")]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        failures = list(filter(None, pool.map(lambda job: compile_alone(installed, *job), jobs)))
    tree.check(not failures, "\n".join(failures))
    print(f"{len(jobs)} headers compile alone")


tree.main(test)

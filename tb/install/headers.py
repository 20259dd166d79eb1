# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test install.headers_compile_alone: each installed header is enough by itself.
"""usage: headers.py SOURCE BUILD SANITIZED

A header whose source file includes it first was compiled alone by the build; here the others are.
All of them together are compiled against the installed tree, and what they include must be there,
so that none needs a file that only the build has.
"""
import concurrent.futures
import re

import tree

FLAGS = ["-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
COMPILERS = {"cpp": ["g++", "-std=c++20", "-x", "c++"], "c99": ["gcc", "-std=c99", "-x", "c"]}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def compile_together(installed, names, language, package):
    """One translation unit that includes `names`; empty, or what the compiler says."""
    env = installed.environment()
    flags = installed.run(["pkg-config", "--cflags", package], installed.root, env).split()
    text = "".join(f'#include "{name}"\n' for name in names)
    stub = installed.root / "work" / "headers" / f"{abs(hash((text, language))):x}.txt"
    stub.write_text(text, encoding="utf-8")
    try:
        installed.run([*COMPILERS[language], *FLAGS, *flags, stub], stub.parent, env)
    except tree.Failed as failure:
        return f"{', '.join(map(str, names))} as {language}:\n{failure}"
    return ""


def compiled_by_the_build(installed, name):
    """True if the source file of the same name includes this header before anything else."""
    source = installed.source / "sim" / name.with_suffix(".cpp")
    if not source.exists():
        return False
    includes = re.findall(r'^#include (\S+)', source.read_text(encoding="utf-8"), re.MULTILINE)
    return includes[:1] == [f'"{name}"']


def check_includes(include, headers):
    """What a header includes with quotes is installed beside it or in one of the two folders."""
    for header in headers:
        for name in INCLUDE.findall(header.read_text(encoding="utf-8")):
            places = (header.parent, include, include / "vericansim")
            tree.check(any((place / name).is_file() for place in places),
                       f"{header} includes {name}, which is not installed")


def test(installed):
    """All of include/: the simulator's as C++, the driver's as C99 and as C++."""
    include = installed.prefix / "include"
    installed.work("headers")
    sim = sorted((include / "vericansim").rglob("*.hpp"))
    driver = sorted((include / "verican").rglob("*.h"))
    tree.check(len(sim) > 40 and len(driver) > 1, f"only {len(sim)} + {len(driver)} headers")
    check_includes(include, sim + driver)
    jobs = [([header.relative_to(include)], language, "verican-driver")
            for header in driver for language in COMPILERS]
    parts = {"vericansim": [], "vericansystemc": []}
    for header in sim:
        name = header.relative_to(include / "vericansim")
        package = "vericansystemc" if name.parts[0] == "systemc" else "vericansim"
        parts[package].append(name)
        if not compiled_by_the_build(installed, name):
            jobs.append(([name], "cpp", package))
    jobs += [(names, "cpp", package) for package, names in parts.items() if names]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        failures = list(filter(None, pool.map(lambda job: compile_together(installed, *job), jobs)))
    tree.check(not failures, "\n".join(failures))
    print(f"{len(sim) + len(driver)} headers, {len(jobs)} compilations")


tree.main(test)

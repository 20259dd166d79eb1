#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Program for VERICAN_RTL_TRANSFORM (cmake/verilate.cmake): RTL with mutants in it.
"""usage: transform.py OUT.v TOP [Name=value ...] [--keep FILE ...] -- FILE...

Environment: VERICAN_MUTANT_LIST names a file with the list of mutants that run.py has written, or
is "module": all mutants of TOP.
"""
import json
import os
import pathlib
import re
import sys

from mutants import Design
from schemata import Wrap, open_types, package, rewrite, with_program


def with_parameters(text, parameters):
    """The top with other defaults of its parameters."""
    for parameter in parameters:
        name, value = parameter.split("=", 1)
        text, count = re.subn(rf"(parameter\s+\w+\s+(?:\[[^]]*\]\s*)?{name}\s*=\s*)[^,\n]+",
                              rf"\g<1>{value}", text,
                              count=1)
        if count != 1:
            sys.exit(f"transform.py: the top has no parameter {name}")
    return text


def number_mutants(design, top, listing):
    """Gives their numbers to the mutants of the list, or to all of the module at the top."""
    if listing == "module":
        numbers = {mutant.name: number for number, mutant in enumerate(
            (mutant for mutant in design.candidates() if mutant.module == top), 1)}
    else:
        numbers = json.loads(pathlib.Path(listing).read_text(encoding="utf-8"))
    for mutant in design.candidates():
        mutant.number = numbers.get(mutant.name, 0)


def main():
    split = sys.argv.index("--")
    out, top, *rest = sys.argv[1:split]
    keep = rest.index("--keep") if "--keep" in rest else len(rest)
    kept = {pathlib.Path(name).stem for name in rest[keep + 1:]} | {"can_pkg"}
    design = Design(sys.argv[split + 1:])
    number_mutants(design, top, os.environ["VERICAN_MUTANT_LIST"])
    count = max(mutant.number for mutant in design.candidates())
    texts = [package(count)]
    for file in design.files:
        if file.module in kept:
            continue
        text = open_types(file.module, rewrite(file, Wrap()))
        if file.module == top:
            text = with_program(with_parameters(text, rest[:keep]), count)
        texts.append(text)
    pathlib.Path(out).write_text("\n".join(texts), encoding="utf-8")


main()

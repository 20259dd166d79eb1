#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""svd_check.py FILE: whether a CMSIS-SVD file is valid.

Its form is judged by xmllint with tools/svd/cmsis-svd.rng, and with Arm's own schema too if the
environment variable CMSIS_SVD_XSD names it (CMSIS-SVD.xsd of the CMSIS pack); its sense by this
script: names are unique, fields do not overlap and fit into their register, registers do not
overlap unless they say so and lie in the address block, reset values fit into the fields.

Exit status 1 with one line for each thing that is wrong, 2 if it cannot be judged.
"""
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

RELAX_NG = Path(__file__).resolve().parent / "svd/cmsis-svd.rng"


def lint(option, schema, path):
    """xmllint's complaints."""
    try:
        result = subprocess.run(["xmllint", "--noout", option, schema, path], text=True,
                                capture_output=True, check=False)
    except FileNotFoundError:
        sys.exit("svd_check: xmllint is not here (Debian package libxml2-utils)")
    return result.stderr.splitlines() if result.returncode else []


def number(node, tag, default=None):
    text = node.findtext(tag)
    return default if text is None else int(text, 0)


def check_names(nodes, where):
    seen = set()
    for node in nodes:
        name = node.findtext("name")
        if name in seen:
            yield f"{where}: {name} is there twice"
        seen.add(name)


def check_fields(register, where):
    """Problems of the fields of a register; reserved bits reset to 0."""
    used = 0
    fields = register.findall("fields/field")
    yield from check_names(fields, where)
    for field in fields:
        name, low, high = field.findtext("name"), number(field, "lsb"), number(field, "msb")
        mask = (1 << (high + 1)) - (1 << low)
        if not 0 <= low <= high <= 31:
            yield f"{where}.{name}: bits {high}:{low} are not in a word of 32 bits"
        if used & mask:
            yield f"{where}.{name}: overlaps another field"
        used |= mask
        for value in field.findall("enumeratedValues/enumeratedValue"):
            if number(value, "value", 0) >= 1 << (high - low + 1):
                yield f"{where}.{name}: value {value.findtext('name')} does not fit"
    if number(register, "resetValue", 0) & ~used and not register.findtext("alternateRegister"):
        yield f"{where}: the reset value has ones in reserved bits"


def words_of(node):
    """The offsets of the node's words, of all entries of an array."""
    own = [0]
    if node.tag == "cluster":
        own = [word for part in parts(node) for word in words_of(part)]
    first, stride = number(node, "addressOffset"), number(node, "dimIncrement", 0)
    return [first + entry * stride + word for entry in range(number(node, "dim", 1))
            for word in own]


def parts(node):
    return [child for child in node if child.tag in ("register", "cluster")]


def check_parts(node, where, size):
    """Problems of the registers and clusters in `size` bytes."""
    owners = {}
    yield from check_names(parts(node), where)
    names = [part.findtext("name") for part in parts(node)]
    for part in sorted(parts(node), key=lambda one: number(one, "addressOffset")):
        name, words = f"{where}.{part.findtext('name')}", words_of(part)
        if part.tag == "register":
            yield from check_fields(part, name)
        else:
            yield from check_parts(part, name, number(part, "dimIncrement", 1 << 32))
        alternate = part.findtext("alternateRegister")
        if alternate and alternate not in names:
            yield f"{name}: alternate of {alternate}, which is not there"
        other = next((owners[word] for word in words if word in owners), None)
        if other and not alternate:
            yield f"{name}: overlaps {other}"
        owners.update((word, name) for word in words)
        if max(words) + 4 > size:
            yield f"{name}: ends at {max(words) + 4:#x}, behind {size:#x}"


def problems(path):
    yield from lint("--relaxng", RELAX_NG, path)
    arm = os.environ.get("CMSIS_SVD_XSD")
    if arm:
        yield from lint("--schema", arm, path)
    try:
        root = ET.parse(path).getroot()
    except ET.ParseError as error:
        yield f"{path}: no XML: {error}"
        return
    for peripheral in root.findall("peripherals/peripheral"):
        size = max(number(block, "offset") + number(block, "size")
                   for block in peripheral.findall("addressBlock"))
        yield from check_parts(peripheral.find("registers"), peripheral.findtext("name"), size)


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_file():
        print(__doc__.splitlines()[0] + " There is no such file.", file=sys.stderr)
        return 2
    found = list(problems(sys.argv[1]))
    for line in found:
        print(line, file=sys.stderr)
    if not found:
        arm = os.environ.get("CMSIS_SVD_XSD", "")
        print(f"{sys.argv[1]}: valid CMSIS-SVD" + (f", also by {arm}" if arm else ""))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The flip-flops of a top for the soft-error campaign (docs/soft-errors.md): their list, a
# Verilator configuration that opens them to C++, and C++ that knows where they are.
"""usage: flops.py OUT_VLT OUT_INC SCRATCH_DIR TOP NAME=VALUE[,NAME=VALUE] FILE...

Two tools find the flip-flops independently of each other and must agree variable by variable and
bit by bit: Yosys' front end (what synthesis makes of the RTL) and Verilator's (what the simulation
keeps). Bits that Yosys' optimisation then removes, because they are constant or read by nobody, are
none in silicon and are left out; what is left is the list.
"""
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from collections import defaultdict

MEMORY = "mem"  # the arrays of can_mb_ram: not flip-flops
CELL = re.compile(r"cell \$_[A-Z]*DFF[A-Z]*_")
PIN_Q = re.compile(r"connect \\Q (\S+)(?: \[(\d+)\])?$")


def run(command, log):
    with open(log, "w", encoding="utf-8") as out:
        if subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, check=False).returncode:
            sys.exit(f"flops.py: {command[0]} failed, see {log}")


def yosys(script, scratch, name):
    path = f"{scratch}/{name}.ys"
    with open(path, "w", encoding="utf-8") as out:
        out.write(script)
    run(["yosys", "-q", "-s", path], f"{scratch}/{name}.log")


def mark_cells(text):
    """Gives each flip-flop cell the attribute flop="variable:bit"; returns text and what is there.

    A wire of one bit has no index in the text; its bit is 0."""
    lines, bits = text.split("\n"), defaultdict(set)
    out = []
    for number, line in enumerate(lines):
        if CELL.search(line):
            match = next(m for m in map(lambda t: PIN_Q.search(t.strip()),
                                        lines[number:number + 9]) if m)
            if match[1].startswith("\\"):  # others are ports of memories, gone after opt
                variable, bit = match[1][1:], int(match[2] or 0)
                bits[variable].add(bit)
                out.append(f'  attribute \\flop "{variable}:{bit}"')
        out.append(line)
    return "\n".join(out), bits


def from_yosys(files, top, parameters, scratch):
    """All flip-flops, and those that are left after optimisation: {variable: {bit, ...}}."""
    values = " ".join(f"-chparam {name} {value}" for name, value in parameters)
    yosys(f"read_verilog -sv {' '.join(files)}\nhierarchy -check -top {top} {values}"
          "\nproc\nflatten\nsimplemap t:$dff t:$adff t:$dffe t:$adffe t:$sdff\n"
          f"write_rtlil {scratch}/all.il\n", scratch, "all")
    with open(f"{scratch}/all.il", encoding="utf-8") as source:
        text, everything = mark_cells(source.read())
    with open(f"{scratch}/marked.il", "w", encoding="utf-8") as out:
        out.write(text)
    # Without opt_merge: of two flip-flops that are always equal both must flip, or none is flipped.
    remove = "opt_expr\nopt_dff\nopt_clean\n" * 4
    yosys(f"read_rtlil {scratch}/marked.il\n{remove}write_json {scratch}/real.json\n", scratch,
          "real")
    with open(f"{scratch}/real.json", encoding="utf-8") as source:
        cells = json.load(source)["modules"][top]["cells"]
    real = defaultdict(set)
    for name, cell in cells.items():
        if "DFF" in cell["type"]:
            if "flop" not in cell["attributes"]:
                sys.exit(f"flops.py: {name} is a flip-flop without a name in the RTL")
            variable, bit = cell["attributes"]["flop"].split(":")
            real[variable].add(int(bit))
    return everything, real


def widths(root):
    """{id of a type: bits}, of the types that a flip-flop can have."""
    types = {node.get("id"): node for node in root.find(".//typetable")}

    def bits(node):
        if node.tag == "basicdtype":
            if node.get("left") is None:
                return 1
            return abs(int(node.get("left")) - int(node.get("right"))) + 1
        return bits(types[node.get("sub_dtype_id")]) if node.get("sub_dtype_id") else 0

    return {key: bits(node) for key, node in types.items()}


def target(node):
    """The variable that an assignment ends in, the last child of a nonblocking one."""
    left = list(node)[-1]
    references = [left] if left.tag == "varref" else list(left.iter("varref"))
    if left.tag == "concat":
        return [r.get("name") for r in references]
    return [references[0].get("name")]


def from_verilator(files, top, parameters, scratch):
    """{path of the variable: bits}, {path: module}, of all that is assigned at a clock edge."""
    path = f"{scratch}/rtl.xml"
    run(["verilator", "--xml-only", "--xml-output", path, "-Mdir", scratch, "-Wno-lint",
         "-Wno-style", "--top-module", top, *(f"-G{name}={value}" for name, value in parameters),
         *files], f"{scratch}/xml.log")
    root = xml.parse(path).getroot()
    width = widths(root)
    modules = {module.get("name"): read_module(module, width)
               for module in root.find("netlist").iter("module")}
    bits, origin = {}, {}

    def walk(cell, prefix):
        original, assigned, places = modules[cell.get("submodname")]
        for name, size in assigned.items():
            if name.split(".")[-1] != MEMORY:
                bits[prefix + name] = size
                origin[prefix + name] = original
        for inner in cell.findall("cell"):
            walk(inner, f"{prefix}{places[inner.get('name')]}.")

    walk(root.find("cells").find("cell"), "")
    return bits, origin


def read_module(module, width):
    """A module's name in the RTL, {variable that is assigned at a clock edge: bits}, and {instance:
    its name with those of the generate blocks around it}."""
    variables, places, assigned = {}, {}, {}

    def declared(node, scope):
        for child in node:
            if child.tag == "var":
                variables[(*scope, child.get("name"))] = width[child.get("dtype_id")]
            elif child.tag == "instance":
                places[child.get("name")] = ".".join((*scope, child.get("name")))
            declared(child, inside(child, scope))

    def clocked(node, scope):
        for child in node:
            if child.tag == "assigndly":
                for name in target(child):
                    place = next((*scope[:n], name) for n in range(len(scope), -1, -1)
                                 if (*scope[:n], name) in variables)
                    assigned[".".join(place)] = variables[place]
            clocked(child, inside(child, scope))

    declared(module, ())
    clocked(module, ())
    return module.get("origName"), assigned, places


def inside(node, scope):
    """The generate blocks around what is in a node."""
    block = node.get("name", "") if node.tag == "begin" else ""
    return (*scope, block) if block.startswith("gen_") else scope


def compare(everything, real, bits):
    """Both tools must have found the same bits. Yosys' front end also makes registers of the local
    variables of a clocked block, which nobody reads afterwards: they must all have gone."""
    wrong = [f"{name}: only Yosys" for name in real if name not in bits]
    wrong += [f"{name}: only Verilator" for name in bits if name not in everything]
    wrong += [f"{name}: {len(everything[name])} bits in Yosys, {bits[name]} in Verilator"
              for name in bits if name in everything and len(everything[name]) != bits[name]]
    if wrong:
        sys.exit("flops.py: the lists differ:\n  " + "\n  ".join(wrong))


def main():
    if len(sys.argv) < 7:
        sys.exit(__doc__)
    out_vlt, out_inc, scratch, top = sys.argv[1:5]
    parameters = [word.split("=", 1) for word in sys.argv[5].split(",")]
    files = sys.argv[6:]
    everything, real = from_yosys(files, top, parameters, scratch)
    bits, origin = from_verilator(files, top, parameters, scratch)
    compare(everything, real, bits)
    opened = sorted({(origin[name], name.split(".")[-1]) for name in real})
    with open(out_vlt, "w", encoding="utf-8") as out:
        out.write("`verilator_config\n")
        for module, variable in opened:
            out.write(f'public_flat_rw -module "{module}" -var "{variable}"\n')
        out.write(f'public_flat_rw -module "can_mb_ram" -var "{MEMORY}"\n')
    with open(out_inc, "w", encoding="utf-8") as out:
        out.write("// Generated by flops.py: FLOP(name, member, bits that are flip-flops).\n")
        for name in sorted(real):
            member = f"{top}__DOT__" + name.replace(".", "__DOT__")
            member = member.replace("[", "__BRA__").replace("]", "__KET__")
            mask = sum(1 << bit for bit in real[name])
            out.write(f'FLOP("{name}", {member}, 0x{mask:X}ULL)\n')
    print(f"{top}: {sum(map(len, real.values()))} flip-flops in {len(real)} variables; "
          f"{sum(bits.values())} bits before optimisation, Yosys and Verilator agree")


main()

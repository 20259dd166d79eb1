#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The flip-flops of the core for the soft-error campaign (docs/soft-errors.md): their list, a
# Verilator configuration that opens them to C++, and C++ that knows where they are.
"""usage: flops.py OUT_VLT OUT_INC SCRATCH_DIR NUM_MB MODEL FILE...

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

TOP = "can_ahb"
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


def from_yosys(files, num_mb, scratch):
    """All flip-flops, and those that are left after optimisation: {variable: {bit, ...}}."""
    yosys(f"read_verilog -sv {' '.join(files)}\nhierarchy -check -top {TOP} -chparam NumMb {num_mb}"
          "\nproc\nflatten\nsimplemap t:$dff t:$adff t:$dffe t:$adffe t:$sdff\n"
          f"write_rtlil {scratch}/all.il\n", scratch, "all")
    with open(f"{scratch}/all.il", encoding="utf-8") as source:
        text, everything = mark_cells(source.read())
    with open(f"{scratch}/marked.il", "w", encoding="utf-8") as out:
        out.write(text)
    yosys(f"read_rtlil {scratch}/marked.il\nopt\nopt_clean\nwrite_json {scratch}/real.json\n",
          scratch, "real")
    with open(f"{scratch}/real.json", encoding="utf-8") as source:
        cells = json.load(source)["modules"][TOP]["cells"]
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


def from_verilator(files, num_mb, scratch):
    """{path of the variable: bits}, {path: module}, of all that is assigned at a clock edge."""
    path = f"{scratch}/rtl.xml"
    run(["verilator", "--xml-only", "--xml-output", path, "-Mdir", scratch, "-Wno-lint",
         "-Wno-style", "--top-module", TOP, f"-GNumMb={num_mb}", *files], f"{scratch}/xml.log")
    root = xml.parse(path).getroot()
    width = widths(root)
    modules = {}
    for module in root.find("netlist").iter("module"):
        assigned = {name for node in module.iter("assigndly") for name in target(node)}
        variables = {v.get("name"): width[v.get("dtype_id")] for v in module.iter("var")}
        modules[module.get("name")] = (module.get("origName"), assigned, variables)
    bits, origin = {}, {}

    def walk(cell, prefix):
        original, assigned, variables = modules[cell.get("submodname")]
        for name in assigned - {MEMORY}:
            bits[prefix + name] = variables[name]
            origin[prefix + name] = original
        for inner in cell.findall("cell"):
            walk(inner, f"{prefix}{inner.get('name')}.")

    walk(root.find("cells").find("cell"), "")
    return bits, origin


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
    out_vlt, out_inc, scratch, num_mb, model = sys.argv[1:6]
    files = sys.argv[6:]
    everything, real = from_yosys(files, num_mb, scratch)
    bits, origin = from_verilator(files, num_mb, scratch)
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
            member = f"{TOP}__DOT__" + name.replace(".", "__DOT__")
            mask = sum(1 << bit for bit in real[name])
            out.write(f'FLOP("{name}", {member}, 0x{mask:X}ULL)\n')
    print(f"{model}: {sum(map(len, real.values()))} flip-flops in {len(real)} variables; "
          f"{sum(bits.values())} bits before optimisation, Yosys and Verilator agree")


main()

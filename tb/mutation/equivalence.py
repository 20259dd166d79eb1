#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Proves that a mutant changes nothing: yosys makes a miter of original and mutant, abc proves it.
"""Tries a mutant in its own module, its submodules cut off, and then in what surrounds it.

A proof holds from every start that a reset can follow, for all inputs: outputs (and what goes to
submodules that were cut off) are equal in every clock, for ever. No proof means nothing.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import models
from mutants import Design
from schemata import rewrite

# Tops to try, from inside to outside; only those that hold the mutated module.
TOPS = ["can_bsp", "can_core", "can_mailbox", "can_regs", "can_top"]
RAM = "can_mb_ram"      # cut off always: what goes into it must be equal
# Defaults that are changed for a proof, as Yosys 0.23 cannot take can_mailbox with -chparam: few
# buffers, and, so that no block is left out of both proofs, the features that the defaults have
# and that they have not.
BUILDS = {"the defaults": {"NumMb": (64, 16)},
          "the other features": {"NumMb": (64, 16), "OwnMasks": (1, 0), "TimeUnit": (0, 1),
                                 "TimeSync": (0, 1)}}
CELL = """
module can_ram_cell #(parameter int Depth = 64, localparam int AddrW = $clog2(Depth)) (
  input logic clk_i, input logic re_i, input logic [AddrW-1:0] raddr_i, output logic [31:0] rdata_o,
  input logic [3:0] we_i, input logic [AddrW-1:0] waddr_i, input logic [31:0] wdata_i);
endmodule
"""
# Address and data count where they are read or written.
USED = """
module can_mb_ram #(parameter int Depth = 64, parameter InitFile = "",
  localparam int AddrW = $clog2(Depth)) (
  input logic clk_i, input logic re_i, input logic [AddrW-1:0] raddr_i, output logic [31:0] rdata_o,
  input logic [3:0] we_i, input logic [AddrW-1:0] waddr_i, input logic [31:0] wdata_i);
  can_ram_cell #(.Depth(Depth)) u_cell (.clk_i, .re_i, .raddr_i(re_i ? raddr_i : '0), .rdata_o,
    .we_i, .waddr_i(we_i != '0 ? waddr_i : '0),
    .wdata_i(wdata_i & {{8{we_i[3]}}, {8{we_i[2]}}, {8{we_i[1]}}, {8{we_i[0]}}}));
endmodule
"""


class Plain:
    """One mutant alone, without a selector; None: the original."""

    def __init__(self, wanted):
        self.wanted = wanted

    def __call__(self, mutants, inside, _):
        return f"({self.wanted.mutated})" if self.wanted in mutants else inside

    def test(self, mutant, _):
        """The condition under which its statement does not happen."""
        return "1'b1" if mutant is self.wanted else "1'b0"


def children(design, module):
    """Modules that it instantiates."""
    text = next(file.text for file in design.files if file.module == module)
    return [file.module for file in design.files
            if file.module != module and not file.package and f"  {file.module} " in text]


def script(design, directory, top, cut):
    """Yosys' commands: gold and gate, flat, with equal inputs; one output: they differ."""
    lines = []
    cut = ["can_ram_cell"] + [module for module in cut if module != RAM]
    for side in ("gold", "gate"):
        files = " ".join(str(directory / side / file.path.name) for file in design.files)
        lines += ["design -reset", f"read_verilog -sv {files}", f"hierarchy -top {top}",
                  "proc", "rename -top top_under_proof"]
        lines += [f"blackbox *{module}*" for module in cut]
        lines += ["flatten", "expose -evert top_under_proof/t:*can_*", "delete =A:blackbox",
                  "opt -full", "memory", "async2sync", "dffunmap", "opt_clean",
                  f"rename top_under_proof {side}", f"design -stash {side}"]
    lines += ["design -reset", "design -copy-from gold gold", "design -copy-from gate gate",
              "miter -equiv -flatten gold gate bad_miter", "hierarchy -top bad_miter",
              "setundef -undriven -zero", "setundef -init -zero", "opt -full", "techmap",
              "opt -fast", "dffunmap", "abc -g AND -fast", "opt_clean",
              "write_aiger -zinit miter.aig"]
    return "\n".join(lines) + "\n"


def with_defaults(text, build):
    """A module's text with other defaults of its parameters."""
    for name, (before, after) in BUILDS[build].items():
        text = re.sub(rf"(parameter int {name} *= ){before}\b", rf"\g<1>{after}", text)
    return text


def builds_of(design, top):
    """The builds in which the parameters of a top and of what is below it are not the same."""
    files = [file.text for file in design.files if file.module in inside(design, top)]
    found = {}
    for build in BUILDS:
        found.setdefault(tuple(with_defaults(text, build) for text in files), build)
    return list(found.values())


def prove_in_all(design, mutant, top, cut, seconds, show):
    """Whether it is proven in each build: what one does not hold, it says nothing of."""
    for build in builds_of(design, top):
        result, text = prove(design, mutant, (top, cut, build), seconds)
        show(top, build, cut, result, text)
        if not result:
            return False
    return True


def prove(design, mutant, where, seconds):
    """Of (top, cut off, build): True if abc has proven it, False if it has found a difference, None
    if neither."""
    top, cut, build = where
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        for side, wanted in (("gold", None), ("gate", mutant)):
            (directory / side).mkdir()
            for file in design.files:
                text = with_defaults(rewrite(file, Plain(wanted)), build)
                if file.module == RAM and top != RAM:
                    text = CELL + USED
                (directory / side / file.path.name).write_text(text, encoding="utf-8")
        (directory / "miter.ys").write_text(script(design, directory, top, cut), encoding="utf-8")
        built = subprocess.run(["yosys", "-q", "miter.ys"], cwd=directory, capture_output=True,
                               text=True)
        if built.returncode != 0:
            return None, built.stdout[-500:] + built.stderr[-500:]
        commands = f"read_aiger miter.aig; strash; scorr; dc2; scorr; print_stats; pdr -T {seconds}"
        proof = subprocess.run(["yosys-abc", "-c", commands], cwd=directory, capture_output=True,
                               text=True).stdout
    if "Property proved" in proof or "is trivially" in proof or " 0 and" in proof:
        return True, proof
    if "Output 0 of miter" in proof or "was asserted" in proof:
        return False, proof
    return None, proof


def inside(design, top):
    """All modules below a top, and itself."""
    found, new = {top}, [top]
    while new:
        new = [child for module in new for child in children(design, module)
               if child not in found]
        found.update(new)
    return found


def users(design, mutant):
    """Modules that name the constant of a package in which the mutant is; all that name the package
    if that has a use for the constant itself."""
    package = next(file for file in design.files if file.module == mutant.module)
    name = re.search(r"(\w+)\s*=", mutant.line_text)
    alone = name and len(re.findall(rf"\b{name[1]}\b", package.text)) == 1
    text = rf"\b{mutant.module}::" + (rf"{name[1]}\b" if alone else "")
    return {file.module for file in design.files if re.search(text, file.text)}


def attempts(design, mutant):
    """(top, cut off) to try, small ones first. A package's constant may be used anywhere: in
    can_top, or there is nothing to prove."""
    if mutant.module.endswith("_pkg"):
        if users(design, mutant) <= inside(design, "can_top"):
            yield "can_top", [RAM]
        return
    local = children(design, mutant.module)
    yield mutant.module, local
    if mutant.module == RAM:            # elsewhere it would be cut off, mutant and all
        return
    if local and local != [RAM] and mutant.module not in TOPS:
        yield mutant.module, [RAM]
    for top in TOPS:
        if mutant.module in inside(design, top) and (top != mutant.module or local):
            yield top, [RAM]


def proof_of(design, mutant, seconds, show=lambda *_: None):
    """Where the mutant is proven to change nothing, in words; None if it is not."""
    mutant.number = mutant.number or 1
    for top, cut in attempts(design, mutant):
        if prove_in_all(design, mutant, top, cut, seconds, show):
            return f"in {top}" + (f" without {', '.join(cut)}" if cut else "")
    return None


def main():
    """Entry point."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mutant", nargs="+", help="such as can_fault:57.12:a")
    parser.add_argument("--seconds", type=int, default=60, help="limit of one proof")
    parser.add_argument("-v", action="store_true", help="show what abc says")
    options = parser.parse_args()
    design = Design(models.rtl_files())
    everything = {mutant.name: mutant for mutant in design.candidates()}
    for name in options.mutant:
        if name not in everything:
            sys.exit(f"equivalence.py: {name}: no such mutant")
        mutant = everything[name]
        show = print if options.v else lambda *_: None
        where = proof_of(design, mutant, options.seconds, show)
        print(f"{name}  {mutant.shown()}: "
              + (f"proven equivalent {where}" if where else "nothing proven"), flush=True)


if __name__ == "__main__":
    main()

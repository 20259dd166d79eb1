#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""usage: simulated.py RTL_DIR OUT_DIR PART [MODULE...]

Writes copies of the RTL of a part into OUT_DIR in which the properties of its proofs are assertions
for a simulator: what a proof assumes of the other blocks, and the lemmas of its induction, must
hold in the whole. Without MODULEs it prints the modules that there are, one a line."""

import pathlib
import re
import sys

import yaml

from runner.model import spliced

# Of the proof alone: how it begins, from any content of the flip-flops.
PROOF_ONLY = re.compile(r"^\s*m_(reset|no_reset|may): assume", re.MULTILINE)
PROPERTIES = "always @(posedge clk_i) begin"
# Proofs of one set of parameters, of which the assumptions alone hold for all, and when: if
# somebody looks at the request.
ASSUMPTIONS = {"can_rn_check": "!(can_remote.make || can_remote.block || can_remote.data)"
                               " && (can_remote.request"
                               " || can_remote.job == can_rn_pkg::JobBegin)"}


def simulated(module, text):
    """Properties of a module as a simulator takes them: in reset nothing is looked at."""
    lines = [line for line in text.splitlines(True) if not PROOF_ONLY.match(line)]
    text = "".join(lines).replace("always @(posedge clk_i) f_ran <= 1'b1;",
                                  "always @(posedge clk_i) f_ran <= rst_ni;")
    at = text.rindex(PROPERTIES)
    when = "rst_ni"
    if module in ASSUMPTIONS:
        when += f" && {ASSUMPTIONS[module]}"
        text = text[:text.index("    if (f_ran) begin")] + "  end\n"
    return text[:at] + text[at:].replace(PROPERTIES, f"{PROPERTIES[:-5]}if ({when}) begin", 1)


def properties(part):
    """File with properties by module; of several proofs of a module, that of the first."""
    proofs = yaml.safe_load((part / "proofs.yaml").read_text("utf-8"))["proofs"]
    found = {}
    for proof in proofs:
        for module, files in proof.get("splice", {}).items():
            found.setdefault(module, files)
    return found


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    rtl, out, name, *modules = sys.argv[1:]
    part = pathlib.Path(__file__).parent / name
    found = properties(part)
    if not modules:
        print("\n".join(sorted(found)))
    for module in modules:
        source = pathlib.Path(rtl) / name / f"{module}.sv"
        text = (part / found[module]).read_text("utf-8")
        target = pathlib.Path(out) / source.name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(spliced(source.read_text("utf-8"), module, simulated(module, text)),
                          encoding="utf-8")


if __name__ == "__main__":
    main()

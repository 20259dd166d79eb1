# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Writes RTL that holds many mutants, of which a number in the environment selects one.
"""rewrite() returns the text of a file with its mutants.

package() and with_program() select: for each mutant 0 (off), 1 (on) or 2 (recording), so that it
costs one comparison. When the model records, no mutant is active: it notes which of them would have
made a difference. A test in which a mutant makes none cannot tell it from the original.
"""
import re

PACKAGE = """package can_mutant;
  logic [1:0] on [0:%d];
endpackage
"""

PROGRAM = """
`systemc_header
#include <bitset>
#include <cstdlib>
#include <fstream>
#ifndef VERICAN_MUTANTS
#define VERICAN_MUTANTS
// Written at the end of the program, one number a line.
struct VericanMutants {
  const char *name = std::getenv("VERICAN_MUTANT_RECORD");
  std::bitset<65536> seen;
  ~VericanMutants() {
    if (name == nullptr) return;
    std::ofstream file(name);
    for (int i = 0; i < 65536; ++i) if (seen[i]) file << i << '\\n';
  }
};
inline VericanMutants verican_mutants;
inline int verican_mutant(int number) {
  static const char *selected = std::getenv("VERICAN_MUTANT");
  if (verican_mutants.name != nullptr) return 2;
  return selected != nullptr && number != 0 && std::atoi(selected) == number;
}
inline bool verican_seen(int number, bool differs) {
  if (differs) verican_mutants.seen[number] = true;
  return false;
}
#endif
`verilog
  initial begin
    for (int i = 0; i <= %d; i++) can_mutant::on[i] = 2'($c32("verican_mutant(", i, ")"));
  end
"""


def package(count):
    """The package that chooses among mutants 1 to count; before all modules."""
    return PACKAGE % count


def with_program(text, count):
    """The top, which fills in the package."""
    return text.replace("endmodule", PROGRAM % count + "endmodule")


class Wrap:
    """Joins an expression and its mutants."""

    @staticmethod
    def test(mutant, differs):
        """Is this mutant the one?"""
        on = f"can_mutant::on[{mutant.number}]"
        return (f"({on} != 0 && ({on} == 1 || "
                f'$c1("verican_seen({mutant.number},", ({differs}), ")")))')

    def __call__(self, mutants, inside, original):
        """The expression; mutants that are not in this model have number 0."""
        out = inside
        for mutant in mutants:
            if mutant.number:
                # Wide enough for a carry that the context may keep.
                differs = f"(64'd0 | ({mutant.mutated})) != (64'd0 | ({original}))"
                out = f"({self.test(mutant, differs)} ? ({mutant.mutated}) : {out})"
        return out if out is inside else f"({out})"


def rewrite(file, wrap):
    """Text of a file with its mutants, joined by a Wrap."""
    edits = []                                # (start, end, text); insertions have start = end
    for site in file.sites:
        node = site.node
        shown = node.render(file.text, wrap)
        if node.kind == "port" and shown != node.source(file.text):
            shown = f"{node.value}{shown}"
        dropped = site.dropped if site.role == "value" else None
        if dropped and dropped.number:
            start, end = site.statement
            edits.append((start, start, f"begin if (!({wrap.test(dropped, 1)})) "))
            edits.append((end, end, " end"))
        edits.append((node.start, node.end, shown))
    out, at = [], 0
    for start, end, text in sorted(edits, key=lambda edit: (edit[0], edit[1])):
        out += [file.text[at:start], text]
        at = end
    return "".join(out) + file.text[at:]


MASKS = ("Reset", "Any", "Freeze", "Disable", "WrnEn", "Has", "Without")


def open_types(module, text):
    """What a mutant cannot be written for otherwise.

    States are plain vectors, for a mutant may be no state. can_reg's masks are inputs, for a
    constant that a mutant changes is none any more.
    """
    states = re.search(r"typedef enum (logic \[\d:0\]) \{[^}]*\} (state_[et]);", text)
    if states:
        text = re.sub(rf"\b{states.group(2)} +(?=\w+(, \w+)*;)", f"{states.group(1)} ", text)
    if module == "can_reg":
        ports = "".join(f"  input  logic [31:0] {name},\n" for name in MASKS)
        text = re.sub(r"module can_reg #\(.*?\n\) \(\n",
                      lambda _: f"module can_reg (\n{ports}  input  logic SoftReset,\n", text,
                      flags=re.DOTALL)
        text = text.replace("localparam logic [31:0] Stored =", "wire [31:0] Stored =")
    else:
        text = re.sub(r"can_reg #\(([^;]*?)\s*\) (u_\w+) \(", masks_connected, text)
    return text


def masks_connected(match):
    """An instance of can_reg: parameters that it leaves out are zero, but Has."""
    given = match.group(1)
    missing = "".join(f" .{name}('{int(name == 'Has')})," for name in MASKS + ("SoftReset",)
                      if f".{name}(" not in given)
    return f"can_reg {match.group(2)} ({given},{missing}"

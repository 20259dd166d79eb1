# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The mutants of the RTL: every change that one of the kinds below can make, and a sample of them.
"""Design reads the RTL; Design.candidates() are all its mutants, choose() takes some of each."""
import hashlib
import pathlib
import re

from sv_module import read_module
from sv_tree import line_of

COMPARED = {"==", "!=", "<", "<=", ">", ">="}
NEIGHBOUR = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
SWAPPED = {"+": "-", "-": "+", "&": "|", "|": "&", "^": "|", "<<": ">>", ">>": "<<",
           "&&": "||", "||": "&&"}
CONSTANT = re.compile(r"localparam\s+(?:logic|int)\s*(?:\[[^\]]*\])?\s*(\w+)\s*=\s*([^;]+);")
SIZED = re.compile(r"(\d+)'([bodh])([0-9a-fA-F_]+)$")
BASES = {"b": 2, "o": 8, "d": 10, "h": 16}


class Mutant:
    """One change: where it is, what stood there and what stands there instead."""

    def __init__(self, module, line, column, kind, original, mutated):
        self.module, self.line, self.column, self.kind = module, line, column, kind
        self.original, self.mutated = " ".join(original.split()), mutated
        self.line_text = ""                 # that line of the RTL
        self.occurrence = 1                 # the first such change of such a line in the file
        self.name, self.number = "", 0      # the number selects it in a model

    def draw(self, seed):
        """A random number for the choice; lines above may move without changing it."""
        text = f"{seed}:{self.module}:{self.line_text}:{self.original}:{self.mutated}"
        return hashlib.sha256(text.encode()).hexdigest(), self.line, self.column

    def shown(self):
        """The change in one line."""
        return f"{self.original}  ->  {' '.join(self.mutated.split())}"


def other_numbers(text):
    """Numbers near to a literal, as literals of the same width."""
    if text in ("'0", "'1"):
        return ["'1" if text == "'0" else "'0"]
    match = SIZED.match(text)
    if not match:
        return [str(int(text) + 1)] + ([str(int(text) - 1)] if int(text) else [])
    width, base = int(match.group(1)), match.group(2)
    value = int(match.group(3).replace("_", ""), BASES[base])
    if base == "d":
        near = [(value + 1) % (1 << width), (value - 1) % (1 << width)]
    else:
        near = [value ^ 1, value ^ (1 << (width - 1))]
    return [f"{width}'h{number:X}" for number in dict.fromkeys(near) if number != value]


class File:
    """One file of RTL with its sites and mutants."""

    def __init__(self, path):
        self.path, self.module = path, path.stem
        self.text = path.read_text(encoding="utf-8")
        self.package = self.module.endswith("_pkg")
        self.sites = [] if self.package else read_module(self.text)
        self.mutants = []

    def add(self, node, kind, mutated, holder=None):
        """Notes a mutant of a node, or of a statement."""
        start, end = holder or (node.start, node.end)
        line = line_of(self.text, start)
        column = start - self.text.rfind("\n", 0, start)
        mutant = Mutant(self.module, line, column, kind, self.text[start:end], mutated)
        self.mutants.append(mutant)
        if holder is None:
            node.mutants.append(mutant)
        return mutant

    def find(self):
        """Fills in all mutants of this file."""
        for site in self.sites:
            site.dropped = None
            if site.role == "value":
                self.value(site)
                self.expression(site.node, False)
            elif site.role == "condition":
                self.condition(site.node)
                self.expression(site.node, True)
            elif site.role == "input":
                self.connection(site.node)
            elif site.role == "label" and site.node.kind == "number":
                self.number(site.node)

    def value(self, site):
        """A value that is never assigned, or assigned constantly."""
        source = site.node.source(self.text)
        if site.statement:
            site.dropped = self.add(site.node, "assignment dropped", "", site.statement)
            return
        for level in ("'0", "'1"):
            if source != level and not (source in ("1'b0", "1'b1") and level[1] == source[3]):
                self.add(site.node, "value stuck", level)

    def condition(self, node):
        """A condition that always or never holds."""
        self.add(node, "condition stuck", "1'b1")
        self.add(node, "condition stuck", "1'b0")

    def connection(self, node):
        """An input that gets something else."""
        source = node.source(self.text)
        if node.kind != "number":
            self.add(node, "input inverted", f"~({source})")
            self.add(node, "input tied", "'0")
        self.expression(node, False, root=False)

    def number(self, node):
        """A number next to the right one."""
        for other in other_numbers(node.source(self.text)):
            self.add(node, "constant", other)

    def expression(self, node, truth, root=True):
        """All mutants inside of an expression; truth: only zero or not counts."""
        if node.kind == "number" and not (truth and root):
            self.number(node)
        if node.kind == "binary":
            self.binary(node)
        elif node.kind == "unary":
            self.unary(node)
        elif node.kind == "ternary":
            self.ternary(node)
        elif truth and node.kind in ("name", "select") and node.source(self.text)[0] != "'":
            self.add(node, "condition negated", f"!({node.source(self.text)})")
        logical = node.kind == "binary" and node.value in ("&&", "||")
        for operand in node.operands:
            inner = (logical or (node.kind == "group" and truth)
                     or (node.kind == "ternary" and operand is node.operands[0]))
            if not (node.kind in ("select", "slice") and operand.kind == "name"):
                self.expression(operand, inner, root=False)

    def binary(self, node):
        """Another operator, or one operand alone."""
        left, right = (operand.source(self.text) for operand in node.operands)
        operator = node.value
        if operator in SWAPPED:
            self.add(node, "operator", f"({left}) {SWAPPED[operator]} ({right})")
        if operator in NEIGHBOUR:
            self.add(node, "comparison", f"({left}) {NEIGHBOUR[operator]} ({right})")
        if operator in COMPARED:
            self.add(node, "condition negated", f"!({node.source(self.text)})")
        if operator in ("&&", "||", "&", "|", "^"):
            self.add(node, "operand dropped", left)
            self.add(node, "operand dropped", right)

    def unary(self, node):
        """No inversion; AND for OR."""
        inner = node.operands[0].source(self.text)
        if node.value in ("!", "~"):
            self.add(node, "inversion removed", inner)
        elif node.value in ("&", "|", "^"):
            self.add(node, "operator", f"{SWAPPED[node.value]}{inner}")

    def ternary(self, node):
        """The wrong arm."""
        for arm in node.operands[1:]:
            self.add(node, "choice stuck", arm.source(self.text))


class Design:
    """All files of the RTL and their mutants; modules: only theirs are candidates."""

    def __init__(self, paths, modules=None):
        self.files = [File(pathlib.Path(path)) for path in paths]
        self.part = [file for file in self.files if modules is None or file.module in modules]
        for file in self.files:
            file.find()
        for package in (file for file in self.files if file.package):
            self.constants(package)
        for file in self.files:
            self.give_names(file)

    def constants(self, package):
        """Constants of a package: mutated wherever they are used, if no tool needs them fixed."""
        uses = {}
        for file in self.files:
            for site in file.sites:
                for node in site.node.walk():
                    if node.kind == "name" and node.value.startswith(package.module + "::"):
                        uses.setdefault(node.value, []).append(node)
        everything = "".join(file.text for file in self.files)
        for match in CONSTANT.finditer(package.text):
            name = f"{package.module}::{match.group(1)}"
            nodes = uses.get(name, [])
            if not nodes or len(re.findall(rf"\b{name}\b", everything)) != len(nodes):
                continue
            for other in self.other_constants(match.group(2).strip()):
                start = match.start(1)
                mutant = Mutant(package.module, line_of(package.text, start),
                                start - package.text.rfind("\n", 0, start), "constant",
                                f"{match.group(1)} = {match.group(2).strip()}", other)
                package.mutants.append(mutant)
                for node in nodes:
                    node.mutants.append(mutant)

    @staticmethod
    def other_constants(text):
        """Values for a constant: of a mask each bit in it once, of others its neighbours."""
        match = SIZED.match(text)
        if not match or int(match.group(1)) != 32:
            return other_numbers(text)
        value = int(match.group(3).replace("_", ""), 16)
        return [f"32'h{value ^ (1 << bit):08X}" for bit in range(32)]

    @staticmethod
    def give_names(file):
        """module:line.column:letter, unique in the module."""
        seen, lines = {}, file.text.split("\n")
        for mutant in file.mutants:
            mutant.line_text = " ".join(lines[mutant.line - 1].split())
            same = (mutant.line_text, mutant.original, mutant.mutated)
            mutant.occurrence = seen[same] = seen.get(same, 0) + 1
            place = f"{file.module}:{mutant.line}.{mutant.column}"
            count = seen.get(place, 0)
            seen[place] = count + 1
            mutant.name = f"{place}:{chr(ord('a') + count % 26)}{count // 26 or ''}"

    def candidates(self):
        """All mutants."""
        return [mutant for file in self.part for mutant in file.mutants]


def choose(design, wanted, seed):
    """About `wanted` mutants: of each file in proportion to what it offers, of small ones more.

    With the same seed fewer mutants are a part of more.
    """
    floor = 10
    offers = {file.module: file.mutants for file in design.part}
    total = sum(len(mutants) for mutants in offers.values())
    spare = max(wanted - sum(min(floor, len(m)) for m in offers.values()), 0)
    chosen = []
    for module, mutants in offers.items():
        share = min(floor, len(mutants)) + round(spare * len(mutants) / total)
        if wanted < floor * len(offers):
            share = max(1, round(wanted / len(offers)))
        chosen += sorted(mutants, key=lambda mutant: mutant.draw(seed))[:share]
    for number, mutant in enumerate(chosen, 1):
        mutant.number = number
    return chosen

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Finds the expressions and assignments of a module: the places where a mutant can sit.
"""read_module() returns the sites of one file of RTL."""
import re

from sv_tree import Node, Reader, Syntax, line_of, parse_expression


FUNCTION = re.compile(r"function\s+automatic\s[^;(]*?(\w+)\s*\(")
CONSTANT = re.compile(r"\blocalparam\b[^;]*;")
FEATURE = re.compile(r"if \((\w+) != 0\) begin :")
EITHER = re.compile(r"if \((\w+) == 0\) begin :")
# Parameters that choose between two ways to build a module, and what all models of a run have.
CHOSEN = {"ByteWise": 0, "PresdivWidth": 8}
# Those of which there are models of both ways.
BOTH = {"Pipelined"}


class Site:
    """A place of the text that may be mutated.

    role: condition (of if), selector (of case), label (of case), value (assigned), target (left of
    an assignment: only its index), input (connection of an input port).
    timing: always_ff, always_comb, assign or function, for values.
    """

    def __init__(self, role, node, timing="", statement=None):
        self.role, self.node, self.timing = role, node, timing
        # Extent of the whole assignment, without its semicolon, if it can be dropped.
        self.statement = statement


class ModuleReader:
    """Walks over one module and collects its sites."""

    def __init__(self, text):
        self.text, self.reader, self.sites = text, Reader(text), []

    def read(self):
        """All sites, in the order of the text."""
        reader = self.reader
        while reader.peek() != "module":
            reader.take()
        reader.skip_past(";")
        while reader.peek() != "endmodule":
            self.item()
        return self.sites

    def item(self):
        """One item of a module."""
        reader = self.reader
        word = reader.peek()
        if word == "assign":
            reader.take()
            self.assignment("assign")
        elif word in ("always_ff", "always_comb"):
            reader.take()
            if word == "always_ff":
                reader.take("@")
                reader.take("(")
                reader.skip_past(")")
            self.statement(word)
        elif word == "function":
            self.function()
        elif word == "if" and FEATURE.match(self.text, reader.tokens[reader.at].start):
            self.feature()
        elif word == "if" and self.chooses():
            self.either()
        elif word == "if":                  # checks of parameters
            while reader.take().text != "end":
                pass
        elif word == "for":
            self.loop()
        elif word.startswith("can_") and "_pkg::" not in word:
            self.instance()
        else:                               # declarations
            reader.skip_past(";")

    def feature(self):
        """What a core has with a feature, and what without: no model of a run lacks one, so that
        the mutants are those of the first."""
        reader = self.reader
        both = FEATURE.match(self.text, reader.tokens[reader.at].start).group(1) in BOTH
        self.block()
        if reader.peek() == "else":
            sites = len(self.sites)
            self.block()
            if not both:
                del self.sites[sites:]

    def chooses(self):
        """The parameter of CHOSEN that the coming `if` compares with 0; None if there is none."""
        match = EITHER.match(self.text, self.reader.tokens[self.reader.at].start)
        return match.group(1) if match and match.group(1) in CHOSEN else None

    def either(self):
        """Two ways to build a module: the mutants are those of the one that the models have."""
        first = CHOSEN[self.chooses()] == 0
        before = len(self.sites)
        self.block()
        middle = len(self.sites)
        self.block()
        if first:
            del self.sites[middle:]
        else:
            del self.sites[before:middle]

    def loop(self):
        """A loop of instances, one place in the text for all of them: no mutants."""
        reader = self.reader
        while reader.take().text != "begin":
            pass
        depth = 1
        while depth > 0:
            word = reader.take().text
            depth += (word in ("begin", "case")) - (word in ("end", "endcase"))

    def block(self):
        """The items of a labelled block."""
        reader = self.reader
        while reader.take().text != ":":
            pass
        reader.take()
        while reader.peek() != "end":
            self.item()
        reader.take()

    def function(self):
        """A function; one of constants is worked out before the simulation: no mutants."""
        reader = self.reader
        name = FUNCTION.match(self.text, reader.take().start).group(1)
        constants = "".join(CONSTANT.findall(self.text))
        if re.search(rf"\b{name}\s*\(", constants):
            while reader.peek() != "endfunction":
                reader.take()
        else:
            reader.skip_past(";")
            while reader.peek() != "endfunction":
                self.statement("function")
        reader.take()

    def instance(self):
        """An instance of another module: its input connections."""
        reader = self.reader
        reader.take()
        if reader.peek() == "#":
            reader.take()
            self.connections("parameter")
        reader.take()
        self.connections("input")
        reader.take(";")

    def connections(self, role):
        """A list of connections in brackets."""
        reader = self.reader
        reader.take("(")
        while reader.peek() != ")":
            reader.take(".")
            name = reader.take()
            node = None
            if reader.peek() == "(":
                reader.take()
                if reader.peek() != ")":
                    node = parse_expression(reader)
                reader.take(")")
            else:
                node = Node("port", name.text, [], name.start, name.end)
            wanted = name.text.endswith("_i") and name.text not in ("clk_i", "rst_ni")
            if node and (role == "parameter" or wanted):
                self.sites.append(Site(role, node))
            if reader.peek() == ",":
                reader.take()
        reader.take(")")

    def statement(self, timing):
        """One statement."""
        reader = self.reader
        word = reader.peek()
        if word == "begin":
            reader.take()
            if reader.peek() == ":":
                reader.take()
                reader.take()
            while reader.peek() != "end":
                self.statement(timing)
            reader.take()
        elif word == "if":
            self.branch(timing)
        elif word in ("case", "unique"):
            self.cases(timing)
        elif word == "for":
            reader.take()
            reader.take("(")
            reader.skip_past(")")
            self.statement(timing)
        elif word == "logic":
            reader.skip_past(";")
        elif word == ";":
            reader.take()
        else:
            self.assignment(timing)

    def branch(self, timing):
        """if and else."""
        reader = self.reader
        reader.take("if")
        reader.take("(")
        condition = parse_expression(reader)
        reader.take(")")
        if condition.source(self.text) != "!rst_ni":
            self.sites.append(Site("condition", condition))
        self.statement(timing)
        if reader.peek() == "else":
            reader.take()
            self.statement(timing)

    def cases(self, timing):
        """case with its labels."""
        reader = self.reader
        if reader.peek() == "unique":
            reader.take()
        reader.take("case")
        reader.take("(")
        self.sites.append(Site("selector", parse_expression(reader)))
        reader.take(")")
        while reader.peek() != "endcase":
            if reader.peek() == "default":
                reader.take()
            else:
                self.sites.append(Site("label", parse_expression(reader)))
                while reader.peek() == ",":
                    reader.take()
                    self.sites.append(Site("label", parse_expression(reader)))
            reader.take(":")
            self.statement(timing)
        reader.take()

    def assignment(self, timing):
        """One assignment, blocking or not."""
        reader = self.reader
        target = self.target()
        op = reader.take()
        if op.text not in ("=", "<="):
            raise Syntax(f"line {line_of(self.text, op.start)}: no assignment: {op.text!r}")
        value = parse_expression(reader)
        end = reader.take(";")
        if target.source(self.text).startswith("unused"):
            return                          # for lint alone: nobody reads it
        self.sites.append(Site("target", target))
        extent = (target.start, end.end) if timing == "always_ff" else None
        self.sites.append(Site("value", value, timing, extent))

    def target(self):
        """Left side of an assignment; `<=` after it is no comparison."""
        from sv_tree import parse_postfix, parse_primary
        return parse_postfix(self.reader, parse_primary(self.reader))


def read_module(text):
    """Sites of the one module in the text of a file."""
    return ModuleReader(text).read()

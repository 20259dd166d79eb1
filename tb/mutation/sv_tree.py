# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Expressions of the RTL's subset of SystemVerilog as trees that know their place in the text.
"""parse_expression() reads one expression; Node.render() writes it with its mutants in it."""
import re

TOKEN = re.compile(r"""
    (?P<skip>\s+|//[^\n]*|/\*.*?\*/|\(\*.*?\*\)|`ifndef\ SYNTHESIS\n.*?\n`endif)
  | (?P<number>\d*'[bodh][0-9a-fA-F_]+|'[01](?![0-9])|\d+)
  | (?P<name>[A-Za-z_$][\w$]*(?:::[A-Za-z_]\w*)*)
  | (?P<string>"[^"\n]*")
  | (?P<op>\|\||&&|==|!=|<=|>=|<<|>>|~\^|\+:|-:|\+\+|\*\*|[-+*/%&|^~!<>=?:;,.(){}\[\]'@\#])
""", re.VERBOSE | re.DOTALL)

BINARY = {"||": 1, "&&": 2, "|": 3, "^": 4, "&": 5, "==": 6, "!=": 6, "<": 7, "<=": 7, ">": 7,
          ">=": 7, "<<": 8, ">>": 8, "+": 9, "-": 9, "*": 10, "/": 10, "%": 10}
UNARY = {"!", "~", "&", "|", "^", "-", "+"}


class Syntax(Exception):
    """The text is not of the subset that is understood."""


class Token:
    """One token: kind (number, name, op), text and place."""

    def __init__(self, kind, text, start):
        self.kind, self.text, self.start, self.end = kind, text, start, start + len(text)


def tokens_of(text):
    """All tokens of a file; comments, attributes and what is for simulation only are no tokens."""
    out, at = [], 0
    while at < len(text):
        match = TOKEN.match(text, at)
        if not match:
            raise Syntax(f"line {line_of(text, at)}: not understood: {text[at:at + 20]!r}")
        if match.lastgroup != "skip":
            out.append(Token(match.lastgroup, match.group(), at))
        at = match.end()
    return out


def line_of(text, at):
    """Number of the line that holds the character."""
    return text.count("\n", 0, at) + 1


class Node:
    """An expression: kind, operator or name, operands, place in the text, mutants.

    kind: number, name, call, cast, select (operands: base, index), slice, concat, group, unary,
    binary, ternary, port (a connection without an expression of its own).
    """

    def __init__(self, kind, value, operands, start, end):
        self.kind, self.value, self.operands = kind, value, operands
        self.start, self.end, self.mutants = start, end, []

    def source(self, text):
        """The expression as it stands in the file."""
        return text[self.start:self.end]

    def render(self, text, wrap):
        """The expression with all its mutants.

        wrap(mutants, inside, original) joins them; inside has the mutants of the operands.
        """
        out, at = [], self.start
        for operand in self.operands:
            out += [text[at:operand.start], operand.render(text, wrap)]
            at = operand.end
        plain = "".join(out) + text[at:self.end]
        return wrap(self.mutants, plain, self.source(text)) if self.mutants else plain

    def walk(self):
        """This node and all below it."""
        yield self
        for operand in self.operands:
            yield from operand.walk()


class Reader:
    """Tokens with a position."""

    def __init__(self, text):
        self.text, self.tokens, self.at = text, tokens_of(text), 0

    def peek(self, ahead=0):
        """Text of a coming token; empty at the end."""
        at = self.at + ahead
        return self.tokens[at].text if at < len(self.tokens) else ""

    def take(self, expected=None):
        """The next token, which must be the expected one."""
        if self.at >= len(self.tokens):
            raise Syntax("the file ends too early")
        token = self.tokens[self.at]
        if expected is not None and token.text != expected:
            raise Syntax(f"line {line_of(self.text, token.start)}: {expected!r} expected, "
                         f"{token.text!r} found")
        self.at += 1
        return token

    def skip_past(self, text):
        """Leaves the reader behind the next such token outside of brackets."""
        depth = 0
        while True:
            token = self.take().text
            if depth == 0 and token == text:
                return
            depth += (token in "([{") - (token in ")]}")


def parse_expression(reader, limit=0):
    """An expression whose binary operators bind tighter than limit."""
    left = parse_unary(reader)
    while True:
        op = reader.peek()
        if op == "?" and limit == 0:
            reader.take()
            then = parse_expression(reader)
            reader.take(":")
            other = parse_expression(reader)
            left = Node("ternary", "?", [left, then, other], left.start, other.end)
        elif op in BINARY and BINARY[op] > limit:
            reader.take()
            right = parse_expression(reader, BINARY[op])
            left = Node("binary", op, [left, right], left.start, right.end)
        else:
            return left


def parse_unary(reader):
    """A unary operator and its operand, or an operand with its selects."""
    if reader.peek() in UNARY:
        op = reader.take()
        operand = parse_unary(reader)
        return Node("unary", op.text, [operand], op.start, operand.end)
    return parse_postfix(reader, parse_primary(reader))


def parse_primary(reader):
    """A number, a name, a group or a concatenation."""
    token = reader.take()
    if token.kind in ("number", "name"):
        return Node(token.kind, token.text, [], token.start, token.end)
    if token.text == "(":
        inner = parse_expression(reader)
        return Node("group", "(", [inner], token.start, reader.take(")").end)
    if token.text == "{":
        parts = [parse_expression(reader)]
        if reader.peek() == "{":           # replication: the count stays as it is
            inner = parse_primary(reader)
            return Node("concat", "{", [inner], token.start, reader.take("}").end)
        while reader.peek() == ",":
            reader.take()
            parts.append(parse_expression(reader))
        return Node("concat", "{", parts, token.start, reader.take("}").end)
    raise Syntax(f"line {line_of(reader.text, token.start)}: unexpected {token.text!r}")


def parse_postfix(reader, node):
    """Selects, calls and casts behind an operand."""
    while True:
        following = reader.peek()
        if following == "[":
            reader.take()
            index = parse_expression(reader)
            if reader.peek() in (":", "+:", "-:"):
                kind = reader.take().text
                parse_expression(reader)               # constant
                end = reader.take("]").end
                parts = [node] if kind == ":" else [node, index]
                node = Node("slice", kind, parts, node.start, end)
            else:
                node = Node("select", "[", [node, index], node.start, reader.take("]").end)
        elif following == "'" and reader.peek(1) == "(":
            reader.take()
            reader.take()
            inner = parse_expression(reader)           # the width before it is constant
            node = Node("cast", "'", [inner], node.start, reader.take(")").end)
        elif following == "(" and node.kind == "name":
            reader.take()
            parts = [parse_expression(reader)]
            while reader.peek() == ",":
                reader.take()
                parts.append(parse_expression(reader))
            node = Node("call", node.value, parts, node.start, reader.take(")").end)
        else:
            return node

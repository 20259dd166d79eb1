#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes a C++ file that holds a text file as a string:
#   embed_text.py TEXT OUT.cpp HEADER FUNCTION
# OUT.cpp includes HEADER and defines std::string_view vericansim::FUNCTION(). TEXT may be empty
# ("-": the function gives an empty text).
import pathlib
import sys

WIDTH = 12_000  # characters of one literal; the compiler joins neighbours


def literal(data: bytes) -> str:
    """`data` as a C string literal; octal escapes of three digits never run into what follows."""
    plain = set(range(0x20, 0x7F)) - {ord('"'), ord("\\"), ord("?")}
    return '"' + "".join(chr(b) if b in plain else f"\\{b:03o}" for b in data) + '"'


def main() -> None:
    source, out, header, function = sys.argv[1:]
    data = b"" if source == "-" else pathlib.Path(source).read_bytes()
    parts = [data[i:i + WIDTH] for i in range(0, len(data), WIDTH)] or [b""]
    text = "\n".join(literal(part) for part in parts)
    pathlib.Path(out).write_text(
        f'// Written by cmake/embed_text.py.\n#include "{header}"\n\nnamespace vericansim {{\n'
        f"namespace {{\nconstexpr char kText[] =\n{text};\n}}\n"
        f"std::string_view {function}() {{ return {{kText, sizeof kText - 1}}; }}\n}}\n",
        encoding="ascii")


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of words as SVG: two rows of 16 bits, fields coloured by who may write them."""
CELL, ROW, LEFT, TOP = 56, 34, 4, 16   # pixels: a bit's width, a row's height, margins
COLOURS = {"any": "#d8f0d8", "freeze": "#d6e6fa", "disable": "#f6e2c4", "wrn_en": "#e8dcf6",
           "clear": "#fbf3b0", "read": "#f1f1f1", "reserved": "#c9c9c9"}
FONT = 'font-family="sans-serif" text-anchor="middle"'

HEAD = """\
<!-- SPDX-FileCopyrightText: 2026 The VeriCAN authors
     SPDX-License-Identifier: Apache-2.0
     Written by tools/registers.py from sw/registers.yaml; edits are lost. -->
"""


def colour(part):
    if part.access in ("w1c", "rc"):
        return COLOURS["clear"]
    return COLOURS["read" if part.access == "ro" else part.write]


def label(part, high, low):
    """The name, with its bits where the cell shows only some of them."""
    if (high, low) == (part.high, part.low):
        return part.name
    return f"{part.name}[{high - part.low}:{low - part.low}]"


def lines_of(text, width):
    """One line, or two at an underscore, for a cell of that many bits."""
    if len(text) <= 8 * width or "_" not in text:
        return [text]
    head, tail = text.rsplit("_", 1)
    return [head + "_", tail]


def cell(row, high, low, text, fill):
    """The box of bits high to low (0 to 15) of a row."""
    x, y = LEFT + (15 - high) * CELL, TOP + row * (ROW + TOP)
    width = (high - low + 1) * CELL
    yield (f'<rect x="{x}" y="{y}" width="{width}" height="{ROW}" fill="{fill}" '
           'stroke="#333"/>')
    lines = lines_of(text, high - low + 1)
    for index, line in enumerate(lines):
        dy = 21 + 13 * index - 6.5 * (len(lines) - 1)
        size = 10 if len(line) > 6 * (high - low + 1) else 11
        yield (f'<text x="{x + width / 2:g}" y="{y + dy:g}" font-size="{size}" {FONT}>'
               f'{line}</text>')


def numbers(row):
    """The bit numbers above a row."""
    y = TOP + row * (ROW + TOP) - 4
    for bit in range(16):
        x = LEFT + (15 - bit) * CELL + CELL / 2
        yield (f'<text x="{x:g}" y="{y}" font-size="9" fill="#555" {FONT}>'
               f'{bit + 16 * (1 - row)}</text>')


def row_cells(row, fields):
    """The boxes of one half of the word: row 0 is bits 31 to 16."""
    base = 16 * (1 - row)
    bit = 15
    while bit >= 0:
        part = next((one for one in fields if one.low <= base + bit <= one.high), None)
        if part:
            low = max(part.low - base, 0)
            yield from cell(row, bit, low, label(part, base + bit, base + low), colour(part))
        else:
            low = max([one.high - base + 1 for one in fields if one.high < base + bit] + [0])
            yield from cell(row, bit, max(low, 0), "", COLOURS["reserved"])
        bit = max(low, 0) - 1


def render(fields):
    """The SVG of a word with these fields."""
    width, height = 16 * CELL + 2 * LEFT, 2 * (ROW + TOP) + 4
    body = [f'<rect width="{width}" height="{height}" fill="white"/>']
    for row in (0, 1):
        body += [*numbers(row), *row_cells(row, fields)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}">\n{HEAD}' + "\n".join(body) + "\n</svg>\n")

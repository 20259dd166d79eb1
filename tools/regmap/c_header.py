# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The C header: macros for offsets, reset values, fields and their values; C99 and C++."""
from regmap.model import MORE_THAN_32, NUM_MB

PREFIX = "VERICAN_"

HEAD = """\
/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Register map of the {title}.
 * Written by tools/registers.py from sw/registers.yaml; edits are lost.
 *
 * {prefix}<REG>_OFFSET            byte offset from the base of the controller
 * {prefix}<REG>_RESET             value after the hard reset
 * {prefix}<REG>_<FIELD>_MASK      the field's bits in the word
 * {prefix}<REG>_<FIELD>_SHIFT     number of its lowest bit
 * {prefix}<REG>_<FIELD>_GET(word) the field's value in a word; of fields of several bits
 * {prefix}<REG>_<FIELD>_SET(value) a value, cut to the field's width, at its place in a word
 * {prefix}<REG>_<FIELD>_<NAME>    a value of the field, not shifted
 *
 * Registers of an array take the index: {prefix}MB_CS_OFFSET(n), {prefix}RXIMR_OFFSET(n).
 * Whether bits of IMASK, IFLAG, MB and RXIMR exist depends on XCONFIG.NUM_MB.
 */
#ifndef VERICAN_REGS_H
#define VERICAN_REGS_H

#include <stdint.h>

/* clang-format off */
"""


def comment(text):
    """A comment of as many lines as the text needs."""
    lines, line = [], "/*"
    for word in text.split():
        if len(line) + 1 + len(word) > 97:
            lines.append(line)
            line = "  "
        line += " " + word
    return lines + [line + " */"]


def define(name, value):
    """One macro, its value in the column of the others."""
    return f"#define {name:<39} {value}"


def field_macros(name, part):
    only = f" Only with {part.only_if}." if part.only_if else ""
    yield from comment(f"{part.name}: {part.doc}{only}")
    yield define(f"{name}_MASK", f"0x{part.mask:08X}u")
    yield define(f"{name}_SHIFT", f"{part.low}u")
    if part.width > 1:
        ones = f"0x{part.mask >> part.low:X}u"
        yield define(f"{name}_GET(word)", f"(((uint32_t)(word) >> {part.low}) & {ones})")
        yield define(f"{name}_SET(value)", f"(((uint32_t)(value) & {ones}) << {part.low})")
    for value in part.values:
        yield define(f"{name}_{value.name}", f"0x{value.value:X}u /* {value.doc} */")


def register_macros(prefix, register, offset):
    """`offset`: [(macro, value)], nothing for a layout without an address."""
    yield ""
    only = f" Only if {register.only_if}." if register.only_if == MORE_THAN_32 else \
        f" Only with {register.only_if}." if register.only_if else ""
    yield from comment(f"{register.name}: {register.title}.{only}")
    for macro, value in offset:
        yield define(macro, value)
    name = f"{prefix}{register.name}"
    if offset and not any(part.reset == NUM_MB for part in register.fields):
        yield define(f"{name}_RESET", f"0x{register.value('reset', 0):08X}u")
    for part in register.fields + register.overlay:
        yield from field_macros(f"{name}_{part.name}", part)


def array_offset(base, stride):
    return f"(0x{base:03X}u + {stride}u * (uint32_t)(n))"


def render(regmap):
    """The text of the header."""
    lines = HEAD.format(title=regmap.title, prefix=PREFIX).splitlines()
    for register in regmap.registers:
        name = f"{PREFIX}{register.name}"
        if register.count == 1:
            offset = [(f"{name}_OFFSET", f"0x{register.offset:03X}u")]
        else:
            offset = [(f"{name}_OFFSET(n)", array_offset(register.offset, register.stride))]
        lines += register_macros(PREFIX, register, offset)
    block = regmap.buffers
    name = f"{PREFIX}{block.name}_"
    lines += ["", *comment(f"{block.name}: {block.title}, words CS, ID, DATA0 and DATA1."),
              define(f"{name}OFFSET(n)", array_offset(block.offset, block.stride)),
              define(f"{name}STRIDE", f"{block.stride}u")]
    for word in regmap.words:
        offset = [(f"{name}{word.name}_OFFSET(n)",
                   array_offset(block.offset + word.offset, block.stride))]
        lines += register_macros(name, word, offset)
    lines += ["", *comment("Receive FIFO (MCR.FEN): filter word n, frames that fit."),
              define(f"{PREFIX}FIFO_FILTER_OFFSET(n)", array_offset(regmap.filter_offset, 4)),
              define(f"{PREFIX}FIFO_DEPTH", f"{regmap.fifo_depth}u")]
    for layout in regmap.formats:
        lines += register_macros(f"{PREFIX}FIFO_", layout, [])
    return "\n".join([*lines, "", "/* clang-format on */", "", "#endif /* VERICAN_REGS_H */", ""])

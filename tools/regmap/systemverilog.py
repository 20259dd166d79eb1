# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The SystemVerilog package: addresses, places of the fields, reset values and write masks."""
from regmap.model import LAST_MB, WRITES

HEAD = """\
// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_regs_pkg: the register map as constants. Written by tools/registers.py from
// sw/registers.yaml; edits are lost. <Reg>Addr counts words; <Reg><Field> is the lowest bit of a
// field and <Reg><Field>W its width, if it has more than one; <Reg><Field><Value> is a value that
// has a name; <Reg>Any, Freeze, Disable and WrnEn are the bits that a write changes at any time, in
// freeze mode, in disable mode, with MCR.WRN_EN.
// Of a core that says xconfig of itself: <reg>_has() are the bits that it has of a register,
// <reg>_without() is what those read that it has not.

package can_regs_pkg;
"""


def camel(name):
    """WAK_MSK -> WakMsk."""
    return "".join(part.capitalize() for part in name.split("_"))


def constant(kind, name, value, note=""):
    line = f"  localparam {kind:<12} {name:<17} = {value};"
    return line + (f"   // {note}" if note else "")


def hex_word(value):
    return f"32'h{value >> 16:04X}_{value & 0xFFFF:04X}"


def word(name, value):
    return constant("logic [31:0]", name, hex_word(value))


def function(name, first, terms):
    """`first`, and for each (condition, word) of `terms` the bits of the word."""
    yield f"  function automatic logic [31:0] {name}(input logic [31:0] xconfig);"
    yield f"    {name} = {first};"
    for condition, value in terms:
        yield f"    if ({condition}) {name} |= {value};"
    yield "  endfunction"


def without(part):
    """What a missing field reads, as a word; the number of buffers is XCONFIG[7:0]."""
    if part.without == LAST_MB:
        return "(xconfig & 32'h0000_00FF) - 32'd1" + (f" << {part.low}" if part.low else "")
    return hex_word(part.without << part.low)


def features(one, regmap):
    """The functions of a register of which some cores have only a part."""
    bits = {feature.config: one.feature_mask(feature.name, lambda part: part.writable)
            for feature in regmap.features}
    if one.only_if or not any(bits.values()):
        return
    name = one.name.lower()
    yield ""
    always = hex_word(~sum(bits.values()) & 0xFFFFFFFF)
    yield from function(f"{name}_has", always,
                        [(f"xconfig[Xconfig{camel(config)}]", hex_word(mask))
                         for config, mask in bits.items() if mask])
    constant_bits = [(f"!xconfig[Xconfig{camel(feature.config)}]", without(part))
                     for feature in regmap.features for part in one.fields
                     if part.only_if == feature.name and part.without]
    if constant_bits:
        yield from function(f"{name}_without", "'0", constant_bits)


def fields(prefix, parts):
    for part in parts:
        yield constant("int", f"{prefix}{camel(part.name)}", part.low)
        if part.width > 1:
            yield constant("int", f"{prefix}{camel(part.name)}W", part.width)
        for one in part.values:
            yield constant(f"logic [{part.width - 1}:0]", f"{prefix}{camel(part.name)}"
                           f"{camel(one.name)}", f"{part.width}'h{one.value:X}")


def register(one):
    name = camel(one.name)
    yield ""
    yield f"  // {one.name}: {one.title}"
    yield constant("logic [10:0]", f"{name}Addr", f"11'h{one.offset // 4:03X}")
    if one.count == 1:
        yield word(f"{name}Reset", one.value("reset", 0))
        for write in WRITES:
            mask = one.mask(lambda part, write=write: part.writable and part.write == write)
            if mask:
                yield word(f"{name}{camel(write)}", mask)
    yield from fields(name, one.fields + one.overlay)


def render(regmap):
    """The text of the package."""
    lines = HEAD.splitlines()
    for one in regmap.registers:
        lines += register(one)
    block = regmap.buffers
    lines += ["", f"  // {block.name}: {block.title}",
              constant("logic [10:0]", f"{camel(block.name)}Addr",
                       f"11'h{block.offset // 4:03X}")]
    for one in regmap.words:
        lines += fields(f"{camel(block.name)}{camel(one.name)}", one.fields + one.overlay)
    for one in regmap.registers:
        lines += features(one, regmap)
    return "\n".join([*lines, "endpackage", ""])

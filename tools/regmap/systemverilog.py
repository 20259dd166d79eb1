# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The SystemVerilog package: addresses, places of the fields, reset values and write masks."""
from regmap.model import WRITES

HEAD = """\
// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_regs_pkg: the register map as constants. Written by tools/registers.py from
// sw/registers.yaml; edits are lost. <Reg>Addr counts words; <Reg><Field> is the lowest bit of a
// field and <Reg><Field>W its width, if it has more than one; <Reg>Any, Freeze, Disable and WrnEn
// are the bits that a write changes at any time, in freeze mode, in disable mode, with MCR.WRN_EN.

package can_regs_pkg;
"""


def camel(name):
    """WAK_MSK -> WakMsk."""
    return "".join(part.capitalize() for part in name.split("_"))


def constant(kind, name, value, note=""):
    line = f"  localparam {kind:<12} {name:<17} = {value};"
    return line + (f"   // {note}" if note else "")


def word(name, value):
    return constant("logic [31:0]", name, f"32'h{value >> 16:04X}_{value & 0xFFFF:04X}")


def fields(prefix, parts):
    for part in parts:
        yield constant("int", f"{prefix}{camel(part.name)}", part.low)
        if part.width > 1:
            yield constant("int", f"{prefix}{camel(part.name)}W", part.width)


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
    return "\n".join([*lines, "endpackage", ""])

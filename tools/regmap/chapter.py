# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The register chapter, docs/registers.md, and its pictures."""
from regmap import picture
from regmap.model import MORE_THAN_32, NUM_MB

PAGE = "docs/registers.md"
PICTURES = "docs/img/registers"

HEAD = """\
<!-- Written by tools/registers.py from sw/registers.yaml; edits are lost ("make registers"). -->
# Registers

Source: [`sw/registers.yaml`](../sw/registers.yaml), from which this page, the constants of the RTL
([`can_regs_pkg`](../rtl/host/can_regs_pkg.sv)), the C header
([`verican_regs.h`](../sw/driver/include/verican/verican_regs.h)), the CMSIS-SVD file
([`verican.svd`](../sw/verican.svd)) and the table of the register tests are made.

{title}: words of 32 bits, little-endian, in a window of {window} KiB; bytes,
half words and words can be accessed, of the time unit words alone but for TCTRL and TSTAT. Grey
bits and offsets that are not listed are reserved: they read 0 and ignore writes.

**Access.** `rw` read and write; `ro` read only; `w1c` writing 1 clears, 0 does nothing; `rc`
reading clears; `w1s` writing 1 requests, and the bit clears itself; `wo` write only, reads 0.

**Written** says when a write counts; at other times it is ignored, without an error.

| colour | written | when |
|---|---|---|
| green | any | always |
| blue | freeze | in freeze mode: MCR.FRZ_ACK = 1 |
| orange | disable | in disable mode: MCR.LPM_ACK = 1 because of MCR.MDIS |
| violet | wrn_en | while MCR.WRN_EN = 1 |
| yellow | – | cleared by writing 1 (`w1c`) or by reading (`rc`) |
| light grey | – | read only |

**Reset** is the value after the hard reset. The soft reset (MCR.SOFT_RST) brings a register back
to it or keeps it, as the tables say; *state* is a bit that shows what is going on at any moment.

`NumMb` is the number of message buffers of the core, 16, 32 or 64; XCONFIG.NUM_MB tells. What is
there only with one of the core's [features](integration.md#features) says so: bits without their
feature are reserved, and XCONFIG tells which features the core has.
"""

RECIPES = """
## Recipes

Access by access, in the words of a scenario's [`accesses`](scenario.md#accesses), to be tried
as they are: `until REG MASK VALUE` reads until the bits of MASK are those of VALUE, `check`
says what they are then, `A..B` is every register from A to B. In C the [driver](driver.md) does all
this. What each bit, read and write does besides: the tables below.
"""

SUMMARY = """
## Overview

| offset | name | | reset | soft reset |
|---|---|---|---|---|
"""


def number(value):
    return value if value == NUM_MB else f"{value:#x}" if value > 9 else str(value)


def reset_word(register):
    if any(part.reset == NUM_MB for part in register.fields):
        return f"0x{register.value('reset', 0):08X} + NumMb"
    return f"0x{register.value('reset', 0):08X}"


def soft_reset(register):
    kept = {part.kept for part in register.fields}
    return "mixed" if len(kept) > 1 else "kept" if kept.pop() else "reset"


def offset_of(register):
    if register.count == 1:
        return f"0x{register.offset:03X}"
    return f"0x{register.offset:03X} + {register.stride} n"


def summary(regmap):
    block = regmap.buffers
    rows = [(one.offset, f"| {offset_of(one)} | [{one.name}](#{one.name.lower()}) | {one.title} "
                         f"| {reset_word(one)} | {soft_reset(one)} |")
            for one in regmap.registers]
    rows.append((block.offset, f"| {offset_of(block)} | [{block.name}](#message-buffers) "
                               f"| {block.title}: CS, ID, DATA0, DATA1 | 0x00000000 | kept |"))
    return SUMMARY + "\n".join(text for _, text in sorted(rows)) + "\n"


def values_of(part):
    return "".join(f"<br>{value.value} {value.name}: {value.doc}" for value in part.values)


def condition(part):
    """A sentence about a field that some cores do not have."""
    if not part.only_if:
        return ""
    return f" Only with {part.only_if}" + (f", reads {part.without} without." if part.without
                                           else ".")


def field_row(part):
    written = part.write if part.access in ("rw", "w1s", "wo") else "–"
    after = "state" if part.live and part.access == "ro" else "kept" if part.kept else "reset"
    return (f"| {part.bits} | {part.name} | {part.access} | {written} | {number(part.reset)} "
            f"| {after} | {part.doc}{values_of(part)}{condition(part)} |")


def image(name):
    return f"\n![Bits of {name}](img/registers/{name.lower()}.svg)\n"


def register_section(register, heading, anchor, where):
    text = [f"\n{heading} {register.name}\n\n{register.title}. {where}."]
    if register.only_if:
        word = "if" if register.only_if == MORE_THAN_32 else "with"
        text.append(f" Only {word} {register.only_if}; reserved otherwise.")
    if register.in_ram:
        text.append(" Without ClearRam undefined after a hard reset.")
    if register.per_buffer is not None:
        text.append(" Bits of buffers that the core does not have are reserved.")
    if register.read_effect:
        text.append(f"\n\n**A read has an effect:** {register.read_effect}")
    text.append("\n" + image(anchor))
    text.append("\n| bits | name | access | written | reset | soft reset | |\n"
                "|---|---|---|---|---|---|---|\n")
    text.append("\n".join(field_row(part) for part in register.fields) + "\n")
    if register.overlay:
        text.append(overlay(register))
    return "".join(text)


def overlay(register):
    rows = [f"| {part.bits} | {part.name} | {part.doc} |" for part in register.overlay]
    return "\nThe same bits, seen otherwise:\n\n| bits | name | |\n|---|---|---|\n" + \
        "\n".join(rows) + "\n"


def layout_section(layout):
    rows = [f"| {part.bits} | {part.name} | {part.doc} |" for part in layout.fields]
    return (f"\n### {layout.name}\n\n{layout.title}.\n" + image(layout.name) +
            "\n| bits | name | |\n|---|---|---|\n" + "\n".join(rows) + "\n" +
            (overlay(layout) if layout.overlay else ""))


def recipes_section(regmap):
    text = [f"\n### {one.title}\n\n{one.doc}\n\n```text\n{one.steps}```\n"
            for one in regmap.recipes]
    return RECIPES + "".join(text)


def buffers_section(regmap):
    block = regmap.buffers
    text = [f"\n## Message buffers\n\nBuffer n, n = 0 to NumMb - 1, has four words from offset "
            f"{offset_of(block)} on.\n\n{regmap.buffers_doc}\n"]
    for word in regmap.words:
        text.append(register_section(word, "###", f"mb_{word.name}",
                                     f"Offset 0x{block.offset + word.offset:03X} + "
                                     f"{block.stride} n, soft reset: kept"))
    return "".join(text)


def fifo_section(regmap):
    text = [f"\n## Filters of the receive FIFO\n\nWith MCR.FEN = 1 the FIFO, {regmap.fifo_depth} "
            "frames deep, has the place of the first buffers: its output is buffer 0, its filter "
            f"words begin at 0x{regmap.filter_offset:03X}. MCR.IDAM says how all of them are "
            "read.\n"]
    return "".join(text + [layout_section(layout) for layout in regmap.formats])


def render(regmap):
    """path -> text of the chapter and its pictures."""
    sections = [register_section(one, "##", one.name,
                                 f"Offset {offset_of(one)}, reset {reset_word(one)}")
                for one in regmap.registers]
    page = HEAD.format(title=regmap.title, window=regmap.window // 1024) + summary(regmap) + \
        recipes_section(regmap) + "".join(sections) + buffers_section(regmap) + fifo_section(regmap)
    files = {PAGE: page}
    words = [(one.name, one.fields) for one in regmap.registers + regmap.formats]
    words += [(f"mb_{one.name}", one.fields) for one in regmap.words]
    for name, fields in words:
        files[f"{PICTURES}/{name.lower()}.svg"] = picture.render(fields)
    return files

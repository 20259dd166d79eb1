# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The CMSIS-SVD file, for debuggers: one device with one controller of 64 buffers."""
import xml.etree.ElementTree as ET

from regmap.model import MORE_THAN_32, NUM_MB

BASE = 0x4005_0000  # of the fabric interface of a SmartFusion; edit for another system
BUFFERS = 64        # the largest core; XCONFIG.NUM_MB tells what a core has

HEAD = """\
<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-FileCopyrightText: 2026 The VeriCAN authors
     SPDX-License-Identifier: Apache-2.0
     Written by tools/registers.py from sw/registers.yaml; edits are lost. -->
"""

# access of the map -> access, modifiedWriteValues, readAction
ACCESS = {"rw": ("read-write", None, None), "ro": ("read-only", None, None),
          "w1c": ("read-write", "oneToClear", None), "rc": ("read-only", None, "clear"),
          "w1s": ("read-write", "oneToSet", None), "wo": ("write-only", None, None)}


def add(parent, tag, text=None):
    child = ET.SubElement(parent, tag)
    if text is not None:
        child.text = text if isinstance(text, str) else hex(text)
    return child


def add_field(parent, part):
    access, on_write, on_read = ACCESS[part.access]
    entry = add(parent, "field")
    add(entry, "name", part.name)
    add(entry, "description", part.doc + (f" (only with {part.only_if})" if part.only_if else ""))
    add(entry, "lsb", str(part.low))
    add(entry, "msb", str(part.high))
    add(entry, "access", access)
    if on_write:
        add(entry, "modifiedWriteValues", on_write)
    if on_read:
        add(entry, "readAction", on_read)
    if part.values:
        values = add(entry, "enumeratedValues")
        for value in part.values:
            one = add(values, "enumeratedValue")
            add(one, "name", value.name)
            add(one, "description", value.doc)
            add(one, "value", str(value.value))


def add_dim(entry, count, stride):
    add(entry, "dim", str(BUFFERS if count == NUM_MB else count))
    add(entry, "dimIncrement", str(stride))


def add_register(parent, register, fields, alternate_of=""):
    entry = add(parent, "register")
    name = register.name + ("_ALT" if alternate_of else "")
    if register.count != 1:
        add_dim(entry, register.count, register.stride)
        name += "[%s]"
    add(entry, "name", name)
    only = f" (only if {register.only_if})" if register.only_if == MORE_THAN_32 else \
        f" (only with {register.only_if})" if register.only_if else ""
    add(entry, "description", register.title + only)
    if alternate_of:
        add(entry, "alternateRegister", alternate_of)
    add(entry, "addressOffset", register.offset)
    if all(part.access in ("ro", "rc") for part in register.fields):
        add(entry, "access", "read-only")
    add(entry, "resetValue", f"0x{register.value('reset', BUFFERS):08X}")
    if register.read_effect:
        add(entry, "readAction", "modifyExternal")
    group = add(entry, "fields")
    for part in fields:
        add_field(group, part)


def add_registers(parent, registers):
    for register in registers:
        add_register(parent, register, register.fields)
        if register.overlay:
            add_register(parent, register, register.overlay, register.name)


def render(regmap):
    """The text of the file."""
    device = ET.Element("device", {
        "schemaVersion": "1.3", "xmlns:xs": "http://www.w3.org/2001/XMLSchema-instance",
        "xs:noNamespaceSchemaLocation": "CMSIS-SVD.xsd"})
    version = next(one for one in regmap.registers if one.name == "XVERSION").value("reset", 0)
    for tag, text in (("vendor", "The VeriCAN authors"), ("name", regmap.name),
                      ("version", f"{version >> 16}.{version & 0xFFFF}"),
                      ("description", regmap.title), ("addressUnitBits", "8"), ("width", "32"),
                      ("size", "32"), ("access", "read-write"), ("resetValue", "0x00000000"),
                      ("resetMask", "0xFFFFFFFF")):
        add(device, tag, text)
    peripheral = add(add(device, "peripherals"), "peripheral")
    add(peripheral, "name", "CAN")
    add(peripheral, "description", regmap.title)
    add(peripheral, "baseAddress", BASE)
    block = add(peripheral, "addressBlock")
    add(block, "offset", 0)
    add(block, "size", regmap.window)
    add(block, "usage", "registers")
    registers = add(peripheral, "registers")
    add_registers(registers, regmap.registers)
    cluster = add(registers, "cluster")
    add_dim(cluster, regmap.buffers.count, regmap.buffers.stride)
    add(cluster, "name", f"{regmap.buffers.name}[%s]")
    add(cluster, "description", regmap.buffers.title)
    add(cluster, "addressOffset", regmap.buffers.offset)
    add_registers(cluster, regmap.words)
    ET.indent(device)
    return HEAD + ET.tostring(device, encoding="unicode") + "\n"

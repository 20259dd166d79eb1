# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""ipxact: an IP-XACT component (IEEE 1685-2014) of a wrapper: bus interface with its port map,
memory map with every register and field, ports, parameters, file set. tools/pack/ipxact.rng is the
schema of the subset that is written here.

The VLNVs of the AMBA buses are those of Arm's published definitions, that of Wishbone is the name
by which tools know OpenCores'; they are not checked against their files, which are not part of
the project.
"""
import xml.etree.ElementTree as ET

from pack.wrappers import rtl_files, version
from regmap.model import NUM_MB

NAMESPACE = "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"
BUFFERS = 64  # what the map of the largest core has
# bus: vendor, library, name, version
BUS_TYPES = {
    "ahb": ("amba.com", "AMBA3", "AHBLite", "r2p0_0"),
    "apb": ("amba.com", "AMBA4", "APB4", "r0p0_0"),
    "axil": ("amba.com", "AMBA4", "AXI4-Lite", "r0p0_0"),
    "wb": ("opencores.org", "interface", "wishbone", "b4"),
}
# Ports whose name in the bus definition is not their own in upper case.
LOGICAL = {"hsel": "HSELx", "psel": "PSELx"}
HEAD = """\
<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-FileCopyrightText: 2026 The VeriCAN authors
     SPDX-License-Identifier: Apache-2.0
     Written by tools/package.py from the RTL and sw/registers.yaml; edits are lost. -->
"""
# access of the map -> access, modifiedWriteValue, readAction
ACCESS = {"rw": ("read-write", None, None), "ro": ("read-only", None, None),
          "w1c": ("read-write", "oneToClear", None), "rc": ("read-only", None, "clear"),
          "w1s": ("read-write", "oneToSet", None), "wo": ("write-only", None, None)}


def add(parent, tag, text=None, **attributes):
    """A child element in IP-XACT's namespace."""
    child = ET.SubElement(parent, f"ipxact:{tag}", attributes)
    if text is not None:
        child.text = str(text)
    return child


def logical(wrapper, port):
    """The bus's own name of a port."""
    if port.name in LOGICAL:
        return LOGICAL[port.name]
    if wrapper.bus == "wb":
        return port.name.removeprefix("wb_").upper()
    return port.name.upper()


def bus_interfaces(component, wrapper):
    """Bus, clock, reset and interrupt."""
    group = add(component, "busInterfaces")
    bus = add(group, "busInterface")
    add(bus, "name", "s")
    vendor, library, name, number = BUS_TYPES[wrapper.bus]
    add(bus, "busType", vendor=vendor, library=library, name=name, version=number)
    kind = add(add(bus, "abstractionTypes"), "abstractionType")
    add(kind, "abstractionRef", vendor=vendor, library=library, name=f"{name}_rtl",
        version=number)
    maps = add(kind, "portMaps")
    for port in wrapper.bus_ports:
        pair = add(maps, "portMap")
        add(add(pair, "logicalPort"), "name", logical(wrapper, port))
        add(add(pair, "physicalPort"), "name", port.name)
    add(add(bus, "slave"), "memoryMapRef", memoryMapRef="registers")


def add_fields(parent, register):
    """The fields of a register, the lowest first as the standard wants."""
    for part in sorted(register.fields, key=lambda field: field.low):
        access, on_write, on_read = ACCESS[part.access]
        entry = add(parent, "field")
        add(entry, "name", part.name)
        add(entry, "description", part.doc
            + (f" (only with {part.only_if})" if part.only_if else ""))
        add(entry, "bitOffset", part.low)
        reset = BUFFERS if part.reset == NUM_MB else part.reset
        add(add(add(entry, "resets"), "reset"), "value", f"'h{reset:X}")
        add(entry, "bitWidth", part.width)
        add(entry, "access", access)
        if on_write:
            add(entry, "modifiedWriteValue", on_write)
        if on_read:
            add(entry, "readAction", on_read)


def memory_map(component, regmap):
    """Every register of the window."""
    memory = add(add(component, "memoryMaps"), "memoryMap")
    add(memory, "name", "registers")
    block = add(memory, "addressBlock")
    add(block, "name", "can")
    add(block, "baseAddress", "'h0")
    add(block, "range", f"'h{regmap.window:X}")
    add(block, "width", 32)
    add(block, "usage", "register")
    for register in regmap.registers:
        add_registers(block, register)
    buffers = regmap.buffers
    row = add(block, "registerFile")
    add(row, "name", buffers.name)
    add(row, "description", buffers.title)
    add(row, "dim", BUFFERS if buffers.count == NUM_MB else buffers.count)
    add(row, "addressOffset", f"'h{buffers.offset:X}")
    add(row, "range", f"'h{buffers.stride:X}")
    for word in regmap.words:
        add_registers(row, word)
    add(memory, "addressUnitBits", 8)


def add_registers(block, register):
    """A register or a row of them; the standard's rows have no gaps, so others are listed."""
    count = BUFFERS if register.count == NUM_MB else register.count
    apart = count != 1 and register.stride != 4
    for number in range(count if apart else 1):
        entry = add(block, "register")
        add(entry, "name", f"{register.name}_{number}" if apart else register.name)
        add(entry, "description", register.title
            + (f" (only with {register.only_if})" if register.only_if else "")
            + (f" Reading it: {register.read_effect}." if register.read_effect else ""))
        if count != 1 and not apart:
            add(entry, "dim", count)
        add(entry, "addressOffset", f"'h{register.offset + number * register.stride:X}")
        add(entry, "size", 32)
        add_fields(entry, register)


def model_of(component, wrapper):
    """View, ports and parameters of the module."""
    model = add(component, "model")
    view = add(add(model, "views"), "view")
    add(view, "name", "rtl")
    add(view, "componentInstantiationRef", "rtl")
    instance = add(add(model, "instantiations"), "componentInstantiation")
    add(instance, "name", "rtl")
    add(instance, "language", "systemVerilog")
    add(instance, "moduleName", wrapper.module)
    values = add(instance, "moduleParameters")
    for entry in wrapper.parameters:
        one = add(values, "moduleParameter", dataType="integer")
        add(one, "name", entry.name)
        add(one, "value", entry.name)
    add(add(instance, "fileSetRef"), "localName", "rtl")
    ports = add(model, "ports")
    for port in wrapper.ports:
        one = add(ports, "port")
        add(one, "name", port.name)
        wire = add(one, "wire")
        add(wire, "direction", {"input": "in", "output": "out"}[port.direction])
        if port.is_vector:
            vector = add(add(wire, "vectors"), "vector")
            add(vector, "left", port.high)
            add(vector, "right", port.low)


def file_set(component):
    """rtl/can.f."""
    files = add(add(component, "fileSets"), "fileSet")
    add(files, "name", "rtl")
    for name in rtl_files():
        one = add(files, "file")
        add(one, "name", f"../{name}")
        add(one, "fileType", "systemVerilogSource")


def parameters_of(component, wrapper):
    """What a user of the component sets."""
    group = add(component, "parameters")
    for entry in wrapper.parameters:
        kind = {"type": "int"} if not entry.width else {"type": "bit"}
        one = add(group, "parameter", parameterId=entry.name, resolve="user", **kind)
        add(one, "name", entry.name)
        if entry.doc:
            add(one, "description", entry.doc)
        if entry.width:
            vector = add(add(one, "vectors"), "vector")
            add(vector, "left", entry.width - 1)
            add(vector, "right", 0)
        add(one, "value", f"{entry.width}'h{entry.number:X}" if entry.width else entry.number)


def render(wrapper, regmap):
    """The text of the component."""
    ET.register_namespace("ipxact", NAMESPACE)
    component = ET.Element("ipxact:component", {"xmlns:ipxact": NAMESPACE})
    for tag, text in (("vendor", "verican"), ("library", "ip"), ("name", wrapper.module),
                      ("version", version())):
        add(component, tag, text)
    bus_interfaces(component, wrapper)
    memory_map(component, regmap)
    model_of(component, wrapper)
    file_set(component)
    add(component, "description", f"{regmap.title}, on {wrapper.bus}")
    parameters_of(component, wrapper)
    ET.indent(component)
    return HEAD + ET.tostring(component, encoding="unicode") + "\n"

# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""ipxact: an IP-XACT component (IEEE 1685-2014) of a wrapper: bus interface with its port map,
memory map with every register and field, ports, parameters, file set. tools/pack/ipxact.rng is the
schema of the subset that is written here.

VLNVs and names of signals of the AMBA buses are those of Arm's published definitions, those of
Wishbone are of the definitions that come with Kactus2; they are not checked against their files,
which are not part of the project.
"""
import xml.etree.ElementTree as ET

from pack.wrappers import rtl_files, version
from regmap.model import MORE_THAN_32, NUM_MB

NAMESPACE = "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"
BUFFERS = 64  # what the map of the largest core has
# bus: vendor, library, name, version, and the name of its abstraction definition
BUS_TYPES = {
    "ahb": ("amba.com", "AMBA3", "AHBLite", "r2p0_0", "AHBLite_rtl"),
    "apb": ("amba.com", "AMBA4", "APB4", "r0p0_0", "APB4_rtl"),
    "axil": ("amba.com", "AMBA4", "AXI4-Lite", "r0p0_0", "AXI4-Lite_rtl"),
    "wb": ("opencores.org", "interface", "wishbone", "b4", "wishbone.absDef"),
}
# Ports whose name in the bus definition is not their own in upper case. Case counts.
LOGICAL = {"hsel": "HSELx", "psel": "PSELx",
           "hresetn": "HRESETn", "presetn": "PRESETn", "aresetn": "ARESETn",
           # Wishbone's definition has small letters, and data by its way: master, slave.
           "wb_clk_i": "clk", "wb_rst_i": "rst", "wb_cyc_i": "cyc", "wb_stb_i": "stb",
           "wb_we_i": "we", "wb_adr_i": "adr", "wb_sel_i": "sel", "wb_dat_i": "dat_ms",
           "wb_dat_o": "dat_sm", "wb_ack_o": "ack", "wb_err_o": "err", "wb_stall_o": "stall"}
# Group of an interface of its own for clock and reset, where a slave has neither by definition.
SYSTEM_GROUP = {"wb": "ClockSink"}
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


def bus_interface(group, bus, name, ports):
    """An interface of the bus with its ports."""
    vendor, library, kind, number, abstraction = BUS_TYPES[bus]
    interface = add(group, "busInterface")
    add(interface, "name", name)
    add(interface, "busType", vendor=vendor, library=library, name=kind, version=number)
    one = add(add(interface, "abstractionTypes"), "abstractionType")
    add(one, "abstractionRef", vendor=vendor, library=library, name=abstraction, version=number)
    maps = add(one, "portMaps")
    for port in ports:
        pair = add(maps, "portMap")
        add(add(pair, "logicalPort"), "name", LOGICAL.get(port.name, port.name.upper()))
        add(add(pair, "physicalPort"), "name", port.name)
    return interface


def bus_interfaces(component, wrapper):
    """The bus, with its clock and reset in an interface of their own where they have one."""
    group, ports = add(component, "busInterfaces"), wrapper.bus_ports
    if wrapper.bus in SYSTEM_GROUP:
        system = bus_interface(group, wrapper.bus, "system", ports[:2])
        add(add(system, "system"), "group", SYSTEM_GROUP[wrapper.bus])
        ports = ports[2:]
    slave = bus_interface(group, wrapper.bus, "s", ports)
    add(add(slave, "slave"), "memoryMapRef", memoryMapRef="registers")


def add_fields(parent, register, in_buffer):
    """The fields of a register, the lowest first as the standard wants. The core writes all words
    of a buffer."""
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
        if in_buffer or part.volatile:
            add(entry, "volatile", "true")
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
        add_registers(row, word, in_buffer=True)
    add(memory, "addressUnitBits", 8)


def described(register):
    """What a register is, when it is there, and what a read of it does."""
    text = register.title
    if register.only_if:
        word = "if" if register.only_if == MORE_THAN_32 else "with"
        text += f" (only {word} {register.only_if})"
    if register.read_effect:
        effect = register.read_effect.rstrip(".")
        text += f". A read {effect[0].lower()}{effect[1:]}."
    return text


def add_registers(block, register, in_buffer=False):
    """A register or a row of them; the standard's rows have no gaps, so others are listed."""
    count = BUFFERS if register.count == NUM_MB else register.count
    apart = count != 1 and register.stride != 4
    for number in range(count if apart else 1):
        entry = add(block, "register")
        add(entry, "name", f"{register.name}_{number}" if apart else register.name)
        add(entry, "description", described(register))
        if count != 1 and not apart:
            add(entry, "dim", count)
        add(entry, "addressOffset", f"'h{register.offset + number * register.stride:X}")
        add(entry, "size", 32)
        add_fields(entry, register, in_buffer)


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
        add(one, "value",
            f"{entry.width}'h{entry.packaged:X}" if entry.width else entry.packaged)


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

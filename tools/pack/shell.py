# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""shell: Verilog-2001 modules around a wrapper. One for packagers that take no SystemVerilog top
(Vivado, UG1118): same ports, same parameters, nothing else. And one for those that take the width
of the address for the size of the slave (Platform Designer).
"""
from dataclasses import replace

from pack.wrappers import PACKAGED

HEAD = """\
// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// {module}{suffix}: {module} with {what}. Written by tools/package.py; edits are lost.

"""
ADDRESSES = ("awaddr", "araddr")
REGION = "RegionBits"


def span(port):
    """The range of a port, as wide as all others."""
    return f"[{port.high}:{port.low}]" if port.is_vector else ""


def parameter(entry):
    """A parameter's declaration."""
    width = f"[{entry.width - 1}:0] " if entry.width else ""
    return f"  parameter {width}{entry.name} = {entry.default}"


def window_ports(wrapper):
    """The ports, with addresses no wider than the window is large."""
    return [replace(port, high=PACKAGED[REGION] - 1) if port.name in ADDRESSES else port
            for port in wrapper.ports]


def window_parameters(wrapper):
    """The parameters without the size of the region, which is the window's."""
    return [entry for entry in wrapper.parameters if entry.name != REGION]


def module(wrapper, suffix, what, ports, parameters, values, pins):
    """The text of a shell. values, pins: what a parameter, a port of the wrapper gets if it is not
    that of the same name."""
    declared = [f"  {port.direction:6} wire {span(port):7} {port.name}" for port in ports]
    passed = [f"    .{entry.name}({values.get(entry.name, entry.name)})"
              for entry in wrapper.parameters]
    connected = [f"    .{port.name}({pins.get(port.name, port.name)})" for port in wrapper.ports]
    return "".join([
        HEAD.format(module=wrapper.module, suffix=suffix, what=what),
        f"module {wrapper.module}{suffix} #(\n",
        ",\n".join(parameter(entry) for entry in parameters), "\n) (\n",
        ",\n".join(declared), "\n);\n", f"  {wrapper.module} #(\n", ",\n".join(passed),
        "\n  ) u_can (\n", ",\n".join(connected), "\n  );\nendmodule\n"])


def render(wrapper):
    """The shell that has what the wrapper has."""
    return module(wrapper, "_v", "a top in Verilog-2001", wrapper.ports, wrapper.parameters, {}, {})


def window(wrapper):
    """The shell whose addresses end with the window."""
    bits = PACKAGED[REGION]
    pins = {port.name: f"{{{port.width - bits}'b0, {port.name}}}" for port in wrapper.ports
            if port.name in ADDRESSES}
    return module(wrapper, "_window", f"addresses of {bits} bits", window_ports(wrapper),
                  window_parameters(wrapper), {REGION: bits}, pins)

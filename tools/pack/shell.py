# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""shell: a Verilog-2001 module around a wrapper, for packagers that take no SystemVerilog top
(Vivado, UG1118): same ports, same parameters, nothing else.
"""
HEAD = """\
// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// {module}_v: {module} with a top in Verilog-2001. Written by tools/package.py; edits are lost.

"""


def span(port):
    """The range of a port, as wide as all others."""
    return f"[{port.high}:{port.low}]" if port.is_vector else ""


def parameter(entry):
    """A parameter's declaration."""
    width = f"[{entry.width - 1}:0] " if entry.width else ""
    return f"  parameter {width}{entry.name} = {entry.default}"


def render(wrapper):
    """The text of the shell."""
    ports = [f"  {port.direction:6} wire {span(port):7} {port.name}" for port in wrapper.ports]
    values = [f"    .{entry.name}({entry.name})" for entry in wrapper.parameters]
    pins = [f"    .{port.name}({port.name})" for port in wrapper.ports]
    return "".join([
        HEAD.format(module=wrapper.module), f"module {wrapper.module}_v #(\n",
        ",\n".join(parameter(entry) for entry in wrapper.parameters), "\n) (\n",
        ",\n".join(ports), "\n);\n", f"  {wrapper.module} #(\n", ",\n".join(values),
        "\n  ) u_can (\n", ",\n".join(pins), "\n  );\nendmodule\n"])

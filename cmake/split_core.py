# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Writes modules without contents, whose ports C++ can reach, and the C++ that copies them.
"""usage: split_core.py CAN_CORE_SV CAN_TIME_SV OUT_SV OUT_TIME_SV OUT_UNIT_SV OUT_HPP DOT

DOT: what Verilator makes of the dot between a generate block and what is in it, __DOT__ or, of a
netlist, whose names have dots in them, __02e.

The simulator runs engine and host side as two Verilated models, so that the host side rests while
nothing changes for it (sim/node/split_core.hpp), and the time unit as a third
(sim/node/timed_engine.hpp). Ports are read from the modules themselves: a new one needs no change
here. OUT_SV is a hollow can_core, OUT_TIME_SV the same with the ports of the time unit, OUT_UNIT_SV
a hollow can_time. The C++ is a struct for each module that has a hollow one in it.
"""
import re
import sys

# The node drives these itself, and takes the others of these from the engine.
SKIPPED = {"clk_i", "rst_ni", "can_rx_i", "can_tx_o", "trace_o"}
# Data that mean something only beside a pulse, or when the CPU reads them: they change in every
# bit, and the host side need not wake for that.
QUIET = {"rx_id_o", "rx_ide_o", "rx_srr_o", "rx_rtr_o", "rx_dlc_o", "rx_byte_o", "timer_o",
         "crc_o", "gap_o"}
# Ports of the time unit. What it captures is read only after a command, or beside a pulse.
TIME = "time_"
QUIET_TIME = {"time_now_o", "time_ext_o", "time_left_o", "time_stamp_o", "time_stamp_tx_o",
              "time_sync_stat_o", "time_sync_ofs_o"}
PORT = re.compile(r"^\s*(input|output)\s+((?:logic|can_pkg::\w+)\s*(?:\[[^\]]*\])?)\s*(\w+),?",
                  re.MULTILINE)
WIDE = re.compile(r"\[(3[2-9]|[4-6]\d):0\]")  # of 33 to 64 bits
BYTE = re.compile(r"^logic\s*(\[[0-7]:0\])?$")  # of 1 to 8 bits
# Struct, the engine in that top, inputs of the engine that C++ drives, whether with the time unit.
TIMING = {"presdiv_i", "rjw_i", "pseg1_i", "pseg2_i", "propseg_i"}
AHB = "can_ahb__DOT__u_top__DOT__u_core__DOT__"
TOPS = (("AhbPorts", AHB, set(), False), ("AhbTimePorts", AHB, set(), True),
        ("RemotePorts", "can_remote__DOT__u_core__DOT__", TIMING, False))
UNIT = "can_core__DOT__gen_time{dot}u_time__DOT__"
# What the engine looks at; the host side takes the others from the unit itself.
OF_UNIT = {"stat_o"}


def module(path, name):
    """Header of a module and its ports: [(direction, type, name)]."""
    text = open(path, encoding="utf-8").read()
    header = text[text.index(f"module {name}"):]
    header = header[:header.index("\n);") + 3]
    ports = PORT.findall(header)
    if not ports:
        sys.exit(f"{path}: no ports found in {name}")
    return header, ports


def hollow(header, ports, constant=frozenset(), skipped=frozenset()):
    """The module without contents, whose outputs C++ sets and whose inputs it reads. The outputs
    `constant` are 0; of those `skipped` nothing is shown."""
    lines = ["// Generated: ports of a module, for C++.", header]
    for direction, kind, name in ports:
        if direction == "output" and name in constant:
            lines.append(f"  assign {name} = '0;")
        elif name in skipped:
            continue
        elif direction == "output":
            lines.append(f"  {kind} {name}_v /* verilator public_flat_rw */;")
            lines.append(f"  assign {name} = {name}_v;")
        else:
            lines.append(f"  {kind} {name}_v /* verilator public_flat_rd */;")
            lines.append(f"  assign {name}_v = {name};")
    return lines + ["endmodule"]


def pin(name):
    """Where a model has its port: in its root, but for what a class around it has of its own
    (sim/node/timed_engine.hpp)."""
    return f"core.{name}" if name.startswith(TIME) else f"pins.{name}"


class Ports:
    """The ports that two models share: name, and for those of one byte the place in the block that
    Verilator makes of them in the order in which they are declared (sim/node/port_block.hpp)."""

    def __init__(self, root, ports):
        self.root = root
        self.wide = {name for _, kind, name in ports if WIDE.search(kind)}
        self.block = [name for _, kind, name in ports
                      if BYTE.search(kind) and not name.startswith(TIME)]
        self.words = (len(self.block) + 7) // 8

    def host(self, name):
        return f"host.{self.root}{name}_v"

    def mask(self, names):
        """PortBlock of those of `names` that are in the block."""
        data = bytes(0xFF if name in names else 0 for name in self.block).ljust(8 * self.words,
                                                                               b"\0")
        words = [f"0x{int.from_bytes(data[i:i + 8], 'little'):016X}"
                 for i in range(0, len(data), 8)]
        return f"PortBlock<{self.words}>{{{{{', '.join(words)}}}}}"

    def in_block(self):
        """A function that is true if both models have the block. Models without short cuts do
        without it, too, so that the other way is tested."""
        first = self.block[0]
        lines = ["  /// Whether the ports of one byte lie in both models as PortBlock has them.",
                 "  template <typename Core, typename Host>",
                 "  static bool in_block(const Core &core, const Host &host) {",
                 "    const auto &pins = *core.rootp;",
                 "    bool aligned = true;"]
        lines += [f"    aligned &= PortBlock<1>::aligned({place}, {pin(first)}, {pin(name)}, "
                  f"{self.host(first)}, {self.host(name)});"
                  for place, name in enumerate(self.block)]
        return lines + ["    return aligned && !kPlainEdges;", "  }", ""]


def changes(ports, compared):
    """Sets `changed` if one of the ports `compared` differs."""
    word = "std::uint64_t" if ports.wide & set(compared) else "unsigned"
    return ([f"    {word} changed = 0;"]
            + [f"    changed |= {ports.host(name)} ^ {pin(name)};" for name in compared])


def copied(ports, names, to_host):
    """Statements that copy ports."""
    return [f"{ports.host(name)} = {pin(name)}" if to_host else f"{pin(name)} = {ports.host(name)}"
            for name in names]


def function(comment, signature, ports, compared, target=None):
    """A function that is true if one of the ports `compared` differs, and then copies them to
    `target`, "host" or "core"."""
    first = ports.block[0]
    others = [name for name in compared if name not in ports.block]
    ends = ["    return true;", "  }", ""]
    lines = [f"  /// {comment}", "  template <typename Core, typename Host>",
             f"  static bool {signature} {{", "    auto &pins = *core.rootp;",
             "    if (in_block(core, host)) {"]
    inner = [f"    constexpr auto block = {ports.mask(compared)};"]
    inner += changes(ports, others)
    inner += [f"    if (changed == 0 && !block.differ(&{pin(first)}, &{ports.host(first)})) "
              "return false;"]
    if target:
        ends_of_copy = [f"&{ports.host(first)}", f"&{pin(first)}"]
        to, source = ends_of_copy if target == "host" else reversed(ends_of_copy)
        inner += [f"    block.copy({to}, {source});"]
        inner += [f"    {line};" for line in copied(ports, others, target == "host")]
    lines += [f"  {line}" for line in inner + ends[:1]] + ["    }"]
    lines += changes(ports, compared) + ["    if (changed == 0) return false;"]
    if target:
        lines += [f"    {line};" for line in copied(ports, compared, target == "host")]
    return lines + ends


def copies(struct, root, ports, driven=frozenset()):
    """The struct that copies the ports between a model and the hollow module in its top, but for
    the inputs `driven`."""
    ports = [port for port in ports if port[2] not in SKIPPED]
    into = [name for direction, _, name in ports if direction == "output"]
    back = [name for direction, _, name in ports if direction == "input" and name not in driven]
    shared = Ports(root, ports)
    lines = [f"struct {struct} {{"] + shared.in_block()
    lines += function("Outputs of the model to the top; true if any has changed.",
                      "to_host(const Core &core, Host &host)", shared, into, "host")
    lines += function("True if an output has changed that a resting top must see.",
                      "wakes_host(const Core &core, const Host &host)", shared,
                      [name for name in into if name not in QUIET | QUIET_TIME])
    lines += function("The top's levels to inputs of the model; true if any has changed.",
                      "to_core(Core &core, const Host &host)", shared, back, "core")
    return lines[:-1] + ["};", ""]


def main():
    core, unit, out_sv, out_time_sv, out_unit_sv, out_hpp, dot = sys.argv[1:]
    unit_root = UNIT.format(dot=dot)
    header, ports = module(core, "can_core")
    unit_header, unit_ports = module(unit, "can_time")
    hpp = ["// Generated from can_core.sv and can_time.sv: copies their ports between two models.",
           "#pragma once", "", "#include <cstdint>", "", '#include "node/model_edge.hpp"',
           '#include "node/port_block.hpp"', "",
           "namespace vericansim {", ""]
    for struct, root, driven, with_time in TOPS:
        used = [port for port in ports if with_time or not port[2].startswith(TIME)]
        hpp += copies(struct, root, used, driven)
    unit_outputs = {name for direction, _, name in unit_ports if direction == "output"} - OF_UNIT
    hpp += ["/// The engine's level at input `name` of the time unit.",
            f"#define VERICAN_AT_TIME_UNIT(name) {unit_root}##name##_v", ""]
    hpp += copies("TimeUnitPorts", unit_root,
                  [port for port in unit_ports if port[2] not in unit_outputs])
    hpp += ["}  // namespace vericansim", ""]
    time = {name for _, _, name in ports if name.startswith(TIME)}
    own = {"can_tx_o", "trace_o"}
    for path, lines in ((out_sv, hollow(header, ports, own | time, SKIPPED | time)),
                        (out_time_sv, hollow(header, ports, own, SKIPPED)),
                        (out_unit_sv, hollow(unit_header, unit_ports, unit_outputs, SKIPPED)),
                        (out_hpp, hpp)):
        open(path, "w", encoding="utf-8").write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()

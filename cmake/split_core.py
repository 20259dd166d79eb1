# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Writes modules without contents, whose ports C++ can reach, and the C++ that copies them.
"""usage: split_core.py CAN_CORE_SV CAN_TIME_SV OUT_SV OUT_TIME_SV OUT_UNIT_SV OUT_HPP

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
# Struct, the engine in that top, inputs of the engine that C++ drives, whether with the time unit.
TIMING = {"presdiv_i", "rjw_i", "pseg1_i", "pseg2_i", "propseg_i"}
AHB = "can_ahb__DOT__u_top__DOT__u_core__DOT__"
TOPS = (("AhbPorts", AHB, set(), False), ("AhbTimePorts", AHB, set(), True),
        ("RemotePorts", "can_remote__DOT__u_core__DOT__", TIMING, False))
UNIT = "can_core__DOT__gen_time__DOT__u_time__DOT__"
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


def function(comment, signature, root, compared, copied, wide):
    """A function that is true if one of the ports `compared` differs, and then does `copied`."""
    word = "std::uint64_t" if wide & set(compared) else "unsigned"
    lines = [f"  /// {comment}", "  template <typename Core, typename Host>",
             f"  static bool {signature} {{", "    auto &pins = *core.rootp;",
             f"    {word} changed = 0;"]
    lines += [f"    changed |= host.{root}{name}_v ^ {pin(name)};" for name in compared]
    lines.append("    if (changed == 0) return false;")
    return lines + [f"    {line};" for line in copied] + ["    return true;", "  }", ""]


def copies(struct, root, ports, driven=frozenset()):
    """The struct that copies the ports between a model and the hollow module in its top, but for
    the inputs `driven`."""
    ports = [port for port in ports if port[2] not in SKIPPED]
    into = [name for direction, _, name in ports if direction == "output"]
    back = [name for direction, _, name in ports if direction == "input" and name not in driven]
    wide = {name for _, kind, name in ports if WIDE.search(kind)}
    lines = [f"struct {struct} {{"]
    lines += function("Outputs of the model to the top; true if any has changed.",
                      "to_host(const Core &core, Host &host)", root, into,
                      [f"host.{root}{name}_v = {pin(name)}" for name in into], wide)
    lines += function("True if an output has changed that a resting top must see.",
                      "wakes_host(const Core &core, const Host &host)", root,
                      [name for name in into if name not in QUIET | QUIET_TIME], [], wide)
    lines += function("The top's levels to inputs of the model; true if any has changed.",
                      "to_core(Core &core, const Host &host)", root, back,
                      [f"{pin(name)} = host.{root}{name}_v" for name in back], wide)
    return lines[:-1] + ["};", ""]


def main():
    core, unit, out_sv, out_time_sv, out_unit_sv, out_hpp = sys.argv[1:]
    header, ports = module(core, "can_core")
    unit_header, unit_ports = module(unit, "can_time")
    hpp = ["// Generated from can_core.sv and can_time.sv: copies their ports between two models.",
           "#pragma once", "", "#include <cstdint>", "", "namespace vericansim {", ""]
    for struct, root, driven, with_time in TOPS:
        used = [port for port in ports if with_time or not port[2].startswith(TIME)]
        hpp += copies(struct, root, used, driven)
    unit_outputs = {name for direction, _, name in unit_ports if direction == "output"} - OF_UNIT
    hpp += copies("TimeUnitPorts", UNIT,
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

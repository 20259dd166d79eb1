# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Writes a can_core without contents, whose ports C++ can reach, and the C++ that copies them.
"""usage: split_core.py CAN_CORE_SV OUT_SV OUT_TIME_SV OUT_HPP

The simulator runs engine and host side as two Verilated models, so that the host side rests while
nothing changes for it (sim/node/split_core.hpp). Ports are read from the module itself: a new one
needs no change here. OUT_TIME_SV has the ports of the time unit, too. The C++ is a struct for each
top that has an engine.
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
WIDE = {"time_data_i", "time_now_o", "time_ext_o", "time_stamp_o"}  # of more than 32 bits
PORT = re.compile(r"^\s*(input|output)\s+logic\s*(\[[^\]]*\])?\s*(\w+),?", re.MULTILINE)
# Struct, the engine in that top, inputs of the engine that C++ drives, whether with the time unit.
TIMING = {"presdiv_i", "rjw_i", "pseg1_i", "pseg2_i", "propseg_i"}
AHB = "can_ahb__DOT__u_top__DOT__u_core__DOT__"
TOPS = (("AhbPorts", AHB, set(), False), ("AhbTimePorts", AHB, set(), True),
        ("RemotePorts", "can_remote__DOT__u_core__DOT__", TIMING, False))


def hollow(header, ports, with_time):
    """can_core.sv without contents, whose outputs C++ sets and whose inputs it reads."""
    lines = ["// Generated from can_core.sv: its ports, for C++.", header]
    for direction, width, name in ports:
        absent = name.startswith(TIME) and not with_time
        if direction == "output" and (name in ("can_tx_o", "trace_o") or absent):
            lines.append(f"  assign {name} = '0;")
        if name in SKIPPED or absent:
            continue
        if direction == "output":
            lines.append(f"  logic {width} {name}_v /* verilator public_flat_rw */;")
            lines.append(f"  assign {name} = {name}_v;")
        else:
            lines.append(f"  logic {width} {name}_v /* verilator public_flat_rd */;")
            lines.append(f"  assign {name}_v = {name};")
    return lines + ["endmodule"]


def function(comment, signature, root, compared, copied):
    """A function that is true if one of the ports `compared` differs, and then does `copied`."""
    word = "std::uint64_t" if WIDE & set(compared) else "unsigned"
    lines = [f"  /// {comment}", "  template <typename Core, typename Host>",
             f"  static bool {signature} {{", f"    {word} changed = 0;"]
    lines += [f"    changed |= host.{root}{name}_v ^ core.{name};" for name in compared]
    lines.append("    if (changed == 0) return false;")
    return lines + [f"    {line};" for line in copied] + ["    return true;", "  }", ""]


def copies(struct, root, into, back):
    """The struct that copies the engine's ports between the two models of a top."""
    lines = [f"struct {struct} {{"]
    lines += function("Engine outputs to the host side; true if any has changed.",
                      "to_host(const Core &core, Host &host)", root, into,
                      [f"host.{root}{name}_v = core.{name}" for name in into])
    lines += function("True if an engine output has changed that a resting host side must see.",
                      "wakes_host(const Core &core, const Host &host)", root,
                      [name for name in into if name not in QUIET | QUIET_TIME], [])
    lines += function("Host side to engine inputs; true if any has changed.",
                      "to_core(Core &core, const Host &host)", root, back,
                      [f"core.{name} = host.{root}{name}_v" for name in back])
    return lines[:-1] + ["};", ""]


def main():
    source, out_sv, out_time_sv, out_hpp = sys.argv[1:]
    text = open(source, encoding="utf-8").read()
    header = text[text.index("module can_core"):]
    header = header[:header.index("\n);") + 3]
    ports = PORT.findall(header)
    if not ports:
        sys.exit(f"{source}: no ports found in can_core")
    if WIDE != {name for _, width, name in ports if width.startswith("[63:")}:
        sys.exit(f"{source}: {__file__} has other ports of 64 bits")
    hpp = ["// Generated from can_core.sv: copies its ports between the two models.",
           "#pragma once", "", "#include <cstdint>", "", "namespace vericansim {", ""]
    for struct, root, driven, with_time in TOPS:
        names = [(direction, name) for direction, _, name in ports
                 if name not in SKIPPED and (with_time or not name.startswith(TIME))]
        into = [name for direction, name in names if direction == "output"]
        back = [name for direction, name in names if direction == "input" and name not in driven]
        hpp += copies(struct, root, into, back)
    hpp += ["}  // namespace vericansim", ""]
    for path, with_time in ((out_sv, False), (out_time_sv, True)):
        open(path, "w", encoding="utf-8").write("\n".join(hollow(header, ports, with_time)) + "\n")
    open(out_hpp, "w", encoding="utf-8").write("\n".join(hpp))


if __name__ == "__main__":
    main()

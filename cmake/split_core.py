# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Writes a can_core without contents, whose ports C++ can reach, and the C++ that copies them.
"""usage: split_core.py CAN_CORE_SV OUT_SV OUT_HPP

The simulator runs engine and host side as two Verilated models, so that the host side rests while
nothing changes for it (sim/node/split_core.hpp). Ports are read from the module itself: a new one
needs no change here.
"""
import re
import sys

# The node drives these itself, and takes the others of these from the engine.
SKIPPED = {"clk_i", "rst_ni", "can_rx_i", "can_tx_o", "trace_o"}
# Data that mean something only beside a pulse, or when the CPU reads them: they change in every
# bit, and the host side need not wake for that.
QUIET = {"rx_id_o", "rx_ide_o", "rx_srr_o", "rx_rtr_o", "rx_dlc_o", "rx_byte_o", "timer_o",
         "crc_o", "gap_o"}
PORT = re.compile(r"^\s*(input|output)\s+logic\s*(\[[^\]]*\])?\s*(\w+),?", re.MULTILINE)
ROOT = "can_ahb__DOT__u_top__DOT__u_core__DOT__"


def main():
    source, out_sv, out_hpp = sys.argv[1:]
    text = open(source, encoding="utf-8").read()
    header = text[text.index("module can_core"):]
    header = header[:header.index("\n);") + 3]
    ports = PORT.findall(header)
    if not ports:
        sys.exit(f"{source}: no ports found in can_core")
    sv = ["// Generated from can_core.sv: its ports, for C++.", header]
    into, back = [], []
    for direction, width, name in ports:
        if name in ("can_tx_o", "trace_o"):
            sv.append(f"  assign {name} = '0;")
        if name in SKIPPED:
            continue
        if direction == "output":
            sv.append(f"  logic {width} {name}_v /* verilator public_flat_rw */;")
            sv.append(f"  assign {name} = {name}_v;")
            into.append(name)
        else:
            sv.append(f"  logic {width} {name}_v /* verilator public_flat_rd */;")
            sv.append(f"  assign {name}_v = {name};")
            back.append(name)
    sv.append("endmodule")
    hpp = ["// Generated from can_core.sv: copies its ports between the two models.",
           "#pragma once", "",
           "namespace vericansim {", "",
           "/// Engine outputs to the host side; true if any has changed.",
           "template <typename Core, typename Host>",
           "bool copy_to_host(const Core &core, Host &host) {",
           "  unsigned changed = 0;"]
    for name in into:
        hpp.append(f"  changed |= host.{ROOT}{name}_v ^ core.{name};")
    hpp.append("  if (changed == 0) return false;")
    for name in into:
        hpp.append(f"  host.{ROOT}{name}_v = core.{name};")
    hpp += ["  return true;", "}", "",
            "/// True if an engine output has changed that a resting host side must see.",
            "template <typename Core, typename Host>",
            "bool wakes_host(const Core &core, const Host &host) {",
            "  unsigned changed = 0;"]
    for name in into:
        if name not in QUIET:
            hpp.append(f"  changed |= host.{ROOT}{name}_v ^ core.{name};")
    hpp += ["  return changed != 0;", "}", "",
             "/// Host side to engine inputs; true if any has changed.",
            "template <typename Core, typename Host>",
            "bool copy_to_core(Core &core, const Host &host) {",
            "  unsigned changed = 0;"]
    for name in back:
        hpp.append(f"  changed |= core.{name} ^ host.{ROOT}{name}_v;")
    hpp.append("  if (changed == 0) return false;")
    for name in back:
        hpp.append(f"  core.{name} = host.{ROOT}{name}_v;")
    hpp += ["  return true;", "}", "", "}  // namespace vericansim", ""]
    open(out_sv, "w", encoding="utf-8").write("\n".join(sv) + "\n")
    open(out_hpp, "w", encoding="utf-8").write("\n".join(hpp))


main()

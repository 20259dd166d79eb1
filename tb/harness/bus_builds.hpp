// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes with 64 buffers and all features behind each of the bus wrappers.
#pragma once

#include <memory>
#include <string>

#include "node/rtl_node.hpp"

namespace vericansim {

/// The wrappers and masters that make_bus_node() knows: AHB-Lite; APB; AXI4-Lite; the same with
/// random delays of all channels and reads beside writes; Wishbone, standard cycles and pipelined;
/// a pipelined Wishbone master on the wrapper for standard cycles.
inline constexpr const char *kBusBuilds[] = {"ahb", "apb",          "axil",      "axil_slow",
                                             "wb",  "wb_pipelined", "wb_stalled"};

/// std::invalid_argument if there is no such bus.
std::unique_ptr<RtlNode> make_bus_node(const std::string &bus, std::string name,
                                       const ClockConfig &clock = {});

}  // namespace vericansim

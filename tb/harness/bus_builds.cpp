// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes behind the bus wrappers: see bus_builds.hpp.
#include "harness/bus_builds.hpp"

#include <iostream>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "Vcan_apb64.h"
#include "Vcan_apb64___024root.h"
#include "Vcan_axil64.h"
#include "Vcan_axil64___024root.h"
#include "Vcan_wb64.h"
#include "Vcan_wb64___024root.h"
#include "Vcan_wb64_pipelined.h"
#include "Vcan_wb64_pipelined___024root.h"
#include "node/bus_node_of.hpp"

namespace vericansim {
namespace {

constexpr unsigned kAllBuffers = 64;

/// Two delays in three are none; the others are up to five clocks.
std::function<unsigned()> random_delay() {
  return [rng = std::mt19937{1}]() mutable { return rng() % 3 != 0 ? 0U : 1U + rng() % 5; };
}

}  // namespace

std::unique_ptr<RtlNode> make_bus_node(const std::string &bus, std::string name,
                                       const ClockConfig &clock) {
  static std::set<std::string> told;
  if (told.insert(bus).second) std::cout << "behind " << bus << "\n";  // for tb/harness/bus_run.sh
  if (bus == "ahb") return RtlNode::create(std::move(name), clock, kAllBuffers);
  if (bus == "apb")
    return std::make_unique<BusNodeOf<Vcan_apb64, ApbPins>>(std::move(name), clock, kAllBuffers);
  if (bus == "axil" || bus == "axil_slow") {
    auto node =
        std::make_unique<BusNodeOf<Vcan_axil64, AxilPins>>(std::move(name), clock, kAllBuffers);
    if (bus == "axil_slow") node->bus_master().delay(random_delay());
    return node;
  }
  if (bus == "wb")
    return std::make_unique<BusNodeOf<Vcan_wb64, WbPins<false>>>(std::move(name), clock,
                                                                 kAllBuffers);
  if (bus == "wb_stalled")
    return std::make_unique<BusNodeOf<Vcan_wb64, WbPins<true>>>(std::move(name), clock,
                                                                kAllBuffers);
  if (bus == "wb_pipelined")
    return std::make_unique<BusNodeOf<Vcan_wb64_pipelined, WbPins<true>>>(std::move(name), clock,
                                                                          kAllBuffers);
  throw std::invalid_argument(
      "no bus " + bus + "; there are ahb, apb, axil, axil_slow, wb, wb_pipelined, wb_stalled");
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlNode::create(): the Verilated builds of can_ahb.
#include <stdexcept>
#include <utility>

#include "Vcan_host16.h"
#include "Vcan_host16___024root.h"
#include "Vcan_host32.h"
#include "Vcan_host32___024root.h"
#include "Vcan_host64.h"
#include "Vcan_host64___024root.h"
#include "Vcan_host64_time.h"
#include "Vcan_host64_time___024root.h"
#include "node/rtl_node_of.hpp"
#include "node/timed_engine.hpp"

namespace vericansim {

std::unique_ptr<RtlNode> RtlNode::create(std::string name, const ClockConfig &clock,
                                         unsigned num_mb) {
  switch (num_mb) {
    case 16: return std::make_unique<RtlNodeOf<Vcan_host16>>(std::move(name), clock, num_mb);
    case 32: return std::make_unique<RtlNodeOf<Vcan_host32>>(std::move(name), clock, num_mb);
    case 64: return std::make_unique<RtlNodeOf<Vcan_host64>>(std::move(name), clock, num_mb);
    default:
      throw std::invalid_argument("message buffers must be 16, 32 or 64, got " +
                                  std::to_string(num_mb));
  }
}

std::unique_ptr<RtlNode> RtlNode::create_with_time(std::string name, const ClockConfig &clock) {
  return std::make_unique<RtlNodeOf<Vcan_host64_time, AhbTimePorts, TimedEngine>>(std::move(name),
                                                                                  clock, 64U);
}

}  // namespace vericansim

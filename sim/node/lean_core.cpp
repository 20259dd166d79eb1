// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See lean_core.hpp.
#include "node/lean_core.hpp"

#include <utility>

#include "Vcan_host64_lean.h"
#include "Vcan_host64_lean___024root.h"
#include "node/rtl_node_of.hpp"

namespace vericansim {

std::unique_ptr<RtlNode> create_lean_core(std::string name, const ClockConfig &clock) {
  return std::make_unique<RtlNodeOf<Vcan_host64_lean>>(std::move(name), clock, 64U);
}

}  // namespace vericansim

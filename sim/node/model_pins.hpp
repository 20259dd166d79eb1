// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The pins of can_ahb on a Verilated model, whichever of them it is.
#pragma once

#include <cstdint>

#include "node/ahb_checker.hpp"

namespace vericansim {

/// Puts what the master shows onto the pins, but for HREADY.
template <typename Model>
inline void show_request(Model &model, const AhbRequest &request) {
  model.hsel = request.htrans != AhbTrans::kIdle;
  model.haddr = request.haddr;
  model.htrans = static_cast<std::uint8_t>(request.htrans);
  model.hwrite = request.hwrite;
  model.hsize = static_cast<std::uint8_t>(request.hsize);
  model.hburst = static_cast<std::uint8_t>(request.hburst);
  model.hprot = request.hprot;
  model.hwdata = request.hwdata;
}

/// The interrupt lines as RtlNode::irq_lines() has them.
template <typename Model>
[[nodiscard]] inline std::uint8_t model_irq_lines(const Model &model) {
  return static_cast<std::uint8_t>(model.irq_o | (model.irq_mb_o << 1) | (model.irq_boff_o << 2) |
                                   (model.irq_err_o << 3) | (model.irq_twrn_o << 4) |
                                   (model.irq_rwrn_o << 5) | (model.irq_wak_o << 6));
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EngineLevel: what a Verilated can_core sends next.
#pragma once

#include <cstdint>

#include "bus/trace.hpp"
#include "verilated.h"

namespace vericansim {

/// The level behind the next bit boundary, from what has been prepared for it
/// (rtl/frame/can_tx_frame.sv, can_field.sv). For QuietEngine.
class EngineLevel {
 public:
  /// The model has the members that are looked at.
  template <typename Root>
  static constexpr bool kKnown = requires(Root &root) {
    root.can_core__DOT__stuff;
    root.can_core__DOT__u_bsp__DOT__prev;
    root.can_core__DOT__u_bsp__DOT__mismatch;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__shift_q;
    root.can_core__DOT__u_bsp__DOT__u_crc15__DOT__crc_q;
    root.can_core__DOT__u_bsp__DOT__u_tx_frame__DOT__choose__DOT__level;
    root.can_core__DOT__u_bsp__DOT__u_tx_frame__DOT__choose__DOT__other;
  };

  /// The level that the engine sends from the next boundary on; `field`: its field now, in a frame
  /// or a delimiter. true: recessive.
  template <typename Root>
  [[nodiscard]] static bool next(const Root &root, Field field) {
    const bool sender = root.transmitter_o != 0;
    if (field == Field::kAck)
      return sender || root.can_core__DOT__u_bsp__DOT__mismatch != 0 || root.lom_i != 0;
    if (!sender || field > Field::kCrcDel) return true;
    if (root.can_core__DOT__stuff != 0) return root.can_core__DOT__u_bsp__DOT__prev == 0;
    const std::uint32_t shift =
        root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__shift_q;
    switch (field) {
      case Field::kId: return (shift >> 28 & 1) != 0;
      case Field::kRtr: return (root.rx_rtr_o | root.rx_ide_o) != 0;
      case Field::kIde: return root.rx_ide_o != 0;
      case Field::kExId: return (shift >> 17 & 1) != 0;
      case Field::kExRtr: return root.rx_rtr_o != 0;
      case Field::kDlc: return (root.rx_dlc_o >> 3 & 1) != 0;
      case Field::kData: return shift >> 31 != 0;
      case Field::kCrc: return (root.can_core__DOT__u_bsp__DOT__u_crc15__DOT__crc_q >> 14 & 1) != 0;
      case Field::kCrcDel: return true;
      default: return false;  // SOF, r1, r0
    }
  }

  /// Does what a boundary does in can_tx_frame.sv; Verilator keeps the variables of that block,
  /// too.
  template <typename Root>
  static void send(Root &root, Field field) {
    const bool level = next(root, field);
    root.can_core__DOT__u_bsp__DOT__u_tx_frame__DOT__choose__DOT__level = level;
    root.can_core__DOT__u_bsp__DOT__u_tx_frame__DOT__choose__DOT__other =
        level || field != Field::kAck;
    root.can_core__DOT__tx_q = level;
    root.can_tx_o = static_cast<CData>(level | root.lom_i | root.lpb_i);
  }
};

}  // namespace vericansim

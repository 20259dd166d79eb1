// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ByteStore: the two clocks in which a host side at rest stores a received byte
// (rtl/mailbox/can_mb_smb.sv).
#pragma once

#include <cstdint>

#include "node/model_edge.hpp"

namespace vericansim {

/// The engine's pulse wakes a host side at rest for a write to the RAM and a count. That is done at
/// once in the clock of the pulse; should anything else happen in the clock after it, in which the
/// RAM is written, undo() puts the host side back to before the pulse and has it see it. Proven
/// member by member in tb/system/bus_transmit_scan_test.cpp.
///
/// Needs the members that Verilator 5.006 gives the model; without them (in_force() false) begin()
/// is always false.
template <typename Root, typename Ports>
class ByteStore {
 public:
  [[nodiscard]] static constexpr bool in_force() { return kKnown<Root>; }

  /// The engine hands a byte over, nothing else has changed and the model rests: it is stored.
  template <typename Core>
  bool begin(const Core &core, Root &root) {
    return begin_(core, root);
  }

  /// As if nothing had been stored, but with the pulse at the model's inputs.
  void undo(Root &root) { undo_(root); }

 private:
  template <typename R>
  static constexpr bool kKnown = !kPlainEdges && requires(R & root) {
    root.can_ahb__DOT__u_top__DOT__u_core__DOT__rx_byte_we_o_v;
    root.can_ahb__DOT__u_top__DOT__u_core__DOT__rx_byte_o_v;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__smb;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__serviced_req;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__rx_wr_req;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__byte_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__count_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__rd_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__wr_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cpu_wr_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_raddr;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem;
    root.__VstlTriggered;
  };

  // Nobody else writes to the RAM in the next two clocks.
  template <typename R>
  static bool port_free(const R &root) {
    return (root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy |
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__serviced_req |
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__rx_wr_req |
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__byte_q |
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__rd_q |
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__wr_q |
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cpu_wr_q) == 0;
  }

  template <typename Core, typename R>
  bool begin_(const Core &core, R &root) {
    if constexpr (kKnown<R>) {
      auto &pulse = root.can_ahb__DOT__u_top__DOT__u_core__DOT__rx_byte_we_o_v;
      if (core.rx_byte_we_o == 0 || pulse != 0 || !port_free(root)) return false;
      pulse = 1;
      const bool else_changed = Ports::wakes_host(core, root);
      pulse = 0;
      auto &memory = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem;
      auto &count = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__count_q;
      constexpr unsigned kBuffers = sizeof(memory) / 16;
      const unsigned half = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__smb != 0 ? 12 : 8;
      row_ = 3 * kBuffers + half + ((count & 4U) != 0 ? 2 : 1);
      // A row that is being read has its new word on the RAM's outputs, in the clock after.
      if (else_changed ||
          root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_raddr == row_)
        return false;
      before_ = memory[row_];
      byte_ = core.rx_byte_o;
      const unsigned shift = 8 * (3 - (count & 3U));
      memory[row_] = (before_ & ~(0xFFU << shift)) | static_cast<std::uint32_t>(byte_) << shift;
      count = (count + 1U) & 7U;
      return true;
    } else {
      return false;
    }
  }

  template <typename R>
  void undo_(R &root) {
    if constexpr (kKnown<R>) {
      auto &count = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__count_q;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem[row_] = before_;
      count = (count - 1U) & 7U;
      root.can_ahb__DOT__u_top__DOT__u_core__DOT__rx_byte_we_o_v = 1;
      root.can_ahb__DOT__u_top__DOT__u_core__DOT__rx_byte_o_v = byte_;
      verican_settle(&root);
    }
  }

  unsigned row_ = 0;
  std::uint32_t before_ = 0;
  std::uint8_t byte_ = 0;
};

}  // namespace vericansim

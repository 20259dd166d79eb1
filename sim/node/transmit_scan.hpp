// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TransmitScan: the clocks of a Verilated host side in which only the place of the transmit
// arbitration's pass over the buffers moves (rtl/mailbox/can_mb_tx.sv).
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "node/model_edge.hpp"

namespace vericansim {

/// A pass looks at a buffer in every clock, and most buffers have nothing to send. While only
/// those come, the clocks of a host side that does nothing else read a row and move three indices
/// on; they are found out by what a clock has left as it was, and done at once. Proven member by
/// member in tb/system/bus_transmit_scan_test.cpp.
///
/// Needs the members that Verilator 5.006 gives the model; without them there is none of it.
template <typename Root>
class TransmitScan {
 public:
  /// Clocks to come that only move the pass on, as long as no input of the model changes.
  /// `before`: the model's bytes as they were before the last clock; they are written to.
  [[nodiscard]] static std::uint64_t clocks(unsigned char *before, const Root &after) {
    return clocks_(before, after);
  }

  /// Does `clocks` of them, at least one.
  static void pass(Root &root, std::uint64_t clocks) { pass_(root, clocks); }

 private:
  template <typename R>
  static constexpr bool kKnown = !kPlainEdges && requires(R & root) {
    root.can_ahb__DOT__u_top__DOT__u_regs__DOT__u_mcr__DOT__value_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_gnt;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__stale;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__msg;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy_data;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__eng_cs_row;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__eng_msg_row;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__gen_status__DOT__u_status__DOT__imb_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__data_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__rd_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__wr_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cs_row;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_row;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cs_raddr;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_raddr;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__scan_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_idx_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_active_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_free_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_val_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__restart_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__withdrawn;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__change;
    root.__VstlTriggered;
  };

  // C/S words of buffers that a pass takes notice of: active ones and, for ESR2, inactive ones.
  static bool active(std::uint32_t cs) { return (cs >> 24 & 0xD) == 0xC; }
  static bool inactive(std::uint32_t cs) { return (cs >> 24 & 0x7) == 0; }

  // A pass is in full swing, the first buffer behind it, which begins ESR2 anew, and nobody else
  // wants a word of the RAM.
  template <typename R>
  static bool in_full_swing(const R &root) {
    const unsigned scanning = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_gnt &
                              root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_q &
                              root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_q;
    const unsigned else_busy = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__stale |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__data_q |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__rd_q |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__wr_q;
    const unsigned event = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__restart_q |
                           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__withdrawn |
                           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__change |
                           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_active_q |
                           (root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_free_q &
                            static_cast<unsigned>(takes_inactive(root)));
    return scanning != 0 && else_busy == 0 && (event & 1) == 0 &&
           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_idx_q != 0 &&
           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx ==
               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q + 1U &&
           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q ==
               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_idx_q + 1U;
  }

  // A pass for ESR2 that has met no inactive buffer yet.
  template <typename R>
  static bool takes_inactive(const R &root) {
    return root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__scan_q == 0 &&
           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__gen_status__DOT__u_status__DOT__imb_q ==
               0;
  }

  // What the clocks of a pass change goes from `from` to `to`.
  template <typename R>
  static void copy_moving(R &to, const R &from) {
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__msg =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__msg;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy_data =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy_data;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__eng_cs_row =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__eng_cs_row;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__eng_msg_row =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__eng_msg_row;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cs_row =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cs_row;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_row =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_row;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cs_raddr =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__cs_raddr;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_raddr =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__msg_raddr;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_idx_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_idx_q;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_free_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_free_q;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_val_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_val_q;
    // Not members of every model.
    if constexpr (requires { to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__better; })
      to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__better =
          from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__better;
    if constexpr (requires { to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less; })
      to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less =
          from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less;
    if constexpr (requires { to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__force_it; })
      to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__force_it =
          from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__force_it;
  }

  template <typename R>
  static std::uint64_t clocks_(unsigned char *before, const R &after) {
    if constexpr (kKnown<R>) {
      if (!in_full_swing(after)) return 0;
      copy_moving(*reinterpret_cast<R *>(before), after);
      if (std::memcmp(before, static_cast<const void *>(&after), sizeof(R)) != 0) return 0;
      return to_come(after);
    } else {
      return 0;
    }
  }

  // Clocks until one meets a buffer that matters, or reads the last one.
  template <typename R>
  static std::uint64_t to_come(const R &root) {
    constexpr unsigned kBuffers =
        sizeof(root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem) / 8;
    const unsigned maxmb = root.can_ahb__DOT__u_top__DOT__u_regs__DOT__u_mcr__DOT__value_q & 0x7F;
    const unsigned begin = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx;
    const unsigned last = maxmb < begin ? kBuffers - 1 : std::min(maxmb, kBuffers - 1);
    const bool inactive_counts = takes_inactive(root);
    unsigned next = begin;
    for (std::uint32_t cs = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs; next < last;
         ++next) {
      if (active(cs) || (inactive_counts && inactive(cs))) break;
      cs = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[next];
    }
    return next - begin;
  }

  // Stage 2 of the pass is taken notice of for active and inactive buffers only, and has been
  // filled anew after the next clock.
  template <typename R>
  static void pass_(R &root, std::uint64_t clocks) {
    if constexpr (kKnown<R>) {
      auto &next = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx;
      next = static_cast<CData>(next + clocks);
      const unsigned read = next - 1U;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q = static_cast<CData>(read);
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_idx_q =
          static_cast<CData>(read - 1);
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs =
          root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[read];
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__msg =
          root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem[read];
      verican_settle(&root);
    }
  }
};

}  // namespace vericansim

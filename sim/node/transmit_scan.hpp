// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TransmitScan: the clocks of a Verilated host side in which only the place of the transmit
// arbitration's pass over the buffers moves (rtl/mailbox/can_mb_tx.sv).
#pragma once

#include <algorithm>
#include <cstdint>

#include "node/host_image.hpp"
#include "node/model_edge.hpp"

namespace vericansim {

/// A pass looks at a buffer in every second clock, and most buffers have nothing to send. While
/// only those come, the clocks of a host side that does nothing else read a row and move three
/// indices on; they are found out by what two clocks have left as it was, and done at once. Proven
/// member by member in tb/system/bus_transmit_scan_test.cpp.
///
/// Needs the members that Verilator 5.006 gives the model; without them (in_force() false) there is
/// none of it.
template <typename Root>
class TransmitScan {
 public:
  [[nodiscard]] static constexpr bool in_force() { return kKnown<Root>; }

  /// Clocks to come that only move the pass on, as long as no input of the model changes.
  /// `before`: what the model was before the last two clocks; it is written to.
  [[nodiscard]] static std::uint64_t clocks(HostImage<Root> &before, const Root &after) {
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
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__word;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs_rd_code;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy_data;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__first;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__best_idx;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__gen_status__DOT__u_status__DOT__imb_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__data_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__pass_idx;
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
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_look_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s3_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__look2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__active2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__free2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__val2_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__best_val_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__restart_q;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__withdrawn;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__change;
    root.__VstlTriggered;
  };

  // C/S words of buffers that a pass takes notice of: active ones and, for ESR2, inactive ones.
  static bool active(std::uint32_t cs) { return (cs >> 24 & 0xD) == 0xC; }
  static bool inactive(std::uint32_t cs) { return (cs >> 24 & 0x7) == 0; }

  // A pass is in full swing: it reads the C/S word of a buffer in this clock, and compares the
  // buffer before, which is not the first: that one begins ESR2 anew. Nobody else wants a word of
  // the RAM.
  template <typename R>
  static bool in_full_swing(const R &root) {
    const unsigned scanning = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_gnt &
                              root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_q;
    const unsigned else_busy = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__stale |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__data_q |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__rd_q |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__wr_q |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_q |
                               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s3_q;
    const unsigned event = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__restart_q |
                           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__withdrawn |
                           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__change |
                           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__active2_q |
                           (root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__free2_q &
                            static_cast<unsigned>(takes_inactive(root)));
    return scanning != 0 && else_busy == 0 && (event & 1) == 0 &&
           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q != 0 &&
           root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx ==
               root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q + 1U;
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
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__word =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__word;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs_rd_code =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs_rd_code;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy_data =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__copy_data;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__pass_idx =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_step__DOT__pass_idx;
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
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__free2_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__free2_q;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__val2_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__val2_q;
    to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less_q =
        from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less_q;
    // Not members of every model.
    if constexpr (requires { to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__better; })
      to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__better =
          from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__better;
    if constexpr (requires { to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__force_it; })
      to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__force_it =
          from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__force_it;
    if constexpr (requires { to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_part; })
      to.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_part =
          from.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_part;
  }

  template <typename R>
  static std::uint64_t clocks_(HostImage<R> &before, const R &after) {
    if constexpr (kKnown<R>) {
      if (!in_full_swing(after)) return 0;
      copy_moving(before.root(), after);
      if (!before.matches(after)) return 0;
      return 2 * to_come(after);
    } else {
      return 0;
    }
  }

  // Buffers until one matters or is the last.
  template <typename R>
  static std::uint64_t to_come(const R &root) {
    constexpr unsigned kBuffers =
        sizeof(root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem) / 8;
    const unsigned maxmb = root.can_ahb__DOT__u_top__DOT__u_regs__DOT__u_mcr__DOT__value_q & 0x7F;
    const unsigned begin = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx;
    const unsigned last = maxmb < begin ? kBuffers - 1 : std::min(maxmb, kBuffers - 1);
    const bool inactive_counts = takes_inactive(root);
    unsigned next = begin;
    for (; next < last; ++next) {
      const std::uint32_t cs =
          root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[next];
      if (active(cs) || (inactive_counts && inactive(cs))) break;
    }
    return next - begin;
  }

  // Arbitration value of a buffer, as can_mb_tx has it.
  template <typename R>
  static std::uint64_t value(const R &root, unsigned buffer) {
    const std::uint32_t mcr = root.can_ahb__DOT__u_top__DOT__u_regs__DOT__u_mcr__DOT__value_q;
    const std::uint32_t cs =
        root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[buffer];
    const std::uint32_t id =
        root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem[buffer];
    const std::uint32_t rtr = cs >> 20 & 1, base = id >> 18 & 0x7FF;
    const std::uint64_t prio = (mcr >> 13 & 1) != 0 ? id >> 29 : 0;  // LPRIO_EN
    return prio << 32 | base << 21 |
           ((cs >> 21 & 1) != 0 ? 3U << 19 | (id & 0x3FFFF) << 1 | rtr : rtr << 20);
  }

  // Whether a buffer's value is below that of the winner, or of the worst so far.
  template <typename R>
  static bool less(const R &root, unsigned buffer) {
    const std::uint64_t mine = value(root, buffer),
                        other =
                            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__best_val_q;
    const unsigned tie = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__look2_q != 0
                             ? 0
                             : root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__best_idx;
    return mine < other || (mine == other && buffer < tie);
  }

  // A pass goes from clocks in which it reads to those between and back.
  template <typename R>
  static void pass_(R &root, std::uint64_t clocks) {
    if constexpr (kKnown<R>) {
      const unsigned was_between = root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_q;
      const unsigned place = 2 * root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx -
                             was_between + static_cast<unsigned>(clocks);
      const bool between = place % 2 != 0;
      const unsigned read = place / 2, compared = read - 1;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__scan_idx =
          static_cast<CData>(read + (between ? 1 : 0));
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs =
          root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[read];
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__msg =
          root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem[read];
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_q = between;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_look_q =
          between && root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__scan_q == 0;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s2_q = !between;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s3_q = between;
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__s1_idx_q = static_cast<CData>(read);
      if (compared != root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q)
        compare(root, compared);
      root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__less_q =
          less(root, between ? compared : compared - 1);
      verican_settle(&root);
    }
  }

  // Fills the stage of the comparison with a buffer that is not active.
  template <typename R>
  static void compare(R &root, unsigned buffer) {
    const unsigned maxmb = root.can_ahb__DOT__u_top__DOT__u_regs__DOT__u_mcr__DOT__value_q & 0x7F;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__idx2_q = static_cast<CData>(buffer);
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__free2_q =
        buffer >= root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__first && buffer <= maxmb &&
        inactive(
            root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[buffer]);
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_tx__DOT__val2_q = value(root, buffer);
  }
};

}  // namespace vericansim

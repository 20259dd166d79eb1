// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EngineJudge: the clock of a Verilated can_core in which a bit of a frame is judged.
#pragma once

#include "bus/trace.hpp"

namespace vericansim {

/// The first edge of a bit of a frame, in closed form: which errors the bit has if it is dominant
/// and if it is recessive (rtl/frame/can_error.sv). For QuietEngine, which says when that is all
/// that the edge does; proven member by member in tb/system/bus_quiet_engine_test.cpp.
class EngineJudge {
 public:
  /// The model has the members that are written.
  template <typename Root>
  static constexpr bool kKnown = requires(Root &root) {
    root.can_core__DOT__stuff;
    root.can_core__DOT__u_bsp__DOT__ends;
    root.can_core__DOT__u_bsp__DOT__prev;
    root.can_core__DOT__u_bsp__DOT__mismatch;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__last_q;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__join_q;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__free_r_q;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__free_d_q;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__load;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__load_q;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__high_q;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__low_q;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__take;
    root.can_core__DOT__u_bsp__DOT__u_error__DOT__error_d_q;
    root.can_core__DOT__u_bsp__DOT__u_error__DOT__error_r_q;
    root.can_core__DOT__u_bsp__DOT__u_error__DOT__judge__DOT__saw_d;
  };

  /// Does that edge: the registers of can_error.sv, and those of can_field.sv and can_rx_frame.sv.
  template <typename Root>
  static void judge(Root &root) {
    const Field field = trace_field(root.trace_o);
    judge_level(root, field);
    root.can_core__DOT__first_q = 0;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__last_q = root.can_core__DOT__u_bsp__DOT__ends;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__join_q = 0;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__free_r_q = 0;
    root.can_core__DOT__u_bsp__DOT__u_field__DOT__free_d_q = 0;
    const bool stuff = root.can_core__DOT__stuff != 0;
    const bool load =
        root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__load != 0 && !stuff;
    const bool data = field == Field::kData && !stuff;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__load_q = load;
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__high_q =
        load || data || (field == Field::kId && !stuff);
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__low_q =
        load || data || (field == Field::kExId && !stuff);
    root.can_core__DOT__u_bsp__DOT__u_rx_frame__DOT__gen_words__DOT__take = load;
  }

 private:
  // Which errors the bit has, if it is dominant and if it is recessive. Verilator keeps the
  // variables of that block, too.
  template <typename Root>
  static void judge_level(Root &root, Field field) {
#define VERICAN_JUDGE(name) root.can_core__DOT__u_bsp__DOT__u_error__DOT__##name
    const bool sender = root.transmitter_o != 0, stuff = root.can_core__DOT__stuff != 0;
    const bool ends = root.can_core__DOT__u_bsp__DOT__ends != 0;
    const bool prev = root.can_core__DOT__u_bsp__DOT__prev != 0;
    const bool sent = root.can_core__DOT__tx_q != 0;
    const unsigned group = static_cast<unsigned>(field) >> 3;  // 1: arbitration
    const bool saw_d = sender && sent, arbitration = group == 1, foreign_stuff = stuff && !sender;
    const bool end_counts = field == Field::kEof && (!ends || sender);
    const bool fixed = (field == Field::kCrcDel && !stuff) || field == Field::kAckDel || end_counts;
    const bool overload = field == Field::kEof && !end_counts;
    const bool bit1 = saw_d && !arbitration && (stuff || group == 2);
    const bool exempt = saw_d && arbitration && stuff, stuff_d = foreign_stuff && !prev;
    const bool ack = field == Field::kAck && sender && root.lpb_i == 0;
    const bool crc =
        field == Field::kAckDel && root.can_core__DOT__u_bsp__DOT__mismatch != 0 && !sender;
    const bool stuff_r = foreign_stuff && prev;
    VERICAN_JUDGE(judge__DOT__saw_d) = saw_d;
    VERICAN_JUDGE(judge__DOT__arbitration) = arbitration;
    VERICAN_JUDGE(judge__DOT__foreign_stuff) = foreign_stuff;
    VERICAN_JUDGE(judge__DOT__fixed) = VERICAN_JUDGE(form_q) = fixed;
    VERICAN_JUDGE(judge__DOT__overload) = VERICAN_JUDGE(overload_q) = overload;
    VERICAN_JUDGE(judge__DOT__bit1) = VERICAN_JUDGE(bit1_q) = bit1;
    VERICAN_JUDGE(judge__DOT__exempt) = VERICAN_JUDGE(exempt_q) = exempt;
    VERICAN_JUDGE(judge__DOT__stuff_d) = stuff_d;
    VERICAN_JUDGE(judge__DOT__bit0) = VERICAN_JUDGE(bit0_q) = !sent;
    VERICAN_JUDGE(judge__DOT__ack) = VERICAN_JUDGE(ack_q) = ack;
    VERICAN_JUDGE(judge__DOT__crc) = VERICAN_JUDGE(crc_q) = crc;
    VERICAN_JUDGE(judge__DOT__stuff_r) = VERICAN_JUDGE(stuff_r_q) = stuff_r;
    VERICAN_JUDGE(stuff_d_q) = stuff_d || exempt;
    VERICAN_JUDGE(lost_q) = saw_d && arbitration && !stuff;
    VERICAN_JUDGE(error_d_q) = bit1 || fixed || stuff_d || exempt;
    VERICAN_JUDGE(error_r_q) = !sent || ack || crc || stuff_r;
#undef VERICAN_JUDGE
  }
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_error alone: every bit that can occur, in every place and role, against section 8 of the
// rule book written down as a function.
#include <gtest/gtest.h>

#include <string>

#include "Vcan_error.h"
#include "Vcan_error___024root.h"
#include "bus/field.hpp"
#include "bus/trace.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

/// One bit as a node meets it.
struct Situation {
  Field field = Field::kIdle;
  bool last = false;  ///< of its field
  bool transmitter = false;
  bool sent = true;  ///< levels: true is recessive
  bool seen = true;
  bool stuff = false;
  bool before = true;  ///< the bit before, for a stuff bit the end of the run of five
  bool crc_mismatch = false;
  bool loop_back = false;
};

struct Verdict {
  unsigned kind = 0;  ///< TraceError
  bool error = false;
  bool exempt = false;
  bool lost = false;
  bool overload = false;
  friend bool operator==(const Verdict &, const Verdict &) = default;
};

Verdict error(unsigned kind, bool exempt = false) {
  return {.kind = kind, .error = true, .exempt = exempt};
}

bool in_arbitration(Field f) { return f >= Field::kId && f <= Field::kExRtr; }
bool in_stuffed_part(Field f) { return f >= Field::kId && f <= Field::kCrc; }

/// Dominant although this node sends recessive.
Verdict foreign_dominant(const Situation &s) {
  const bool is_delimiter = s.field == Field::kAckDel || (s.field == Field::kCrcDel && !s.stuff);
  if (is_delimiter) return error(kErrForm);                                          // ED-09
  if (s.field == Field::kEof && (!s.last || s.transmitter)) return error(kErrForm);  // ED-10
  if (s.field == Field::kEof) return {.overload = true};                             // ED-11
  if (s.field == Field::kDel && !s.last) return error(kErrForm);                     // ED-09
  if (s.field == Field::kDel) return {.overload = true};                             // ED-12
  if (s.field == Field::kInt && !s.last) return {.overload = true};                  // OV-03
  const bool of_frame = in_stuffed_part(s.field) || s.field == Field::kCrcDel;
  if (of_frame && s.transmitter) {
    if (in_arbitration(s.field)) {
      return s.stuff ? error(kErrStuff, true) : Verdict{.lost = true};  // AR-04, AR-02
    }
    return error(kErrBit1);  // ED-01
  }
  if (of_frame && s.stuff && !s.before) return error(kErrStuff);  // ST-06
  return {};                                                      // ED-03..ED-05
}

Verdict rules(const Situation &s) {
  if (!s.sent && s.seen) return error(kErrBit0);  // ED-01, ED-06
  if (!s.sent) return {};
  if (!s.seen) return foreign_dominant(s);
  if (s.stuff && !s.transmitter && s.before) return error(kErrStuff);                  // ST-06
  if (s.field == Field::kAck && s.transmitter && !s.loop_back) return error(kErrAck);  // ED-16
  if (s.field == Field::kAckDel && !s.transmitter && s.crc_mismatch) return error(kErrCrc);
  return {};
}

/// False for what cannot be: a receiver that sends frame bits, stuff bits outside frames, ...
bool possible(const Situation &s) {
  const bool flag = s.field == Field::kErrFlag || s.field == Field::kOvlFlag;
  const bool may_be_stuff = in_stuffed_part(s.field) || s.field == Field::kCrcDel;
  if (s.stuff && !may_be_stuff) return false;
  if (s.field == Field::kSof) return s.transmitter && !s.sent;
  if (flag) return s.field == Field::kErrFlag || !s.sent;
  if (s.field == Field::kAck) return s.sent || (!s.transmitter && !s.crc_mismatch);
  if (!may_be_stuff || !s.transmitter) return s.sent;
  if (s.stuff) return s.sent != s.before;  // a stuff bit is the complement
  return s.field != Field::kCrcDel || s.sent;
}

class CanError : public testing::Test {
 protected:
  void SetUp() override {
    error_.reset();
    error_->run_i = 1;
  }

  Verdict judge(const Situation &s) {
    error_->field_i = static_cast<unsigned>(s.field);
    error_->last_i = s.last;
    error_->transmitter_i = s.transmitter;
    error_->sent_i = s.sent;
    error_->stuff_i = s.stuff;
    error_->prev_i = s.before;
    error_->crc_mismatch_i = s.crc_mismatch;
    error_->lpb_i = s.loop_back;
    error_->judge_i = 1;
    error_.clock();
    error_->judge_i = 0;
    error_->bit_i = s.seen;
    error_.settle();
    EXPECT_EQ(s.seen ? error_->flag_r_o : error_->flag_d_o, error_->error_o | error_->overload_o);
    return {error_->kind_o, error_->error_o != 0, error_->exempt_o != 0, error_->lost_o != 0,
            error_->overload_o != 0};
  }
  LeafModel<Vcan_error> error_;
};

std::string text(const Situation &s) {
  return std::string{field_name(s.field)} + (s.last ? " last" : "") +
         (s.transmitter ? " transmitter" : " receiver") + (s.sent ? " sends r" : " sends d") +
         (s.seen ? " sees r" : " sees d") + (s.stuff ? " stuff" : "") +
         (s.crc_mismatch ? " CRC wrong" : "") + (s.loop_back ? " loop-back" : "");
}

// ED-01, ED-02, ED-03, ED-04, ED-05, ED-06, ED-08, ED-09, ED-10, ED-11, ED-12, ED-13, ED-14,
// ED-15, ED-16, ED-17, ED-18, ED-20, AR-02, AR-03, AR-04, AR-05, OV-03, MO-04: all of them.
TEST_F(CanError, EveryPossibleBitIsJudgedByTheRules) {
  unsigned checked = 0;
  for (unsigned field = 0; field < 32; ++field) {
    if (field_name(static_cast<Field>(field)) == "?") continue;
    for (unsigned mask = 0; mask < 256; ++mask) {
      const auto bit = [mask](unsigned n) { return ((mask >> n) & 1) != 0; };
      const Situation s{static_cast<Field>(field),
                        bit(0),
                        bit(1),
                        bit(2),
                        bit(3),
                        bit(4),
                        bit(5),
                        bit(6),
                        bit(7)};
      if (!possible(s)) continue;
      ++checked;
      EXPECT_EQ(judge(s), rules(s)) << text(s);
    }
  }
  EXPECT_GT(checked, 2000u);
}

// ED-19: stopped, nothing is judged; what was judged before is forgotten.
TEST_F(CanError, StoppedNodeSeesNoErrors) {
  judge({.field = Field::kEof});
  error_->run_i = 0;
  error_.clock();
  error_->bit_i = 0;
  error_.settle();
  EXPECT_EQ(error_->kind_o, 0);
  EXPECT_FALSE(error_->error_o || error_->overload_o || error_->lost_o);
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeAssertions: see node_assertions.hpp.
#include "judge/node_assertions.hpp"

#include <cstdlib>
#include <utility>

#include "model/frame_codec.hpp"

namespace vericansim {
namespace {

// TH-07: 6 equal bits, 8 of the delimiter, 3 of the intermission, 8 of the suspend time, and the
// bit in which the request may come.
constexpr unsigned kLongestSilence = 26;
constexpr unsigned kLongestIntegration = 12;

bool in_stuffed_part(const NodeBit &bit) {
  return (bit.field >= Field::kSof && bit.field <= Field::kCrc) ||
         (bit.field == Field::kCrcDel && bit.stuff);
}

bool in_frame(const NodeBit &bit) { return bit.field >= Field::kSof && bit.field <= Field::kEof; }

}  // namespace

void NodeAssertions::look(const NodeBit &bit, const Mode &mode, bool pending) {
  look_at_run(bit);
  look_at_dominant(bit, mode);
  if (!first_) look_at_counters(bit);
  look_at_events(bit);
  look_at_own_frame(bit);
  look_at_liveness(bit, mode, pending);
  before_ = bit;
  first_ = false;
}

void NodeAssertions::restarted() {
  auto broken = std::move(broken_);
  *this = NodeAssertions{std::move(broken)};
}

// Never six equal bits in the stuffed part of an own frame (ST-01).
void NodeAssertions::look_at_run(const NodeBit &bit) {
  const bool joins = bit.started && bit.rx == Level::kDominant;  // the foreign SOF counts (ST-07)
  if (joins || bit.field == Field::kSof) {
    run_ = 1;
    run_level_ = Level::kDominant;
    return;
  }
  if (!bit.transmitter || !in_stuffed_part(bit)) return;
  run_ = bit.sent_level == run_level_ ? run_ + 1 : 1;
  run_level_ = bit.sent_level;
  if (run_ == 6) broken_("sends a sixth equal bit in its frame");
}

// Dominant only in an own frame, as an acknowledge, in an active flag or in an overload flag.
void NodeAssertions::look_at_dominant(const NodeBit &bit, const Mode &mode) {
  // Which kind of flag is decided by the state before the error (EF-05).
  const bool flag_begins =
      bit.field == Field::kErrFlag && (before_.field != Field::kErrFlag || before_.errors != 0);
  if (flag_begins) flag_active_ = bit.sent_level == Level::kDominant;
  if (bit.sent_level == Level::kRecessive) {
    if (bit.tx == Level::kDominant) broken_("drives dominant though it sends recessive");
    return;
  }
  if (mode.listen_only) broken_("sends dominant in listen-only mode");
  if (mode.loop_back && bit.tx == Level::kDominant) broken_("drives the pin in loop-back");
  const bool own_frame = bit.transmitter && in_stuffed_part(bit);
  const bool acknowledge = !bit.transmitter && bit.field == Field::kAck;
  const bool error_flag = bit.field == Field::kErrFlag && flag_active_;
  if (!own_frame && !acknowledge && !error_flag && bit.field != Field::kOvlFlag) {
    broken_("sends dominant in " + std::string{field_name(bit.field)});
  }
}

// FC-01: at most one step in a bit, of the counter that belongs to the role, and of a legal size.
void NodeAssertions::look_at_counters(const NodeBit &bit) {
  const NodeBit &before = before_;
  if (bit.bus_off || before.bus_off) {
    if (bit.bus_off && before.bus_off && bit.rec != before.rec) broken_("moves REC in bus-off");
    return;
  }
  const int tec = static_cast<int>(bit.tec) - static_cast<int>(before.tec);
  const int rec = static_cast<int>(bit.rec) - static_cast<int>(before.rec);
  if (tec != 0 && rec != 0) broken_("moves both counters in one bit");
  if (tec != 0 && !bit.transmitter) broken_("moves TEC as a receiver");
  if (rec != 0 && bit.transmitter) broken_("moves REC as a transmitter");
  if (tec != 0 && tec != 8 && tec != -1) broken_("moves TEC by " + std::to_string(tec));
  const bool set_back = before.rec >= 128 && bit.rec >= 119 && bit.rec <= 127;
  const bool holds = before.rec >= 128 && bit.rec >= 128;
  if (rec != 0 && rec != 1 && rec != 8 && rec != -1 && !set_back && !holds) {
    broken_("moves REC by " + std::to_string(rec));
  }
}

void NodeAssertions::look_at_events(const NodeBit &bit) {
  if (bit.delivered && (bit.field != Field::kEof || bit.left != 1)) {
    broken_("delivers elsewhere than at EOF6");
  }
  if (bit.sent && (bit.field != Field::kEof || bit.left != 0 || !bit.transmitter)) {
    broken_("reports success elsewhere than at its own EOF7");
  }
  if (bit.sent && bit.failed) broken_("reports success and failure of one attempt");
  if (bit.bus_off && (bit.delivered || bit.started)) broken_("takes part in bus-off");
}

// A frame that counts as sent stands on the wire with the right stuff bits and CRC: both registers
// began afresh with its SOF (CR-05).
void NodeAssertions::look_at_own_frame(const NodeBit &bit) {
  std::vector<Level> &frame = own_frame_;
  if (bit.field == Field::kSof || (bit.started && bit.field != Field::kSof)) frame.clear();
  if (in_frame(bit) || bit.started) frame.push_back(bit.rx);
  if (!bit.sent) return;
  const DecodeResult decoded = decode_frame(frame);
  if (!decoded.frame) broken_("counts a frame as sent that is not valid on the wire");
}

void NodeAssertions::look_at_liveness(const NodeBit &bit, const Mode &mode, bool pending) {
  const bool counts = pending && !mode.listen_only && !bit.bus_off && !in_frame(bit) &&
                      bit.rx == Level::kRecessive && bit.sent_level == Level::kRecessive;
  silence_ = counts ? silence_ + 1 : 0;
  if (silence_ > kLongestSilence) broken_("does not start its frame on a quiet bus");
  if (silence_ > kLongestIntegration && bit.field == Field::kInteg) {
    broken_("does not leave integration on a quiet bus");
  }
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WireJudge: see wire_judge.hpp. Rules: RO-04, ST-01, AK-01, EF-01, EF-02, OV-01, MO-01, MO-04.
#include "fuzz/wire_judge.hpp"

#include <fmt/format.h>

namespace vericansim::fuzz {
namespace {

constexpr unsigned kRestBits = 16;

bool before_crc_end(Field field, bool stuff) {
  return (field >= Field::kSof && field <= Field::kCrc) || (field == Field::kCrcDel && stuff);
}

/// May a node be dominant there? `active`: it was error active when it found the error.
bool dominant_place(const Trace &at, bool active) {
  if (before_crc_end(at.field, at.stuff)) return at.transmitter;
  if (at.field == Field::kAck) return !at.transmitter;
  if (at.field == Field::kErrFlag) return active;
  return at.field == Field::kOvlFlag;
}

/// Behind the arbitration field, where two transmitters are a collision.
bool sends_content(std::uint64_t word) {
  const Trace at = decode_trace(word);
  return at.running && at.transmitter && at.field >= Field::kR1 && at.field <= Field::kCrc;
}

}  // namespace

WireJudge::WireJudge(Time bit_time, unsigned clocks_per_bit)
    : clock_time_{bit_time / clocks_per_bit},
      decoder_{{.bit_time = bit_time, .sample_point = 750},
               [this](const BusEvent &event) { on_event(event); }},
      rest_{kRestBits * clocks_per_bit} {
  decoder_.on_level(0, Level::kRecessive);
}

void WireJudge::break_rule(const std::string &what) {
  if (fault_.empty()) fault_ = fmt::format("clock {}: {}", now_ / clock_time_, what);
}

void WireJudge::on_event(const BusEvent &event) {
  if (event.kind == BusEventKind::kFrame) return;
  if (excused_) {
    ++excused_count_;
    return;
  }
  break_rule("the other nodes are disturbed: " + to_string(event));
}

void WireJudge::joined(const CoreSetup &setup) {
  setup_ = setup;
  on_bus_ = true;
  following_ = setup.sane_timing && !setup.loop_back;
  was_transmitter_ = false;
  model_.restart();
  model_.config().listen_only = setup.listen_only;
  if (!setup.sane_timing) excused_ = true;
}

void WireJudge::left(bool reset) {
  on_bus_ = following_ = false;
  if (reset) excused_ = true;
  if (!reset && was_transmitter_) break_rule("left the bus within a frame of its own");
}

void WireJudge::clock(const Clock &now) {
  now_ += clock_time_;
  quiet_ = now.wire == Level::kRecessive ? quiet_ + 1 : 0;
  const bool wild = on_bus_ && !setup_.sane_timing;
  if (now.wire != wire_) {
    wire_ = now.wire;
    decoder_.on_level(now_, wire_);
  }
  if (quiet_ == rest_ && !wild) {
    decoder_.finish(now_);
    excused_ = false;
    follow_from_idle(decode_trace(now.core));
  }
  if (sends_content(now.core) && (sends_content(now.peers[0]) || sends_content(now.peers[1])))
    excused_ = true;
  const Trace at = decode_trace(now.core);
  if (now.tx == Level::kDominant) {
    if (!at.running) break_rule("dominant while off the bus");
    if (setup_.listen_only) break_rule("dominant in listen-only mode");
    if (setup_.loop_back) break_rule("dominant in loop-back");
  }
  if (at.errors != 0) flag_active_ = !at.passive;  // as it was before the error was counted (EF-01)
  if (at.errors != 0 || at.tx_fail) was_transmitter_ = false;  // that frame is over
  if (at.sample && at.running) on_sample(now, at);
}

// The bus has rested for longer than integration takes: the core is idle whatever it was before.
void WireJudge::follow_from_idle(const Trace &at) {
  if (following_ || !on_bus_ || setup_.loop_back || at.bus_off || at.field != Field::kIdle) return;
  following_ = true;
  model_.preset_idle();
}

void WireJudge::on_sample(const Clock &now, const Trace &at) {
  was_transmitter_ =
      at.transmitter && at.field >= Field::kSof && at.field < Field::kEof && !setup_.loop_back;
  if (now.tx == Level::kDominant) {
    ++dominant_;
    if (at.bus_off) break_rule("dominant in bus-off");  // the bit that led there ends first
    if (!dominant_place(at, flag_active_))
      break_rule(fmt::format("dominant in {}", std::string(field_name(at.field))));
  }
  if (at.bus_off || excused_) following_ = false;
  if (!following_) return;
  check_model(at, now.tx);
  model_.sample(at.rx);
}

void WireJudge::check_model(const Trace &at, Level tx) {
  if (!at.transmitter) {
    if (tx != model_.drive())
      break_rule(fmt::format("{} in {}, where the node model is not",
                             tx == Level::kDominant ? "dominant" : "recessive",
                             std::string(field_name(at.field))));
    return;
  }
  if (tx == Level::kRecessive) return;
  const BitPlace place = model_.state();
  const bool start = place.field == Field::kIdle ||
                     (place.field == Field::kInt && place.index == 2) || place.field == Field::kSof;
  if (!start && !before_crc_end(place.field, place.is_stuff))
    break_rule("a transmitter is dominant where the node model sees " +
               std::string(field_name(place.field)));
}

}  // namespace vericansim::fuzz

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Assertions: see assertions.hpp.
#include "protocol/assertions.hpp"

#include <cstdlib>
#include <utility>

#include "model/frame_codec.hpp"

namespace vericansim {
namespace {

// TH-07: 6 equal bits, 8 of the delimiter, 3 of the intermission, 8 of the suspend time, and the
// bit in which the request may come.
constexpr unsigned kLongestSilence = 26;
constexpr unsigned kLongestIntegration = 12;

bool in_stuffed_part(const DutBit &bit) {
  return (bit.field >= Field::kSof && bit.field <= Field::kCrc) ||
         (bit.field == Field::kCrcDel && bit.stuff);
}

bool in_frame(const DutBit &bit) { return bit.field >= Field::kSof && bit.field <= Field::kEof; }

}  // namespace

Assertions::Assertions(CoreBench &bench) : bench_{bench}, watched_(bench.size()) {
  bench.on_bit = [this, then = std::move(bench.on_bit)](unsigned i, const DutBit &bit) {
    look(i, bit);
    if (then) then(i, bit);
  };
}

void Assertions::look(unsigned i, const DutBit &bit) {
  look_at_run(i, bit);
  look_at_dominant(i, bit);
  if (!watched_[i].first) look_at_counters(i, bit);
  look_at_events(i, bit);
  look_at_own_frame(i, bit);
  look_at_liveness(i, bit);
  watched_[i].before = bit;
  watched_[i].first = false;
}

// Never six equal bits in the stuffed part of an own frame (ST-01).
void Assertions::look_at_run(unsigned i, const DutBit &bit) {
  Watched &w = watched_[i];
  const bool joins = bit.started && bit.rx == Level::kDominant;  // the foreign SOF counts (ST-07)
  if (joins || bit.field == Field::kSof) {
    w.run = 1;
    w.run_level = Level::kDominant;
    return;
  }
  if (!bit.transmitter || !in_stuffed_part(bit)) return;
  w.run = bit.sent_level == w.run_level ? w.run + 1 : 1;
  w.run_level = bit.sent_level;
  if (w.run == 6) broken(i, "sends a sixth equal bit in its frame");
}

// Dominant only in an own frame, as an acknowledge, in an active flag or in an overload flag.
void Assertions::look_at_dominant(unsigned i, const DutBit &bit) {
  Watched &w = watched_[i];
  // Which kind of flag is decided by the state before the error (EF-05).
  const bool flag_begins =
      bit.field == Field::kErrFlag && (w.before.field != Field::kErrFlag || w.before.errors != 0);
  if (flag_begins) w.flag_active = bit.sent_level == Level::kDominant;
  if (bit.sent_level == Level::kRecessive) {
    if (bit.tx == Level::kDominant) broken(i, "drives dominant though it sends recessive");
    return;
  }
  const CoreConfig &config = bench_.dut(i).config();
  if (config.listen_only) broken(i, "sends dominant in listen-only mode");
  if (config.loop_back && bit.tx == Level::kDominant) broken(i, "drives the pin in loop-back");
  const bool own_frame = bit.transmitter && in_stuffed_part(bit);
  const bool acknowledge = !bit.transmitter && bit.field == Field::kAck;
  const bool error_flag = bit.field == Field::kErrFlag && w.flag_active;
  if (!own_frame && !acknowledge && !error_flag && bit.field != Field::kOvlFlag) {
    broken(i, "sends dominant in " + std::string{field_name(bit.field)});
  }
}

// FC-01: at most one step in a bit, of the counter that belongs to the role, and of a legal size.
void Assertions::look_at_counters(unsigned i, const DutBit &bit) {
  const DutBit &before = watched_[i].before;
  if (bit.bus_off || before.bus_off) {
    if (bit.bus_off && before.bus_off && bit.rec != before.rec) broken(i, "moves REC in bus-off");
    return;
  }
  const int tec = static_cast<int>(bit.tec) - static_cast<int>(before.tec);
  const int rec = static_cast<int>(bit.rec) - static_cast<int>(before.rec);
  if (tec != 0 && rec != 0) broken(i, "moves both counters in one bit");
  if (tec != 0 && !bit.transmitter) broken(i, "moves TEC as a receiver");
  if (rec != 0 && bit.transmitter) broken(i, "moves REC as a transmitter");
  if (tec != 0 && tec != 8 && tec != -1) broken(i, "moves TEC by " + std::to_string(tec));
  const bool set_back = before.rec >= 128 && bit.rec >= 119 && bit.rec <= 127;
  const bool holds = before.rec >= 128 && bit.rec >= 128;
  if (rec != 0 && rec != 1 && rec != 8 && rec != -1 && !set_back && !holds) {
    broken(i, "moves REC by " + std::to_string(rec));
  }
}

void Assertions::look_at_events(unsigned i, const DutBit &bit) {
  if (bit.delivered && (bit.field != Field::kEof || bit.left != 1)) {
    broken(i, "delivers elsewhere than at EOF6");
  }
  if (bit.sent && (bit.field != Field::kEof || bit.left != 0 || !bit.transmitter)) {
    broken(i, "reports success elsewhere than at its own EOF7");
  }
  if (bit.sent && bit.failed) broken(i, "reports success and failure of one attempt");
  if (bit.bus_off && (bit.delivered || bit.started)) broken(i, "takes part in bus-off");
}

// A frame that counts as sent stands on the wire with the right stuff bits and CRC: both registers
// began afresh with its SOF (CR-05).
void Assertions::look_at_own_frame(unsigned i, const DutBit &bit) {
  std::vector<Level> &frame = watched_[i].own_frame;
  if (bit.field == Field::kSof || (bit.started && bit.field != Field::kSof)) frame.clear();
  if (in_frame(bit) || bit.started) frame.push_back(bit.rx);
  if (!bit.sent) return;
  const DecodeResult decoded = decode_frame(frame);
  if (!decoded.frame) broken(i, "counts a frame as sent that is not valid on the wire");
}

void Assertions::look_at_liveness(unsigned i, const DutBit &bit) {
  Watched &w = watched_[i];
  const bool counts = bench_.dut(i).pending() && !bench_.dut(i).config().listen_only &&
                      !bit.bus_off && !in_frame(bit) && bit.rx == Level::kRecessive &&
                      bit.sent_level == Level::kRecessive;
  w.silence = counts ? w.silence + 1 : 0;
  if (w.silence > kLongestSilence) broken(i, "does not start its frame on a quiet bus");
  if (w.silence > kLongestIntegration && bit.field == Field::kInteg) {
    broken(i, "does not leave integration on a quiet bus");
  }
}

void Assertions::broken(unsigned i, const std::string &what) {
  if (broken_.size() >= kMaxReports) return;
  broken_.push_back("bit " + std::to_string(bench_.bits()) + ", DUT " + std::to_string(i) + " " +
                    what);
}

std::string Assertions::report() const {
  std::string text;
  for (const std::string &line : broken_) text += line + "\n";
  return text;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusDecoder: bit clock, flags, delimiters and intermission. Frames are in bus_decoder_frame.cpp.
#include "model/bus_decoder.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

namespace vericansim {

BusDecoder::BusDecoder(const DecoderConfig &config, Sink sink)
    : config_(config), sink_(std::move(sink)) {
  if (config.bit_time <= 0 || config.bit_time > kSecond)
    throw std::invalid_argument("bit time must be above 0 and at most 1 s, got " +
                                std::to_string(config.bit_time) + " ps");
  if (config.sample_point < 1 || config.sample_point > 999) {
    throw std::invalid_argument("sample point must be 1..999 per mille, got " +
                                std::to_string(config.sample_point));
  }
  if (config.sync_jump < 0 || config.sync_jump > 500) {
    throw std::invalid_argument("synchronisation jump must be 0..500 per mille, got " +
                                std::to_string(config.sync_jump));
  }
  sample_offset_ = config.bit_time * config.sample_point / 1000;
  largest_shift_ = config.bit_time * config.sync_jump / 1000;
  if (config.starts_idle) stage_ = Stage::kIdle;
}

void BusDecoder::on_level(Time time, Level level) {
  if (first_) {
    bit_start_ = time;
    first_ = false;
  }
  advance(time);
  if (level == line_) return;
  line_ = level;
  if (level == Level::kDominant) synchronise(time);
}

void BusDecoder::finish(Time time) {
  if (!first_) advance(time);
}

std::optional<Time> BusDecoder::under_way() const {
  switch (stage_) {
    case Stage::kIntegrate:
    case Stage::kIdle:
    case Stage::kIntermission: return std::nullopt;
    case Stage::kStuffed:
    case Stage::kTail: return frame_.start;
    case Stage::kFlag:
    case Stage::kSilence:
    case Stage::kDelimiter: break;
  }
  const bool of_frame = trouble_.kind == BusEventKind::kErrorFrame && trouble_.field != Field::kDel;
  return of_frame ? trouble_.frame_start : trouble_.start;
}

BusEventKind BusDecoder::kind_under_way() const {
  const bool frame = stage_ == Stage::kStuffed || stage_ == Stage::kTail;
  return frame ? BusEventKind::kFrame : trouble_.kind;
}

bool BusDecoder::before_ack_delimiter() const {
  if (stage_ == Stage::kStuffed) return true;
  // The edge into the delimiter is the last of a good frame, and a waveform may end with it.
  const bool begun = count_ == 2 && frame_.acked && line_ == Level::kRecessive;
  return stage_ == Stage::kTail && count_ <= 2 && !begun;
}

/// A dominant level that lasts changes nothing but the length of the run: a bus that is stuck is
/// not stepped through. Takes the bits up to the last one before `time`.
void BusDecoder::skip_dominant(Time time) {
  const bool stuck = stage_ == Stage::kFlag || (stage_ == Stage::kIntegrate && count_ == 0);
  if (!stuck || line_ != Level::kDominant || sampled_ != Level::kDominant || !sampled_this_bit_)
    return;
  const Time next = bit_start_ + config_.bit_time + sample_offset_;
  if (next >= time) return;
  const Time bits = (time - next) / config_.bit_time;
  bit_start_ += bits * config_.bit_time;
  if (stage_ != Stage::kFlag) return;
  constexpr Time kMost = std::numeric_limits<unsigned>::max();
  run_ = static_cast<unsigned>(std::min(kMost, static_cast<Time>(run_) + bits));
}

/// Takes every sample before `time` with the present level. Idle time and a stuck bus are skipped,
/// not stepped.
void BusDecoder::advance(Time time) {
  while (true) {
    if (stage_ == Stage::kIdle && line_ == Level::kRecessive) {
      sampled_ = Level::kRecessive;
      sync_armed_ = true;
      return;
    }
    skip_dominant(time);
    const Time next = bit_start_ + (sampled_this_bit_ ? config_.bit_time : 0) + sample_offset_;
    if (next >= time) return;
    if (sampled_this_bit_) bit_start_ += config_.bit_time;
    sampled_this_bit_ = true;
    sampled_ = line_;
    if (sampled_ == Level::kRecessive) sync_armed_ = true;
    sample();
  }
}

/// Moves the bit grid to a falling edge: at once between frames, by at most the jump width within.
void BusDecoder::synchronise(Time time) {
  if (!sync_armed_) return;
  sync_armed_ = false;
  const bool free_bus = stage_ == Stage::kIdle || stage_ == Stage::kIntegrate ||
                        (stage_ == Stage::kIntermission && count_ > 0);
  if (free_bus) {
    bit_start_ = time;
    sampled_this_bit_ = false;
    return;
  }
  // The last sample was recessive, so this edge belongs to the boundary that follows it.
  const Time error = time - (bit_start_ + config_.bit_time);
  bit_start_ += std::clamp(error, -largest_shift_, largest_shift_);
}

void BusDecoder::sample() {
  switch (stage_) {
    case Stage::kIntegrate:
      count_ = sampled_ == Level::kRecessive ? count_ + 1 : 0;
      if (count_ != 11) break;
      stage_ = Stage::kIdle;
      at_rest_since_ = bit_start_ + config_.bit_time;
      break;
    case Stage::kIdle:
      if (sampled_ == Level::kDominant) start_frame();
      break;
    case Stage::kStuffed: sample_stuffed(); break;
    case Stage::kTail: sample_tail(); break;
    case Stage::kFlag: sample_flag(); break;
    case Stage::kSilence: sample_silence(); break;
    case Stage::kDelimiter: sample_delimiter(); break;
    case Stage::kIntermission: sample_intermission(); break;
  }
}

void BusDecoder::integrate() {
  stage_ = Stage::kIntegrate;
  count_ = sampled_ == Level::kRecessive ? 1 : 0;
}

/// The bit just sampled shows an error or overload condition. run_ holds the equal bits up to it.
void BusDecoder::condition(BusEventKind kind, BusProblem problem, Field field, unsigned index) {
  trouble_ = BusEvent{};
  trouble_.kind = kind;
  trouble_.start = bit_start_;
  trouble_.problem = problem;
  trouble_.field = field;
  trouble_.index = static_cast<std::uint8_t>(index);
  trouble_.acked = frame_.acked;
  trouble_.frame_start = frame_.start;
  count_ = 0;
  stage_ = sampled_ == Level::kDominant ? Stage::kFlag : Stage::kSilence;
}

/// A dominant run, six bits and more if somebody flagged. A shorter one is a disturbance that only
/// the decoder saw, or that no node answers: it waits for the bus to come to rest.
void BusDecoder::sample_flag() {
  if (sampled_ == Level::kDominant) {
    if (run_ != std::numeric_limits<unsigned>::max()) ++run_;
    return;
  }
  trouble_.flag_bits = run_;
  if (trouble_.without_end()) {
    emit(trouble_, bit_start_);
    return integrate();
  }
  stage_ = Stage::kDelimiter;
  count_ = 1;  // DEL1
}

/// After a recessive violation: an active flag, or the six recessive bits of a passive one (EF-02).
void BusDecoder::sample_silence() {
  if (sampled_ == Level::kDominant) {
    run_ = 1;
    stage_ = Stage::kFlag;
    return;
  }
  if (++count_ < 6) return;
  stage_ = Stage::kDelimiter;
  count_ = 0;
}

void BusDecoder::sample_delimiter() {
  if (sampled_ == Level::kRecessive) {
    if (++count_ < 8) return;
    emit(trouble_, bit_start_ + config_.bit_time);
    stage_ = Stage::kIntermission;
    count_ = 0;
    return;
  }
  run_ = 1;
  if (count_ == 0) {  // instead of DEL1 after a passive flag: tolerated (EF-08)
    stage_ = Stage::kFlag;
    return;
  }
  const unsigned index = count_ - 1;  // DEL2 is index 0 of kDel
  emit(trouble_, bit_start_);
  if (count_ == 7) {
    condition(BusEventKind::kOverloadFrame, BusProblem::kNone, Field::kDel, index);
  } else {
    condition(BusEventKind::kErrorFrame, BusProblem::kForm, Field::kDel, index);
  }
}

void BusDecoder::sample_intermission() {
  if (sampled_ == Level::kRecessive) {
    if (++count_ == 3) stage_ = Stage::kIdle;
    return;
  }
  run_ = 1;
  if (count_ == 2) return start_frame();  // IF-05
  condition(BusEventKind::kOverloadFrame, BusProblem::kNone, Field::kInt, count_);
}

void BusDecoder::emit(BusEvent &event, Time end) {
  event.end = end;
  if (event.kind == BusEventKind::kFrame) ++frames_;
  if (sink_) sink_(event);
}

namespace {

std::string frame_text(const BusEvent &event) {
  char text[32];
  std::snprintf(text, sizeof text, event.frame.extended ? "%08X" : "%03X", event.frame.id);
  std::string out = text;
  std::snprintf(text, sizeof text, " [%u]", event.frame.dlc);
  out += text;
  if (event.frame.remote) out += " remote";
  for (unsigned i = 0; i < event.frame.payload_size(); ++i) {
    std::snprintf(text, sizeof text, " %02X", event.frame.data[i]);
    out += text;
  }
  return out + (event.acked ? "" : " (no acknowledge)");
}

}  // namespace

std::string to_string(const BusEvent &event) {
  constexpr const char *kProblems[] = {"", "stuff ", "form ", "CRC "};
  char text[160];
  std::snprintf(text, sizeof text, "%.3f us ", static_cast<double>(event.start) / kMicrosecond);
  std::string out = text;
  if (event.kind == BusEventKind::kFrame) return out + "frame " + frame_text(event);
  if (event.kind == BusEventKind::kBadFrame)
    return out + "frame with CRC error " + frame_text(event);
  const bool overload = event.kind == BusEventKind::kOverloadFrame;
  std::snprintf(text, sizeof text, "%sat %s %u, flag of %u bits",
                kProblems[static_cast<unsigned>(event.problem)],
                std::string(field_name(event.field)).c_str(), event.index + 1u, event.flag_bits);
  return out + (overload ? "overload frame " : "error frame ") + text;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusDecoder: the waveform of a bus to frames, error frames and overload frames with times and
// places.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bus/field.hpp"
#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// What a BusDecoder looks at, and how.
struct DecoderConfig {
  Time bit_time = kMicrosecond;  ///< nominal, ps; above 0, at most 1 s
  int sample_point = 800;        ///< per mille of the bit, 1..999
  int sync_jump = 200;           ///< largest shift of the bit grid by one edge, per mille, 0..500
  bool starts_idle = false;      ///< true: the first falling edge is a SOF; false: IN-01 first
};

/// What went wrong on the wire.
enum class BusProblem : std::uint8_t {
  kNone,
  kStuff,  ///< sixth equal bit
  kForm,   ///< dominant CRC delimiter, ACK delimiter, EOF1..EOF6 or DEL2..DEL7
  kCrc,    ///< CRC differs; flagged by nobody, or from EOF1 on
};

enum class BusEventKind : std::uint8_t {
  kFrame,          ///< valid for receivers: no error up to EOF6
  kErrorFrame,     ///< a violation, the flag that shows it or follows it, and its delimiter
  kOverloadFrame,  ///< d at EOF7, INT1, INT2 or DEL8, and what follows
  kBadFrame,       ///< complete frame with a CRC error that nobody flagged
};

/// One thing seen on the bus. Times are on the decoder's bit grid.
struct BusEvent {
  BusEventKind kind = BusEventKind::kFrame;
  Time start =
      0;  ///< frames: of SOF. Error and overload frames: of the bit that showed the condition
  Time end = 0;  ///< end of EOF7, or of the delimiter
  // kFrame, kBadFrame
  Frame frame;
  bool acked = false;           ///< dominant ACK slot
  bool eof7_dominant = false;   ///< valid for receivers, repeated by the transmitter (VA-03)
  unsigned stuffed_length = 0;  ///< bits SOF..CRC0 with all stuff bits
  // kErrorFrame, kOverloadFrame, kBadFrame
  BusProblem problem = BusProblem::kNone;
  Field field = Field::kIdle;  ///< place of the bit that showed the condition
  std::uint8_t index = 0;
  unsigned flag_bits = 0;  ///< length of the dominant run that is the flag; 0: passive flag, unseen
  Time frame_start =
      0;  ///< SOF of the frame that an error frame destroyed; of no meaning after DEL

  /// Too short for a flag: the decoder waits for the bus to come to rest.
  [[nodiscard]] bool without_end() const { return flag_bits != 0 && flag_bits < 6; }
};

/// One line for a person, for example "12.000 us frame 123 [1] 55 acked".
[[nodiscard]] std::string to_string(const BusEvent &event);

/// Passive decoder with its own bit clock. Feed levels in time order; events come out by callback.
///
/// Costs O(1) for each bit of traffic and nothing for idle time; keeps no waveform.
class BusDecoder {
 public:
  using Sink = std::function<void(const BusEvent &)>;

  /// Throws std::invalid_argument if `config` is out of range.
  BusDecoder(const DecoderConfig &config, Sink sink);

  /// From `time` (ps, never decreasing) on the bus has `level`. A repeated level is no edge.
  void on_level(Time time, Level level);
  /// The bus keeps its level until `time`; samples up to there are taken. More levels may follow.
  void finish(Time time);

  /// Where the frame began, or the overload frame, that is not at its end so far; unset: none is on
  /// the bus.
  [[nodiscard]] std::optional<Time> under_way() const;
  /// What it is, if something is.
  [[nodiscard]] BusEventKind kind_under_way() const;

  /// Since when the bus is at rest; unset while eleven recessive bits are waited for, at the
  /// beginning and behind what the decoder has not understood.
  [[nodiscard]] std::optional<Time> at_rest_since() const {
    if (stage_ == Stage::kIntegrate) return std::nullopt;
    return at_rest_since_;
  }

  /// Whether the frame on the bus has not come to its ACK delimiter: how it ends is open. Behind it
  /// recessive bits alone end it.
  [[nodiscard]] bool before_ack_delimiter() const;

  /// Frames seen so far.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }

 private:
  enum class Stage : std::uint8_t {
    kIntegrate,  ///< counts 11 recessive bits
    kIdle,
    kStuffed,    ///< SOF..final stuff bit
    kTail,       ///< CRC delimiter..EOF7, counted by count_
    kFlag,       ///< dominant run
    kSilence,    ///< recessive violation: a flag or a passive flag follows
    kDelimiter,  ///< DEL2..DEL8
    kIntermission,
  };

  struct Place {
    Field field;
    unsigned index;
  };

  void advance(Time time);
  void skip_dominant(Time time);
  void synchronise(Time time);
  void sample();
  void sample_stuffed();
  void frame_bit(bool bit);
  void finish_header();
  void sample_tail();
  void finish_frame(bool eof7_dominant);
  void sample_flag();
  void sample_silence();
  void sample_delimiter();
  void sample_intermission();
  void start_frame();
  void condition(BusEventKind kind, BusProblem problem, Field field, unsigned index);
  void integrate();
  void emit(BusEvent &event, Time end);
  [[nodiscard]] Place locate(unsigned number) const;

  DecoderConfig config_;
  Sink sink_;
  Time sample_offset_;
  Time largest_shift_;

  // Bit clock
  Level line_ = Level::kRecessive;
  Level sampled_ = Level::kRecessive;
  Time bit_start_ = 0;
  Time at_rest_since_ = 0;
  bool sampled_this_bit_ = false;
  bool sync_armed_ = true;
  bool first_ = true;

  // Frame in progress
  Stage stage_ = Stage::kIntegrate;
  unsigned count_ = 0;  ///< bits within the stage
  unsigned run_ = 0;    ///< equal bits, for destuffing and for the length of flags
  Level run_level_ = Level::kDominant;
  unsigned stuffed_bits_ = 0;
  unsigned plain_bits_ = 0;   ///< destuffed bits so far, SOF included
  unsigned header_end_ = 0;   ///< destuffed bits up to DLC0
  unsigned plain_end_ = 0;    ///< destuffed bits up to CRC0; 0 until known
  std::uint64_t header_ = 0;  ///< destuffed bits SOF..DLC0
  std::uint16_t crc_ = 0;
  BusEvent frame_;
  BusEvent trouble_;
  std::uint64_t frames_ = 0;
};

}  // namespace vericansim

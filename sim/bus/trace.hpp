// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Trace: what the core tells an observer (trace_o, layout in rtl/can_pkg.sv), as a struct.
#pragma once

#include <cstdint>

#include "bus/field.hpp"
#include "bus/types.hpp"

namespace vericansim {

/// Error kinds as bits of Trace::errors, can_pkg::Err*.
enum TraceError : std::uint8_t {
  kErrStuff = 1 << 0,
  kErrForm = 1 << 1,
  kErrCrc = 1 << 2,
  kErrAck = 1 << 3,
  kErrBit0 = 1 << 4,
  kErrBit1 = 1 << 5,
};

/// One word of trace_o. While `sample` is set the levels and the place are those of the bit being
/// sampled; errors and the event flags are pulses in the clock after, the counters follow one
/// later.
struct Trace {
  bool sample = false;
  bool boundary = false;  ///< last clock of the bit
  Level rx = Level::kRecessive;
  Level tx = Level::kRecessive;
  bool transmitter = false;  ///< RO-01
  bool stuff = false;        ///< the bit is a stuff bit
  Field field = Field::kInteg;
  std::uint8_t left = 0;    ///< bits of the field that follow
  std::uint8_t errors = 0;  ///< TraceError
  bool rx_valid = false;    ///< VA-01
  bool tx_ok = false;       ///< VA-02
  bool tx_fail = false;
  bool start = false;    ///< the next bit is ID28
  bool passive = false;  ///< FC-11
  bool running = false;
  bool bus_off = false;  ///< then tec counts recovery sequences (FC-13)
  std::uint8_t tec = 0;
  std::uint8_t rec = 0;

  friend bool operator==(const Trace &, const Trace &) = default;
};

/// Single bits of the raw word, for code that looks at every clock.
inline constexpr std::uint64_t kTraceSample = 1ULL << 48;
inline constexpr std::uint64_t kTraceBoundary = 1ULL << 47;
inline constexpr std::uint64_t kTraceTx = 1ULL << 45;
inline constexpr std::uint64_t kTraceStart = 1ULL << 22;
inline constexpr std::uint64_t kTraceRunning = 1ULL << 20;
inline constexpr std::uint64_t kTraceEvents =
    0xFFC00000ULL;  ///< errors, rx_valid, tx_ok, tx_fail, start

constexpr Field trace_field(std::uint64_t word) { return static_cast<Field>((word >> 38) & 0x1F); }
constexpr std::uint8_t trace_left(std::uint64_t word) { return (word >> 32) & 0x3F; }
constexpr bool trace_stuff(std::uint64_t word) { return ((word >> 43) & 1) != 0; }

/// Decodes a raw word.
constexpr Trace decode_trace(std::uint64_t word) {
  const auto bit = [word](int n) { return ((word >> n) & 1) != 0; };
  Trace t;
  t.sample = bit(48);
  t.boundary = bit(47);
  t.rx = static_cast<Level>(bit(46));
  t.tx = static_cast<Level>(bit(45));
  t.transmitter = bit(44);
  t.stuff = bit(43);
  t.field = trace_field(word);
  t.left = trace_left(word);
  t.errors = (word >> 26) & 0x3F;
  t.rx_valid = bit(25);
  t.tx_ok = bit(24);
  t.tx_fail = bit(23);
  t.start = bit(22);
  t.passive = bit(21);
  t.running = bit(20);
  t.bus_off = bit(16);
  t.tec = (word >> 8) & 0xFF;
  t.rec = word & 0xFF;
  return t;
}

/// One finished bit of a node: levels and place at its sample point, and what followed from it.
struct BitRecord {
  Time time = 0;  ///< of the sample point (the clock edge that takes the sample), ps
  Trace at;       ///< as sampled: rx, tx, transmitter, stuff, field, left
  Trace after;    ///< what followed: errors and events of the clocks since, counters and states
};

/// Puts the records of a node together from its trace, word by word.
class BitRecorder {
 public:
  /// Clocks from the sample point until the counters have followed.
  static constexpr unsigned kSettle = 2;

  /// Takes the word after a clock edge; `next_edge` is the time of the edge to come. True if that
  /// has completed record().
  bool clocked(std::uint64_t word, Time next_edge) {
    bool complete = false;
    if (wait_ != 0) {
      events_ |= word & kTraceEvents;
      complete = --wait_ == 0;
      if (complete) record_.after = decode_trace((word & ~kTraceEvents) | events_);
    }
    if ((word & kTraceSample) != 0) {
      record_.time = next_edge;
      record_.at = decode_trace(word);
      events_ = 0;
      wait_ = kSettle;
    }
    return complete;
  }
  [[nodiscard]] const BitRecord &record() const { return record_; }
  /// True while a record waits for what follows from its sample.
  [[nodiscard]] bool pending() const { return wait_ != 0; }

 private:
  BitRecord record_;
  std::uint64_t events_ = 0;
  unsigned wait_ = 0;
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WireJudge: whether a core whose registers are written at random may drive what it drives, and
// whether the other nodes of its bus are left alone.
#pragma once

#include <cstdint>
#include <string>

#include "bus/trace.hpp"
#include "model/bus_decoder.hpp"
#include "model/node_model.hpp"

namespace vericansim::fuzz {

/// What software has made of the core, as far as the bus can tell; read when it goes on the bus.
struct CoreSetup {
  bool listen_only = false;
  bool loop_back = false;
  bool sane_timing = true;  ///< the bit timing of the bus
};

/// Judges every clock. The first broken rule stays.
///
/// Always: no dominant level while the core is off the bus, in listen-only mode, in loop-back or
/// bus-off; and at a sample point only where the trace names a place in which a node may be
/// dominant. With the bit timing of the bus, moreover, bit by bit beside a NodeModel that only
/// receives: where the core is no transmitter its level is that of the model, and a transmitter is
/// dominant only where the model sees a frame up to its CRC, or its start. And the decoder sees no
/// error and no overload frame.
///
/// Excused, until the bus has rested: a frame of the core cut by a reset, two frames with the same
/// identifier, and what the bench itself does (excuse()).
class WireJudge {
 public:
  WireJudge(Time bit_time, unsigned clocks_per_bit);

  /// After each clock edge: the core's trace and pin, the level of the wire during the clock before
  /// it, a peer's trace words (for frames that both of them send), and the time in clocks.
  struct Clock {
    std::uint64_t core = 0;
    Level tx = Level::kRecessive;
    Level wire = Level::kRecessive;
    std::uint64_t peers[2] = {};
  };
  void clock(const Clock &now);
  /// The core has gone on the bus with this set-up.
  void joined(const CoreSetup &setup);
  /// It has left the bus; `reset`: by a reset, which may cut its frame.
  void left(bool reset);
  /// Errors from now on are the bench's doing, until the bus has rested.
  void excuse() { excused_ = true; }

  [[nodiscard]] bool clean() const { return fault_.empty(); }
  /// What was broken and when; empty if nothing was.
  [[nodiscard]] const std::string &fault() const { return fault_; }
  /// Frames seen on the wire.
  [[nodiscard]] std::uint64_t frames() const { return decoder_.frames(); }
  /// Error and overload frames that were excused.
  [[nodiscard]] std::uint64_t excused() const { return excused_count_; }
  [[nodiscard]] std::uint64_t dominant_samples() const { return dominant_; }

 private:
  void on_event(const BusEvent &event);
  void on_sample(const Clock &now, const Trace &at);
  void follow_from_idle(const Trace &at);
  void check_model(const Trace &at, Level tx);
  void break_rule(const std::string &what);

  Time clock_time_;
  BusDecoder decoder_;
  NodeModel model_;
  CoreSetup setup_;
  Time now_ = 0;
  Level wire_ = Level::kRecessive;
  unsigned quiet_ = 0;  // recessive clocks in a row
  unsigned rest_;       // so many of them are a rested bus
  bool on_bus_ = false;
  bool following_ = false;  // the model goes beside the core
  bool was_transmitter_ = false;
  bool flag_active_ = false;  // the error flag of the last error is an active one
  bool excused_ = true;       // until the bus has rested for the first time
  std::uint64_t excused_count_ = 0;
  std::uint64_t dominant_ = 0;
  std::string fault_;
};

}  // namespace vericansim::fuzz

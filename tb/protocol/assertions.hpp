// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Assertions: what must hold in every bit of every test, whatever the stimulus (rules TH-06,
// TH-07).
#pragma once

#include <string>
#include <vector>

#include "protocol/core_bench.hpp"

namespace vericansim {

/// Watches every bit of a bench; hangs itself in front of what is in on_bit already, so construct
/// it after the Lockstep. It needs no model: it looks at levels, places and counters alone.
class Assertions {
 public:
  explicit Assertions(CoreBench &bench);

  [[nodiscard]] bool hold() const { return broken_.empty(); }
  /// One sentence for each broken assertion, the first kMaxReports of them; empty if none is.
  [[nodiscard]] std::string report() const;
  /// The counters of DUT `i` were set from outside: the next difference is no step.
  void counters_preset(unsigned i) { watched_[i].first = true; }

 private:
  static constexpr std::size_t kMaxReports = 10;

  struct Watched {
    DutBit before;      // the bit before
    bool first = true;  // there is none yet
    unsigned run = 0;   // equal bits sent in the own frame, up to the last bit
    Level run_level = Level::kDominant;
    bool flag_active = false;      // the flag under way is dominant
    unsigned silence = 0;          // TH-07: recessive bits between frames while a request waits
    std::vector<Level> own_frame;  // bits of the own frame as seen, SOF..EOF7
  };

  void look(unsigned i, const DutBit &bit);
  void look_at_run(unsigned i, const DutBit &bit);
  void look_at_dominant(unsigned i, const DutBit &bit);
  void look_at_counters(unsigned i, const DutBit &bit);
  void look_at_events(unsigned i, const DutBit &bit);
  void look_at_own_frame(unsigned i, const DutBit &bit);
  void look_at_liveness(unsigned i, const DutBit &bit);
  void broken(unsigned i, const std::string &what);

  CoreBench &bench_;
  std::vector<Watched> watched_;
  std::vector<std::string> broken_;
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimingReference: bit timing and synchronisation quantum by quantum, from sections 13 and 14 of
// the rule book.
#pragma once

#include "bus/types.hpp"
#include "node/bit_timing.hpp"

namespace vericansim {

/// A judge of bit timing. It keeps the length of the running bit's segments as numbers and changes
/// them as the rules say; it knows nothing of how a controller counts.
class TimingReference {
 public:
  /// What one quantum was.
  struct Quantum {
    bool sample = false;            ///< the sample point stands at its end
    Level bit = Level::kRecessive;  ///< then: the value of the bit
    bool last = false;              ///< the next level goes out at its end
    bool edge = false;              ///< it holds an edge that may synchronise
  };

  explicit TimingReference(const BitTiming &timing, bool triple_sampling = false)
      : timing_{timing}, triple_{triple_sampling} {}

  /// One quantum. `bus` is the level at its end; `sent` and `hard` hold for the bit that the node
  /// was in when the quantum began: the level it sends, and whether SY-05 lets it synchronise hard.
  Quantum step(Level bus, Level sent, bool hard);

  /// Segments of the bit under way, for reports.
  [[nodiscard]] int position() const { return position_; }

 private:
  void synchronise_before_sample(Level sent, bool hard);
  [[nodiscard]] bool synchronise_after_sample(bool hard);
  void begin_bit();
  [[nodiscard]] int sample_position() const { return static_cast<int>(timing_.prop) + ps1_; }
  [[nodiscard]] Level majority(Level bus) const;

  BitTiming timing_;
  bool triple_;
  int position_ = 0;  // quanta since SYNC_SEG
  int ps1_ = static_cast<int>(timing_.ps1);
  int ps2_ = static_cast<int>(timing_.ps2);
  bool armed_ = true;
  Level before_ = Level::kRecessive;  // at the end of the quantum before
  Level before_that_ = Level::kRecessive;
};

}  // namespace vericansim

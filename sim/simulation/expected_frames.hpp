// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ExpectedFrames: what the frames of a scenario look like as long as nothing disturbs them.
#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include "scenario/scenario.hpp"

namespace vericansim {

/// The frames that the traffic of a scenario puts on the bus while no fault has hit.
class ExpectedFrames {
 public:
  ExpectedFrames(const Scenario &scenario, double bitrate);

  /// All frames come from the scenario's traffic, for the whole of its duration, and clocks are so
  /// near that every bit of them is read as it was sent.
  [[nodiscard]] bool known() const { return known_; }
  /// Why no frame has this place, with what is allowed; empty if one may have it.
  [[nodiscard]] std::string missing(const PlaceSpec &place) const;

 private:
  [[nodiscard]] std::string missing_data(const PlaceSpec &place) const;

  bool known_ = false;
  bool extended_ = false;
  std::uint64_t count_ = 0;  // at most
  std::set<unsigned> data_;  // lengths in bits
  static constexpr std::uint64_t kAny = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults on a simulated bus, and what a report must say about each, from the rule book.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "bus/faults.hpp"
#include "model/frame.hpp"
#include "report/cause.hpp"

namespace vericansim {

inline constexpr NodeId kSenderNode = 0, kReceiverNode = 1;

/// A disturbed bit: what `victim` sees while `watched` is at a place.
struct Disturbance {
  NodeId watched = kSenderNode;
  Field field = Field::kData;
  unsigned index = 0;
  bool stuff = false;
  NodeId victim = kSenderNode;
  Effect effect = Effect::kFlip;
  std::optional<unsigned> frame = 1;  ///< none: in every frame
};

/// One case. The event looked at is the `event`-th of the report.
struct CauseCase {
  std::string name;
  Frame frame;
  std::vector<Disturbance> disturbances;
  std::string rule;
  std::string words;  ///< part of the sentence
  NodeId node = kSenderNode;
  int kind = 0;  ///< 0 error frame, 1 overload frame
  std::size_t event = 0;
};

[[nodiscard]] std::vector<CauseCase> cause_cases();

inline std::ostream &operator<<(std::ostream &out, const CauseCase &c) { return out << c.name; }

}  // namespace vericansim

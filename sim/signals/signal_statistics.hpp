// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the signals of a bus did: number, first and last value, limits and mean of each.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signals/database.hpp"
#include "signals/signal_codec.hpp"

namespace vericansim {

/// A signal that was on the bus.
struct SignalSummary {
  const SignalMessage *message = nullptr;
  std::uint64_t count = 0;       ///< frames that held it
  std::uint64_t no_numbers = 0;  ///< of them, those in which a floating-point signal was NaN
  SignalValue first, last;
  SignalValue least, most;  ///< by their physical values
  double sum = 0;
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

/// All of them.
struct SignalReport {
  std::shared_ptr<const Database> database;  ///< which the others refer to; nullptr: no databases
  std::vector<SignalSummary> signals;        ///< in the order of the database
  std::uint64_t known = 0;                   ///< frames of its messages
  std::uint64_t unknown = 0;                 ///< others

  /// The summary of a signal that was seen, or nullptr.
  [[nodiscard]] const SignalSummary *find(const Signal &signal) const;
};

/// Collects them frame by frame.
class SignalStatistics {
 public:
  explicit SignalStatistics(std::shared_ptr<const Database> database);

  /// A frame of `message`, which is nullptr for those that the database does not have.
  void add(const SignalMessage *message, const std::vector<SignalValue> &values);
  [[nodiscard]] SignalReport report() const;

 private:
  std::shared_ptr<const Database> database_;
  std::unordered_map<const Signal *, SignalSummary> signals_;
  std::uint64_t known_ = 0, unknown_ = 0;
};

}  // namespace vericansim

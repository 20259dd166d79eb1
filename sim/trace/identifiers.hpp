// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// IdentifierTable: what there is to say of each identifier of some traffic.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <tuple>

#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// The frames of one identifier. Periods are the distances of neighbours.
struct IdentifierRow {
  std::uint64_t count = 0;
  Time first = 0, last = 0;  ///< times of the first and the last frame, ps
  Time shortest_period = 0, longest_period = 0;
  double mean_period = 0;  ///< ps; 0 with a single frame
  double square_sum = 0;   ///< of the differences from the mean, ps^2
  Frame last_frame;
  std::array<bool, 8> changed{};  ///< bytes that were not the same in all data frames

  /// Standard deviation of the periods (of all of them, not of a sample), ps.
  [[nodiscard]] double jitter() const;
};

/// Rows by interface and identifier; remote frames have rows of their own.
class IdentifierTable {
 public:
  /// Interface, remote, extended, identifier.
  using Key = std::tuple<std::string, bool, bool, std::uint32_t>;

  /// The next frame; times may go back a little, as those of several interfaces do.
  void add(const std::string &channel, const Frame &frame, Time time);
  [[nodiscard]] const std::map<Key, IdentifierRow> &rows() const { return rows_; }

 private:
  std::map<Key, IdentifierRow> rows_;
};

/// A table for people: times in ms and s; a changed byte of the last data is marked with '*'.
[[nodiscard]] std::string to_text(const IdentifierTable &table);
/// A list of objects, times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const IdentifierTable &table);
/// A header and a line for each identifier, times in seconds.
void write_csv(const IdentifierTable &table, std::ostream &out);

}  // namespace vericansim

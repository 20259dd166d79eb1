// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LogBuilder: what all readers of recordings do with the frames that they find.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "trace/log.hpp"
#include "trace/text.hpp"

namespace vericansim {

/// Collects entries with absolute times and makes a CanLog of them.
class LogBuilder {
 public:
  /// Appends a frame at `ns`; throws InputError at `place` if that is too far from the first one.
  void add(std::int64_t ns, LogEntry entry, const text::Place &place);
  /// The same for what is no classical frame.
  void add(std::int64_t ns, ForeignEntry entry, const text::Place &place);
  /// Counts a line or packet that holds no frame.
  void skip() { ++log_.skipped; }
  /// Notes what a reader should know.
  void warn(std::string text) { log_.warnings.push_back(std::move(text)); }
  /// How many lines or packets there were.
  [[nodiscard]] std::size_t size() const { return log_.entries.size() + log_.skipped; }
  /// The log, with times since its first classical frame (without one: since the first entry).
  /// `absolute`: times were since the Unix epoch.
  [[nodiscard]] CanLog finish(bool absolute);

 private:
  [[nodiscard]] Time since_first(std::int64_t ns, const text::Place &place);
  CanLog log_;
  bool empty_ = true;
  std::int64_t first_ns_ = 0;
};

/// The way that "Rx" or "Tx" in a recording tells; throws InputError if it is neither.
[[nodiscard]] Direction direction_of(std::string_view word, const text::Place &place);

}  // namespace vericansim

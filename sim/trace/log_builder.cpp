// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LogBuilder: see log_builder.hpp.
#include "trace/log_builder.hpp"

#include <utility>

#include "trace/input_error.hpp"

namespace vericansim {

Time LogBuilder::since_first(std::int64_t ns, const text::Place &place) {
  // Half of the range, so that the distance of any two entries fits, too.
  constexpr std::int64_t kMost = std::numeric_limits<Time>::max() / kNanosecond / 2;
  if (std::exchange(empty_, false)) first_ns_ = ns;
  std::int64_t distance = 0;
  if (__builtin_sub_overflow(ns, first_ns_, &distance) || distance > kMost || distance < -kMost)
    text::fail(
        place,
        "time is more than 53 days from the first one; allowed: recordings of up to 53 days; "
        "split longer ones, also where their clock was set");
  return distance * kNanosecond;
}

void LogBuilder::add(std::int64_t ns, LogEntry entry, const text::Place &place) {
  entry.time = since_first(ns, place);
  log_.entries.push_back(std::move(entry));
}

void LogBuilder::add(std::int64_t ns, ForeignEntry entry, const text::Place &place) {
  entry.time = since_first(ns, place);
  entry.before = log_.entries.size();
  log_.others.push_back(std::move(entry));
  skip();
}

CanLog LogBuilder::finish(bool absolute) {
  const Time first = log_.entries.empty() ? 0 : log_.entries.front().time;
  for (LogEntry &entry : log_.entries) entry.time -= first;
  for (ForeignEntry &entry : log_.others) entry.time -= first;
  if (absolute) log_.start_ns = first_ns_ + first / kNanosecond;
  return std::move(log_);
}

Direction direction_of(std::string_view word, const text::Place &place) {
  if (word == "Rx") return Direction::kReceived;
  if (word == "Tx") return Direction::kSent;
  text::fail(place,
             "direction " + in_quotes(std::string(word)) + " is not allowed; allowed: Rx, Tx");
}

}  // namespace vericansim

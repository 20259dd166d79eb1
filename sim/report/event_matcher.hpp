// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EventMatcher: finds the node that began each error and overload frame of the wire.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "model/bus_decoder.hpp"
#include "report/cause.hpp"
#include "report/report_data.hpp"

namespace vericansim {

/// Puts together what the decoder sees on the wire and what nodes find. Each error or overload
/// frame of the decoder becomes one event; its cause is the first finding shortly before it. What
/// nodes find and the wire does not show (passive flags) becomes an event of its own.
class EventMatcher {
 public:
  /// Values of the column `e.kind`.
  enum Kind : std::uint8_t { kError = 0, kOverload = 1, kHidden = 2 };

  EventMatcher(Time bit_time, Time origin, ReportData &data)
      : bit_time_{bit_time}, origin_{static_cast<double>(origin)}, data_{data} {}

  /// A node has found something; nearly in the order of time.
  void find(const Finding &finding);
  /// The delimiter of a node ends at `time` (ps).
  void delimiter_ended(NodeId node, double time);
  /// The decoder has seen a frame, an error frame or an overload frame.
  void take(const BusEvent &event);
  /// Nothing more comes.
  void finish();

 private:
  void flush_hidden(double before);
  void add(Kind kind, double start, double end, const Cause &cause);
  void add(Kind kind, const Finding &finding, const std::vector<Finding> &others, double end);
  [[nodiscard]] std::uint16_t intern(const Cause &cause);

  Time bit_time_;
  double origin_;
  ReportData &data_;
  std::deque<Finding> findings_;  // not yet part of an event
};

}  // namespace vericansim

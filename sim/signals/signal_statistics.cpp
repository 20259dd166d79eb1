// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Statistics of signals.
#include "signals/signal_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "signals/signal_range.hpp"

namespace vericansim {
namespace {

/// Widens the limits; a floating-point value that is no number gives way to any.
void keep(SignalSummary &summary, const SignalValue &value) {
  if (std::isnan(summary.least.value) || is_below(value, summary.least)) summary.least = value;
  if (std::isnan(summary.most.value) || is_below(summary.most, value)) summary.most = value;
}

}  // namespace

const SignalSummary *SignalReport::find(const Signal &signal) const {
  const auto found = std::find_if(signals.begin(), signals.end(),
                                  [&](const SignalSummary &s) { return s.last.signal == &signal; });
  return found == signals.end() ? nullptr : &*found;
}

SignalStatistics::SignalStatistics(std::shared_ptr<const Database> database)
    : database_{std::move(database)} {}

void SignalStatistics::add(const SignalMessage *message, const std::vector<SignalValue> &values) {
  ++(message != nullptr ? known_ : unknown_);
  for (const SignalValue &value : values) {
    SignalSummary &summary = signals_[value.signal];
    if (summary.count++ == 0) {
      summary.message = message;
      summary.first = summary.least = summary.most = value;
    }
    summary.last = value;
    summary.sum += value.value;
    if (std::isnan(value.value)) ++summary.no_numbers;
    keep(summary, value);
  }
}

SignalReport SignalStatistics::report() const {
  SignalReport report{database_, {}, known_, unknown_};
  for (const auto &message : database_->messages())
    for (const Signal &signal : message->signals)
      if (const auto found = signals_.find(&signal); found != signals_.end())
        report.signals.push_back(found->second);
  return report;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Statistics of signals.
#include "signals/signal_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace vericansim {
namespace {

/// Takes `value` if `better`; a floating-point signal that is no number gives way to any.
template <typename Better>
void keep(SignalValue &kept, const SignalValue &value, Better better) {
  if (std::isnan(kept.value) || better(value.value, kept.value)) kept = value;
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
    keep(summary.least, value, std::less<>{});
    keep(summary.most, value, std::greater<>{});
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

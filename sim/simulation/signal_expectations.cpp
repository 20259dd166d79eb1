// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Expectations of signals.
#include "simulation/signal_expectations.hpp"

#include <fmt/format.h>

#include "signals/signal_text.hpp"
#include "simulation/expectations.hpp"

namespace vericansim {
namespace {

/// All values of the signal. Not a number is in no range.
CheckResult check_all(const SignalExpectation &expect, const SignalSummary &seen) {
  CheckResult result{expect.name, to_text(*expect.signal, expect.all), number_text(seen.least),
                     expect.all.contains(seen.least) && expect.all.contains(seen.most)};
  if (seen.least.raw != seen.most.raw) result.seen += " to " + number_text(seen.most);
  if (seen.no_numbers != 0) {
    result.ok = false;
    result.seen += fmt::format(", nan in {} frames", seen.no_numbers);
  }
  return result;
}

/// One of its values.
CheckResult check_value(const std::string &what, const SignalValue &seen,
                        const SignalRange &range) {
  return {what, to_text(*seen.signal, range), to_text(seen), range.contains(seen)};
}

}  // namespace

std::vector<CheckResult> check_signals(const std::vector<SignalExpectation> &expect,
                                       const SignalReport &seen) {
  std::vector<CheckResult> results;
  for (const SignalExpectation &e : expect) {
    const SignalSummary *summary = seen.find(*e.signal);
    if (e.count)
      results.push_back(check_number(e.name + " count",
                                     summary != nullptr ? static_cast<double>(summary->count) : 0,
                                     *e.count));
    if (summary == nullptr) {
      if (!e.count || e.all.is_limited() || e.first || e.last || e.mean)
        results.push_back({e.name, "in a frame", "never there", false});
      continue;
    }
    if (e.all.is_limited()) results.push_back(check_all(e, *summary));
    if (e.first) results.push_back(check_value(e.name + " first", summary->first, *e.first));
    if (e.last) results.push_back(check_value(e.name + " last", summary->last, *e.last));
    if (e.mean) results.push_back(check_number(e.name + " mean", summary->mean(), *e.mean));
  }
  return results;
}

}  // namespace vericansim

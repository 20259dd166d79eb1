// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Expectations of signals.
#include "simulation/signal_expectations.hpp"

#include <cmath>

#include "signals/signal_text.hpp"
#include "simulation/expectations.hpp"

namespace vericansim {
namespace {

bool is_limited(const Range &range) { return !std::isinf(range.least) || !std::isinf(range.most); }

/// All values of the signal.
CheckResult check_all(const SignalExpectation &expect, const SignalSummary &seen) {
  CheckResult result = check_number(expect.name, seen.least.value, expect.all);
  result.ok = expect.all.contains(seen.least.value) && expect.all.contains(seen.most.value);
  result.seen = number_text(seen.least);
  if (seen.least.raw != seen.most.raw) result.seen += " to " + number_text(seen.most);
  return result;
}

/// One of its values.
CheckResult check_value(const std::string &what, const SignalValue &seen, const Range &range) {
  CheckResult result = check_number(what, seen.value, range);
  result.seen = to_text(seen);
  return result;
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
      if (!e.count || is_limited(e.all) || e.first || e.last || e.mean)
        results.push_back({e.name, "in a frame", "never there", false});
      continue;
    }
    if (is_limited(e.all)) results.push_back(check_all(e, *summary));
    if (e.first) results.push_back(check_value(e.name + " first", summary->first, *e.first));
    if (e.last) results.push_back(check_value(e.name + " last", summary->last, *e.last));
    if (e.mean) results.push_back(check_number(e.name + " mean", summary->mean(), *e.mean));
  }
  return results;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EventMatcher: see event_matcher.hpp.
#include "report/event_matcher.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace vericansim {
namespace {

// A flag of six bits breaks a rule of the frame in its sixth bit at the latest (EF-07).
constexpr Time kLatestSign = 8;     // bits
constexpr double kErrorFrame = 15;  // bits: the one with the error, flag, delimiter

}  // namespace

void EventMatcher::find(const Finding &finding) {
  auto place = findings_.end();
  while (place != findings_.begin() && (place - 1)->bit.time > finding.bit.time) --place;
  findings_.insert(place, finding);
}

void EventMatcher::delimiter_ended(NodeId node, double time) {
  for (Finding &finding : findings_)
    if (finding.node == node && finding.end == 0) finding.end = time;
}

void EventMatcher::take(const BusEvent &event) {
  if (event.kind == BusEventKind::kFrame) {
    // Its last bit may be the first sign of an overload frame.
    flush_hidden(static_cast<double>(event.end - 2 * bit_time_));
    return;
  }
  flush_hidden(static_cast<double>(event.start - kLatestSign * bit_time_));
  const Kind kind = event.kind == BusEventKind::kOverloadFrame ? kOverload : kError;
  const auto belongs = [&](const Finding &f) { return f.bit.time <= event.end; };
  // A dominant level in a delimiter begins another error or overload frame.
  const auto follows = [&](const Finding &f) { return belongs(f) && f.bit.field != Field::kDel; };
  if (findings_.empty() || !belongs(findings_.front())) {
    add(kind, static_cast<double>(event.start), static_cast<double>(event.end), cause_of(event));
    data_.events.node.push_back(kNoNode);
    data_.events.error.push_back(0);
    data_.events.field.push_back(static_cast<std::uint8_t>(event.field));
    data_.events.index.push_back(event.index);
    return;
  }
  const Finding first = findings_.front();
  findings_.pop_front();
  std::vector<Finding> others;
  std::copy_if(findings_.begin(), findings_.end(), std::back_inserter(others), follows);
  std::erase_if(findings_, follows);
  add(kind, first, others, static_cast<double>(event.end));
}

// Findings of several nodes within a few bits are answers to one disturbance.
void EventMatcher::flush_hidden(double before) {
  const auto is_old = [&](const Finding &f) { return static_cast<double>(f.bit.time) < before; };
  while (!findings_.empty() && is_old(findings_.front())) {
    const Finding first = findings_.front();
    const double length = kErrorFrame * first.bit.quanta * first.bit.tq;
    add(kHidden, first, {}, first.end != 0 ? first.end : first.bit.start + length);
    const Time together = first.bit.time + kLatestSign * bit_time_;
    while (!findings_.empty() && is_old(findings_.front()) && findings_.front().bit.time < together)
      findings_.pop_front();
  }
}

void EventMatcher::finish() { flush_hidden(std::numeric_limits<double>::max()); }

void EventMatcher::add(Kind kind, const Finding &finding, const std::vector<Finding> &others,
                       double end) {
  add(kind, finding.bit.start, end, cause_of(finding, others));
  data_.events.node.push_back(static_cast<std::uint8_t>(finding.node));
  data_.events.error.push_back(finding.errors);
  data_.events.field.push_back(static_cast<std::uint8_t>(finding.bit.field));
  data_.events.index.push_back(finding.bit.index);
}

void EventMatcher::add(Kind kind, double start, double end, const Cause &cause) {
  EventColumns &to = data_.events;
  to.kind.push_back(kind);
  to.start.push_back((start - origin_) / 1e3);
  to.end.push_back((end - origin_) / 1e3);
  to.cause.push_back(intern(cause));
}

std::uint16_t EventMatcher::intern(const Cause &cause) {
  auto &causes = data_.causes;
  const auto same = std::find_if(causes.begin(), causes.end(), [&](const auto &known) {
    return known.text == cause.text && known.rule == cause.rule;
  });
  if (same != causes.end()) return static_cast<std::uint16_t>(same - causes.begin());
  causes.push_back({cause.text, std::string{cause.rule}});
  return static_cast<std::uint16_t>(causes.size() - 1);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Response-time analysis: busy periods and the response of every instance in them.
#include "timing/analysis.hpp"

#include <algorithm>
#include <stdexcept>

namespace vericansim {
namespace {

struct Message {
  Time cost;  // C: longest time on the wire
  Time period;
  Time jitter;
};

Time ceil_divide(Time a, Time b) { return a <= 0 ? 0 : (a + b - 1) / b; }

/// Time on the wire of all messages [0, count) that are queued within `window`.
Time demand(const std::vector<Message> &messages, std::size_t count, Time window) {
  Time sum = 0;
  for (std::size_t k = 0; k < count; ++k)
    sum += ceil_divide(window + messages[k].jitter, messages[k].period) * messages[k].cost;
  return sum;
}

/// Least t with t = next(t), from `start` upwards; `next` never falls.
template <typename Next>
Time fixed_point(Time start, Next next) {
  for (Time t = start;;) {
    const Time after = next(t);
    if (after == t) return t;
    t = after;
  }
}

/// Load of the messages [0, count).
double load_of(const std::vector<Message> &messages, std::size_t count) {
  double load = 0;
  for (std::size_t k = 0; k < count; ++k)
    load += static_cast<double>(messages[k].cost) / static_cast<double>(messages[k].period);
  return load;
}

/// Response time of message m: the largest of all its instances in the busy period of its priority
/// level.
Time respond(const std::vector<Message> &messages, std::size_t m, Time bit_time) {
  Time blocking = 0;
  for (std::size_t k = m + 1; k < messages.size(); ++k)
    blocking = std::max(blocking, messages[k].cost);
  const Message &own = messages[m];
  const Time busy =
      fixed_point(own.cost, [&](Time t) { return blocking + demand(messages, m + 1, t); });
  const Time instances = ceil_divide(busy + own.jitter, own.period);
  Time worst = 0;
  for (Time q = 0; q < instances; ++q) {
    // A message of higher priority queued up to one bit after the start of arbitration still wins.
    const Time wait = fixed_point(blocking + q * own.cost, [&](Time w) {
      return blocking + q * own.cost + demand(messages, m, w + bit_time);
    });
    worst = std::max(worst, own.jitter + wait - q * own.period + own.cost);
  }
  return worst;
}

std::vector<Message> costs_of(const std::vector<MessageSpec> &specs, Time bit_time) {
  if (bit_time <= 0) throw std::invalid_argument("the bit time must be above 0");
  std::vector<Message> messages;
  for (const MessageSpec &spec : specs) {
    if (spec.period <= 0 || spec.jitter < 0 || spec.bytes > 8)
      throw std::invalid_argument(
          "a message needs a period above 0, no negative jitter and at most 8 bytes");
    messages.push_back(
        {worst_case_bits(spec.bytes, spec.extended) * bit_time, spec.period, spec.jitter});
  }
  return messages;
}

}  // namespace

std::vector<std::optional<Time>> response_times(const std::vector<MessageSpec> &specs,
                                                Time bit_time) {
  const std::vector<Message> messages = costs_of(specs, bit_time);
  std::vector<std::optional<Time>> results;
  for (std::size_t m = 0; m < messages.size(); ++m) {
    // At a full load the busy period never ends; just below it, it may last for hours: call that
    // full, too.
    constexpr double kFull = 0.9999;
    if (load_of(messages, m + 1) >= kFull)
      results.push_back(std::nullopt);
    else
      results.push_back(respond(messages, m, bit_time));
  }
  return results;
}

double worst_case_load(const std::vector<MessageSpec> &specs, Time bit_time) {
  return load_of(costs_of(specs, bit_time), specs.size());
}

}  // namespace vericansim

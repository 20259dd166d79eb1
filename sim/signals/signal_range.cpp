// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Integers are compared by their bits, other values as doubles.
#include "signals/signal_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signals/signal_text.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

/// Bits of the integers that a double holds.
constexpr unsigned kDoubleBits = 53;

/// The order of an integer signal's values by their bits; a factor below 0 turns it round.
bool is_raw_below(const Signal &signal, std::uint64_t a, std::uint64_t b) {
  if (signal.factor < 0) std::swap(a, b);
  return signal.is_signed ? static_cast<std::int64_t>(a) < static_cast<std::int64_t>(b) : a < b;
}

bool is_choice(const Signal &signal, const std::string &text) {
  return !signal.is_float && std::any_of(signal.choices.begin(), signal.choices.end(),
                                         [&](const auto &choice) { return choice.second == text; });
}

SignalLimit limit_of_raw(const Signal &signal, std::uint64_t raw) {
  return {value_of(signal, raw).value, signal.is_float ? std::nullopt : std::optional(raw)};
}

/// A number that is no value of an integer signal, or that of one with a factor.
SignalLimit inexact_limit(const Signal &signal, const std::string &text) {
  const auto number = parse_number(text);
  if (!number || !std::isfinite(*number))
    throw SignalError(signal.name,
                      fmt::format("'{}' is not allowed; allowed: a number or a choice", text));
  const double raw = (*number - signal.offset) / signal.factor;
  if (signal.length > kDoubleBits && std::abs(raw) >= std::ldexp(1.0, kDoubleBits))
    throw SignalError(
        signal.name, fmt::format("'{}' cannot be compared exactly; allowed: integers of the signal "
                                 "if it has factor 1 and offset 0, else raw values below 2^{}",
                                 text, kDoubleBits));
  return {*number, std::nullopt};
}

std::string limit_text(const Signal &signal, const SignalLimit &limit) {
  return limit.raw ? number_text(value_of(signal, *limit.raw)) : plain_number(limit.value);
}

}  // namespace

bool is_below(const SignalValue &a, const SignalValue &b) {
  if (a.signal->is_float) return a.value < b.value;
  return is_raw_below(*a.signal, a.raw, b.raw);
}

SignalLimit limit_of(const Signal &signal, const std::string &text) {
  if (signal.is_float || is_choice(signal, text)) return limit_of_raw(signal, raw_of(signal, text));
  if (const auto raw = exact_integer(signal, text)) return limit_of_raw(signal, *raw);
  return inexact_limit(signal, text);
}

bool SignalRange::contains(const SignalValue &value) const {
  const Signal &signal = *value.signal;
  if (least &&
      !(least->raw ? !is_raw_below(signal, value.raw, *least->raw) : value.value >= least->value))
    return false;
  return !most ||
         (most->raw ? !is_raw_below(signal, *most->raw, value.raw) : value.value <= most->value);
}

bool is_empty(const Signal &signal, const SignalRange &range) {
  if (!range.least || !range.most) return false;
  if (range.least->raw && range.most->raw)
    return is_raw_below(signal, *range.most->raw, *range.least->raw);
  return range.most->value < range.least->value;
}

std::string to_text(const Signal &signal, const SignalRange &range) {
  if (!range.least) return "at most " + limit_text(signal, *range.most);
  const std::string least = limit_text(signal, *range.least);
  if (!range.most) return "at least " + least;
  const std::string most = limit_text(signal, *range.most);
  return least == most ? least : least + " to " + most;
}

}  // namespace vericansim

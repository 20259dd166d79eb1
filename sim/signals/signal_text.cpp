// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Values, units and choices as text.
#include "signals/signal_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/text.hpp"

namespace vericansim {
namespace {

std::string with_unit(const Signal &signal, const std::string &number) {
  return signal.unit.empty() ? number : number + " " + signal.unit;
}

/// Physical limits of what the bits can hold.
std::pair<double, double> range_of(const Signal &signal) {
  const double end = std::ldexp(1.0, static_cast<int>(signal.length) - (signal.is_signed ? 1 : 0));
  const double low = (signal.is_signed ? -end : 0) * signal.factor + signal.offset;
  const double high = (end - 1) * signal.factor + signal.offset;
  return std::minmax({low, high});
}

}  // namespace

std::string number_text(const Signal &signal, double value) {
  constexpr double kPlain = 1e15;
  constexpr int kMostDecimals = 12;
  if (signal.is_float && signal.length == 32 && signal.factor == 1 && signal.offset == 0)
    return fmt::format("{}", static_cast<float>(value));
  if (signal.is_float || std::abs(value) >= kPlain || signal.decimals > kMostDecimals)
    return fmt::format("{}", value);
  std::string text = fmt::format("{:.{}f}", value, signal.decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string number_text(const SignalValue &value) {
  const Signal &signal = *value.signal;
  if (signal.is_float || signal.factor != 1 || signal.offset != 0)
    return number_text(signal, value.value);
  return signal.is_signed ? fmt::format("{}", static_cast<std::int64_t>(value.raw))
                          : fmt::format("{}", value.raw);
}

std::string to_text(const SignalValue &value) {
  if (const auto choice = choice_of(value)) return std::string(*choice);
  return with_unit(*value.signal, number_text(value));
}

std::string to_text(const SignalMessage &message, const std::vector<SignalValue> &values) {
  std::string text = message.name + "(";
  for (const SignalValue &value : values)
    text += (&value == values.data() ? "" : ", ") + value.signal->name + ": " + to_text(value);
  return text::printable(text + ")");
}

std::string allowed_values(const Signal &signal) {
  std::string text;
  if (signal.is_float) {
    text = "a number";
    if (signal.minimum > -std::numeric_limits<double>::infinity())
      text += fmt::format(" from {:.15g} to {:.15g}", signal.minimum, signal.maximum);
  } else {
    const auto [low, high] = range_of(signal);
    text = number_text(signal, std::max(low, signal.minimum)) + " to " +
           with_unit(signal, number_text(signal, std::min(high, signal.maximum))) +
           " in steps of " + number_text(signal, std::abs(signal.factor));
  }
  constexpr std::size_t kMost = 12;
  for (std::size_t i = 0; i < std::min(signal.choices.size(), kMost); ++i)
    text += ", " + signal.choices[i].second;
  return signal.choices.size() > kMost ? text + ", ..." : text;
}

std::string signal_names(const SignalMessage &message) {
  std::string names;
  for (const Signal &signal : message.signals) names += (names.empty() ? "" : ", ") + signal.name;
  return names.empty() ? "none" : names;
}

}  // namespace vericansim

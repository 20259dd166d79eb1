// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals of a frame.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "signals/signal_bits.hpp"
#include "signals/signal_codec.hpp"

namespace vericansim {
namespace {

std::uint64_t bits_of(const Signal &signal, const FrameData &data) {
  std::uint64_t raw = 0;
  for_each_bit(signal, [&](unsigned place, unsigned weight) {
    raw |= static_cast<std::uint64_t>(data[place / 8] >> place % 8 & 1) << weight;
  });
  const bool negative =
      signal.is_signed && !signal.is_float && (raw >> (signal.length - 1) & 1) != 0;
  if (negative && signal.length < 64) raw |= ~std::uint64_t{0} << signal.length;
  return raw;
}

double number_of(const Signal &signal, std::uint64_t raw) {
  if (signal.is_float)
    return signal.length == 32
               ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)))
               : std::bit_cast<double>(raw);
  return signal.is_signed ? static_cast<double>(static_cast<std::int64_t>(raw))
                          : static_cast<double>(raw);
}

/// What a decimal factor means: 3 * 0.1 is 0.3.
double rounded(double value, int decimals) {
  constexpr int kMostDecimals = 12;
  constexpr double kExact = 9e15;  // integers up to here are doubles
  if (decimals > kMostDecimals) return value;
  const double scale = std::pow(10.0, decimals);
  return std::abs(value * scale) < kExact ? std::round(value * scale) / scale : value;
}

/// is_selected() in a frame that has the first `size` bytes of `data`.
bool is_selected_within(const SignalMessage &message, const Signal &signal, const FrameData &data,
                        std::size_t size) {
  if (!signal.selection) return true;
  const Signal &multiplexer = message.signals[signal.selection->multiplexer];
  if (bytes_needed(multiplexer) > size) return false;
  // DBC files select by the bits, whether or not they have a sign.
  const std::uint64_t raw = bits_of(multiplexer, data) & mask_of(multiplexer);
  const auto &ranges = signal.selection->ranges;
  return is_selected_within(message, multiplexer, data, size) &&
         std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto &range) { return raw >= range.first && raw <= range.second; });
}

}  // namespace

SignalValue value_of(const Signal &signal, std::uint64_t raw) {
  double physical = number_of(signal, raw) * signal.factor + signal.offset;
  if (!signal.is_float) physical = rounded(physical, signal.decimals);
  // The sign of what is no number would be printed and means nothing.
  if (std::isnan(physical)) physical = std::numeric_limits<double>::quiet_NaN();
  return {&signal, raw, physical};
}

std::optional<std::string_view> choice_of(const SignalValue &value) {
  if (value.signal->is_float) return std::nullopt;
  for (const auto &[raw, text] : value.signal->choices)
    if (static_cast<std::uint64_t>(raw) == value.raw) return text;
  return std::nullopt;
}

bool is_selected(const SignalMessage &message, const Signal &signal, const FrameData &data) {
  return is_selected_within(message, signal, data, data.size());
}

std::vector<SignalValue> decode(const SignalMessage &message, const Frame &frame) {
  std::vector<SignalValue> values;
  for (const Signal &signal : message.signals)
    if (bytes_needed(signal) <= frame.payload_size() &&
        is_selected_within(message, signal, frame.data, frame.payload_size()))
      values.push_back(value_of(signal, bits_of(signal, frame.data)));
  return values;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Values to a frame's data.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "signals/signal_bits.hpp"
#include "signals/signal_codec.hpp"
#include "signals/signal_text.hpp"

namespace vericansim {
namespace {

/// A whole text as a number, or nothing.
template <typename Number>
std::optional<Number> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const char *const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || text.empty()) return std::nullopt;
  return number;
}

void put(const Signal &signal, std::uint64_t raw, FrameData &data) {
  for_each_bit(signal, [&](unsigned place, unsigned weight) {
    const auto bit = static_cast<std::uint8_t>(1U << place % 8);
    std::uint8_t &byte = data[place / 8];
    byte = static_cast<std::uint8_t>((raw >> weight & 1) != 0 ? byte | bit : byte & ~bit);
  });
}

[[noreturn]] void refuse(const Signal &signal, const std::string &text) {
  throw SignalError(signal.name,
                    fmt::format("'{}' is not allowed; allowed: {}", text, allowed_values(signal)));
}

/// Bits of an integer signal for a raw value, if it has so many.
std::optional<std::uint64_t> integer_bits(const Signal &signal, double raw) {
  const int magnitude = static_cast<int>(signal.length) - (signal.is_signed ? 1 : 0);
  const double end = std::ldexp(1.0, magnitude);
  const double whole = std::round(raw);
  if (!(whole < end && whole >= (signal.is_signed ? -end : 0.0))) return std::nullopt;
  return signal.is_signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(whole))
                          : static_cast<std::uint64_t>(whole);
}

std::optional<std::uint64_t> float_bits(const Signal &signal, double raw) {
  if (signal.length == 64) return std::bit_cast<std::uint64_t>(raw);
  if (std::abs(raw) > std::numeric_limits<float>::max()) return std::nullopt;
  return std::bit_cast<std::uint32_t>(static_cast<float>(raw));
}

std::optional<std::uint64_t> bits_for(const Signal &signal, double raw) {
  return signal.is_float ? float_bits(signal, raw) : integer_bits(signal, raw);
}

bool fits(const Signal &signal, std::uint64_t raw) {
  if (!signal.is_signed) return (raw & ~mask_of(signal)) == 0;
  const auto value = static_cast<std::int64_t>(raw);
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() >> (64 - signal.length);
  return value <= most && value >= -most - 1;
}

std::optional<std::uint64_t> raw_of_choice(const Signal &signal, const std::string &text) {
  std::optional<std::uint64_t> raw;
  for (const auto &[value, name] : signal.choices) {
    if (name != text) continue;
    if (raw)
      throw SignalError(signal.name, fmt::format("'{}' stands for more than one value; allowed: a "
                                                 "number",
                                                 text));
    raw = static_cast<std::uint64_t>(value);
  }
  if (raw && !fits(signal, *raw)) refuse(signal, text);
  return raw;
}

std::uint64_t places_of(const Signal &signal) {
  std::uint64_t places = 0;
  for_each_bit(signal, [&](unsigned place, unsigned) { places |= std::uint64_t{1} << place; });
  return places;
}

/// Multiplexers that a signal depends on.
unsigned depth_of(const SignalMessage &message, const Signal &signal) {
  unsigned depth = 0;
  for (const Signal *at = &signal; at->selection; ++depth)
    at = &message.signals[at->selection->multiplexer];
  return depth;
}

const Signal &find_signal(const SignalMessage &message, const std::string &name) {
  if (const Signal *signal = message.find(name)) return *signal;
  throw SignalError(name, fmt::format("message {} has no such signal; allowed: {}", message.name,
                                      signal_names(message)));
}

/// Sets the signals of one frame, multiplexers before what they select.
class Encoder {
 public:
  Encoder(const SignalMessage &message, const SignalTexts &texts) : message_{message} {
    for (const auto &[name, text] : texts) {
      const Signal &signal = find_signal(message, name);
      if (bytes_needed(signal) > data_.size())
        throw SignalError(name, "is behind byte 8, the last one of a classical frame");
      given_[&signal] = raw_of(signal, text);
    }
  }

  FrameData encode() {
    std::vector<const Signal *> order;
    for (const Signal &signal : message_.signals)
      if (bytes_needed(signal) <= data_.size()) order.push_back(&signal);
    std::stable_sort(order.begin(), order.end(), [&](const Signal *a, const Signal *b) {
      return depth_of(message_, *a) < depth_of(message_, *b);
    });
    for (const Signal *signal : order)
      if (given_.contains(signal)) claim(*signal);
    for (const Signal *signal : order) set(*signal);
    for (const auto &[signal, raw] : given_) check_selected(*signal);
    return data_;
  }

 private:
  /// Keeps the start values of others off the bits of a signal that is given.
  void claim(const Signal &signal) { claimed_ |= places_of(signal); }

  void set(const Signal &signal) {
    if (!is_selected(message_, signal, data_)) return;
    const auto given = given_.find(&signal);
    if (given == given_.end()) {
      const auto raw = bits_for(signal, signal.start_value);
      if (raw && (places_of(signal) & claimed_) == 0) put(signal, *raw, data_);
      return;
    }
    for (const Signal *other : set_)
      if ((places_of(*other) & places_of(signal)) != 0)
        throw SignalError(signal.name, "shares bits with " + other->name +
                                           ", which is given too; allowed: one of them");
    put(signal, given->second, data_);
    set_.push_back(&signal);
  }

  void check_selected(const Signal &signal) const {
    if (is_selected(message_, signal, data_)) return;
    const Signal &multiplexer = message_.signals[signal.selection->multiplexer];
    std::string values;
    for (const auto &[first, last] : signal.selection->ranges)
      values += (values.empty() ? "" : ", ") +
                (first == last ? fmt::format("{}", first) : fmt::format("{} to {}", first, last));
    throw SignalError(signal.name, fmt::format("is there only while {} has the raw value {}",
                                               multiplexer.name, values));
  }

  const SignalMessage &message_;
  std::map<const Signal *, std::uint64_t> given_;
  std::vector<const Signal *> set_;
  std::uint64_t claimed_ = 0;
  FrameData data_{};
};

}  // namespace

// Doubles do not hold all integers of 64 bits.
std::optional<std::uint64_t> exact_integer(const Signal &signal, const std::string &text) {
  if (signal.is_float || signal.factor != 1 || signal.offset != 0) return std::nullopt;
  if (signal.is_signed) {
    const auto number = parsed<std::int64_t>(text);
    return number ? std::optional(static_cast<std::uint64_t>(*number)) : std::nullopt;
  }
  return parsed<std::uint64_t>(text);
}

std::uint64_t raw_of(const Signal &signal, const std::string &text) {
  if (!signal.is_float)
    if (const auto raw = raw_of_choice(signal, text)) return *raw;
  const auto number = parsed<double>(text);
  // Half a step beyond a limit is the limit: what is printed can be written.
  const double slack = signal.is_float ? 0 : std::abs(signal.factor) / 2;
  if (!number || !std::isfinite(*number) || *number < signal.minimum - slack ||
      *number > signal.maximum + slack)
    refuse(signal, text);
  auto raw = exact_integer(signal, text);
  if (!raw) raw = bits_for(signal, (*number - signal.offset) / signal.factor);
  if (!raw || (!signal.is_float && !fits(signal, *raw))) refuse(signal, text);
  return *raw;
}

FrameData encode(const SignalMessage &message, const SignalTexts &texts) {
  return Encoder{message, texts}.encode();
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Quantities with units.
#include "trace/quantity.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "trace/text.hpp"

namespace vericansim {
namespace {

struct Unit {
  std::string_view name;
  double factor;
  double divisor = 1;  // 95 / 100 is 0.95; 95 * 0.01 is a little more
};

std::optional<double> parse_with(std::string_view text, std::span<const Unit> units) {
  text = text::trimmed(text);
  double value = 0;
  const char *const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  const std::string_view unit = text::trimmed({stop, static_cast<std::size_t>(end - stop)});
  for (const Unit &candidate : units)
    if (unit == candidate.name) return value * candidate.factor / candidate.divisor;
  return std::nullopt;
}

constexpr Unit kFrequency[] = {{"", 1},    {"Hz", 1},    {"k", 1e3},  {"kHz", 1e3},
                               {"M", 1e6}, {"MHz", 1e6}, {"GHz", 1e9}};
constexpr Unit kBitrate[] = {{"", 1},         {"bit/s", 1}, {"k", 1e3},
                             {"kbit/s", 1e3}, {"M", 1e6},   {"Mbit/s", 1e6}};
constexpr Unit kTime[] = {{"ps", 1}, {"ns", 1e3}, {"us", 1e6}, {"ms", 1e9}, {"s", 1e12}};
constexpr Unit kLength[] = {{"", 1}, {"m", 1}, {"cm", 1, 100}, {"km", 1e3}};
constexpr Unit kPart[] = {{"", 1}, {"%", 1, 100}};
constexpr Unit kNone[] = {{"", 1}};

}  // namespace

std::optional<double> parse_frequency(std::string_view text) {
  return parse_with(text, kFrequency);
}
std::optional<double> parse_bitrate(std::string_view text) { return parse_with(text, kBitrate); }
std::optional<double> parse_length(std::string_view text) { return parse_with(text, kLength); }
std::optional<double> parse_part(std::string_view text) { return parse_with(text, kPart); }
std::optional<double> parse_number(std::string_view text) { return parse_with(text, kNone); }

std::optional<Time> parse_time(std::string_view text) {
  if (text::trimmed(text) == "0") return 0;
  const auto picoseconds = parse_with(text, kTime);
  constexpr double kLongest = 9e18;  // within 64 bits
  if (!picoseconds || std::abs(*picoseconds) > kLongest) return std::nullopt;
  return static_cast<Time>(std::llround(*picoseconds));
}

std::optional<std::uint64_t> parse_integer(std::string_view text) {
  text = text::trimmed(text);
  if (text.starts_with("0x") || text.starts_with("0X"))
    return text::parse_unsigned(text.substr(2), 16);
  if (text.starts_with("0b") || text.starts_with("0B"))
    return text::parse_unsigned(text.substr(2), 2);
  if (text.size() > 1 && text.front() == '0') return std::nullopt;  // meant as octal, or as hex
  return text::parse_unsigned(text, 10);
}

std::string readable_time(Time time) {
  const double seconds = static_cast<double>(time) / kSecond;
  if (std::llabs(time) >= kSecond) return fmt::format("{:.3f} s", seconds);
  if (std::llabs(time) >= kMillisecond) return fmt::format("{:.3f} ms", seconds * 1e3);
  return fmt::format("{:.3f} us", seconds * 1e6);
}

std::string exact_time(Time time) {
  constexpr std::pair<Time, const char *> kUnits[] = {
      {kSecond, "s"}, {kMillisecond, "ms"}, {kMicrosecond, "us"}, {kNanosecond, "ns"}};
  if (time == 0) return "0";
  for (const auto &[unit, name] : kUnits)
    if (time % unit == 0) return fmt::format("{} {}", time / unit, name);
  return fmt::format("{} ps", time);
}

std::string plain_number(double value) {
  if (std::isnan(value)) return "nan";  // without its sign, which means nothing
  constexpr double kExact = 1e15;
  const bool whole = std::abs(value) < kExact && value == std::trunc(value);
  return whole ? fmt::format("{:.0f}", value + 0.0) : fmt::format("{:.10g}", value);
}

}  // namespace vericansim

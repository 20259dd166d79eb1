// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Lines, fields and numbers of the text formats.
#include "trace/text.hpp"

#include <fmt/format.h>
#include <algorithm>

#include <charconv>
#include <limits>

#include "trace/input_error.hpp"

namespace vericansim::text {

void fail(const Place &place, const std::string &message) {
  throw InputError(place.file, place.line, message);
}

std::vector<std::string_view> split_blanks(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

std::vector<std::string_view> split_commas(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = line.find(',');
    fields.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7F'; }

}  // namespace

bool has_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(), is_control);
}

std::string printable(std::string_view text) {
  std::string result{text};
  std::replace_if(result.begin(), result.end(), is_control, '?');
  return result;
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::optional<std::uint64_t> parse_unsigned(std::string_view text, int base) {
  std::uint64_t value = 0;
  const char *const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  if (error != std::errc{} || stop != end || text.empty()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_decimal(std::string_view text, std::int64_t unit) {
  const std::size_t dot = text.find('.');
  const auto whole = parse_unsigned(text.substr(0, dot), 10);
  if (!whole) return std::nullopt;
  std::int64_t fraction = 0;
  if (dot != std::string_view::npos) {
    std::int64_t weight = unit;
    const std::string_view decimals = text.substr(dot + 1);
    if (decimals.empty() || decimals.size() > 12) return std::nullopt;
    for (const char c : decimals) {
      if (c < '0' || c > '9') return std::nullopt;
      weight /= 10;
      fraction += (c - '0') * weight;
    }
  }
  const auto most =
      static_cast<std::uint64_t>((std::numeric_limits<std::int64_t>::max() - fraction) / unit);
  if (*whole > most) return std::nullopt;
  return static_cast<std::int64_t>(*whole) * unit + fraction;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted_text = "\"";
  for (const char c : text) quoted_text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted_text + "\"";
}

void set_id(Frame &frame, std::uint64_t id, bool extended, const Place &place) {
  const std::uint64_t highest = extended ? 0x1FFFFFFF : 0x7FF;
  if (id > highest)
    fail(place, extended ? "identifier is above 1FFFFFFF (29 bits)"
                         : "identifier is above 7FF (11 bits; 29-bit identifiers have 8 digits)");
  frame.id = static_cast<std::uint32_t>(id);
  frame.extended = extended;
}

void set_byte(Frame &frame, std::size_t index, std::string_view digits, const Place &place) {
  const auto value = digits.size() == 2 ? parse_unsigned(digits, 16) : std::nullopt;
  if (!value || index >= frame.data.size())
    fail(place, "data byte " + in_quotes(std::string(digits)) +
                    " is not allowed; allowed are up to 8 bytes of two hexadecimal digits");
  frame.data[index] = static_cast<std::uint8_t>(*value);
}

std::string byte_digits(const std::vector<std::string_view> &fields, std::size_t first,
                        std::size_t count, const Place &place) {
  if (fields.size() != first + count)
    fail(place,
         fmt::format("{} data bytes where the length says {}", fields.size() - first, count));
  std::string digits;
  for (std::size_t i = first; i < first + count; ++i) {
    if (fields[i].size() != 2)
      fail(place, "data byte " + in_quotes(std::string(fields[i])) +
                      " is not allowed; allowed: two hexadecimal digits");
    digits += fields[i];
  }
  return digits;
}

}  // namespace vericansim::text

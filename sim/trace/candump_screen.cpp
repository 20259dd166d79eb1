// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// candump's screen output: each line becomes the frame of a log line.
#include "trace/candump_screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <string>

#include "trace/candump.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using Fields = std::vector<std::string_view>;
using text::fail;
using text::Place;

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// "[8]", "[08]" (CAN FD) or "{F}" (a raw DLC).
bool is_length(std::string_view field) {
  return field.size() >= 3 && field.size() <= 4 &&
         ((field.front() == '[' && field.back() == ']') ||
          (field.front() == '{' && field.back() == '}'));
}

/// "(2023-01-15" and "10:11:12.123456)", local time, in nanoseconds since the epoch.
std::int64_t parse_date(std::string_view date, std::string_view time, const Place &place) {
  const std::string text = std::string(date.substr(1)) + " " + std::string(time);
  std::tm fields{};
  const char *rest = ::strptime(text.c_str(), "%Y-%m-%d %H:%M:%S", &fields);
  fields.tm_isdst = -1;
  const std::time_t seconds = rest == nullptr ? -1 : std::mktime(&fields);
  const std::string_view fraction = rest == nullptr ? "" : rest;
  if (seconds < 0 || fraction.size() < 3 || fraction.front() != '.' || fraction.back() != ')')
    fail(place, "time " + in_quotes("(" + text) +
                    " is not allowed; allowed: (YYYY-MM-DD HH:MM:SS.ffffff)");
  std::int64_t ns = 0;
  if (__builtin_mul_overflow(seconds, kNsPerSecond, &ns) ||
      __builtin_add_overflow(ns, parse_candump_stamp("(0" + std::string(fraction), place), &ns))
    fail(place, "time " + in_quotes("(" + text) + " is out of range; allowed: up to the year 2262");
  return ns;
}

/// What candump shows behind the bytes: the same as letters (-a, with -S in other quotes), or the
/// kind of frame.
bool is_note(std::string_view field) {
  return field.front() == '\'' || field.front() == '`' || field == "ERRORFRAME";
}

/// Identifier, length and bytes from `at` on, as a log has them. `fd_flags`: of a CAN FD frame.
std::string log_frame(const Fields &fields, std::size_t at, unsigned fd_flags, const Place &place) {
  if (fields.size() < at + 2 || !is_length(fields[at + 1]))
    fail(place,
         "expected (TIME) INTERFACE FRAME or INTERFACE IDENTIFIER [LENGTH] BYTES; allowed: "
         "(1.5) can0 123#1122, can0 123 [2] 11 22");
  const std::string id(fields[at]);
  const std::string_view length = fields[at + 1].substr(1, fields[at + 1].size() - 2);
  const bool raw = fields[at + 1].front() == '{', fd = !raw && length.size() == 2;
  const auto count = raw ? 8 : text::parse_unsigned(length, 10);
  if (!count || *count > (fd ? 64 : 8))
    fail(place, "length " + in_quotes(std::string(fields[at + 1])) +
                    " is not allowed; allowed: [0] to [8], CAN FD [00] to [64]");
  const std::string tail = raw ? "_" + std::string(length) : "";
  if (fields.size() > at + 2 && fields[at + 2] == "remote")
    return id + fmt::format("#R{}", *count) + tail;
  const std::size_t end = std::min<std::size_t>(fields.size(), at + 2 + *count);
  const bool more = end < fields.size() && is_note(fields[end]);
  const Fields bytes{fields.begin(),
                     more ? fields.begin() + static_cast<std::ptrdiff_t>(end) : fields.end()};
  return id + (fd ? fmt::format("##{:X}", fd_flags) : "#") +
         text::byte_digits(bytes, at + 2, *count, place) + tail;
}

}  // namespace

CandumpScreen::CandumpScreen(std::string_view text) {
  // Times since a line begin at zero; those since the line before also go back.
  constexpr std::int64_t kNone = -1;
  std::int64_t last = kNone;
  bool known = false;
  text::for_each_line(text, "", [&](std::string_view line, const Place &) {
    const std::size_t open = line.find_first_not_of(" \t");
    if (known || open == std::string_view::npos || line[open] != '(') return;
    const std::string_view stamp = line.substr(open + 1, line.find(')', open) - open - 1);
    const std::int64_t ns = text::parse_decimal(stamp, kNsPerSecond).value_or(kNone);
    differences_ = last != kNone && ns < last;
    known = differences_ || (last == kNone && ns != 0);
    last = ns;
  });
}

std::int64_t CandumpScreen::take_stamp(Fields &fields, const Place &place) {
  if (fields[0].front() != '(') return 0;
  const bool dated = fields[0].back() != ')' && fields.size() > 1;
  const std::int64_t ns =
      dated ? parse_date(fields[0], fields[1], place) : parse_candump_stamp(fields[0], place);
  fields.erase(fields.begin(), fields.begin() + (dated ? 2 : 1));
  if (!differences_) return ns;
  if (__builtin_add_overflow(sum_ns_, ns, &sum_ns_)) fail(place, "times are too far apart");
  return sum_ns_;
}

void CandumpScreen::parse(std::string_view line, LogBuilder &log, const Place &place) {
  if (error_message_ && line.front() == '\t') return;  // candump -e explains it
  Fields fields = text::split_blanks(line);
  CandumpLine result;
  result.ns = take_stamp(fields, place);
  std::size_t at = 1;  // of the identifier
  unsigned fd_flags = 0;
  if (fields.size() > 4 && (fields[1] == "TX" || fields[1] == "RX") && !is_length(fields[2])) {
    result.direction = fields[1] == "TX" ? Direction::kSent : Direction::kReceived;
    fd_flags = (fields[2] == "B" ? 1U : 0U) | (fields[3] == "E" ? 2U : 0U);
    at = 4;
  }
  result.frame = log_frame(fields, at, fd_flags, place);
  result.channel = fields[0];
  error_message_ = add_candump_line(result, log, place) == ForeignEntry::Kind::kError;
}

bool looks_like_candump_screen(std::string_view line) {
  const auto fields = text::split_blanks(line);
  return (fields.size() >= 3 && is_length(fields[2])) ||
         (fields.size() >= 6 && is_length(fields[5]) && (fields[1] == "TX" || fields[1] == "RX"));
}

}  // namespace vericansim

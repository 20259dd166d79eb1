// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PCAN-View trace files: start times, and the writer.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <iterator>
#include <limits>

#include "trace/channel_numbers.hpp"
#include "trace/fd_lengths.hpp"
#include "trace/log_walk.hpp"
#include "trace/text.hpp"
#include "trace/trc.hpp"
#include "trace/trc_format.hpp"

namespace vericansim {
namespace trc {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000, kDaySeconds = 86'400;
constexpr std::int64_t kUnixDay = 25'569;          // 1970-01-01, counted from 1899-12-30
constexpr std::int64_t kPart = 1'000'000'000'000;  // a day has so many of them

}  // namespace

std::optional<std::int64_t> start_ns(std::string_view days) {
  const auto parts = text::parse_decimal(days.substr(0, days.find('.') + 13), kPart);
  if (!parts) return std::nullopt;
  const auto us =
      (static_cast<__int128>(*parts % kPart) * kDaySeconds * 1'000'000 + kPart / 2) / kPart;
  const auto of_day = static_cast<std::int64_t>(us);
  const std::time_t as_utc =
      static_cast<std::time_t>((*parts / kPart - kUnixDay) * kDaySeconds + of_day / 1'000'000);
  std::tm local{};
  if (::gmtime_r(&as_utc, &local) == nullptr) return 0;
  local.tm_isdst = -1;
  const std::time_t seconds = std::mktime(&local);
  if (seconds > std::numeric_limits<std::int64_t>::max() / kSecondNs - 1) return std::nullopt;
  return seconds < 0 ? 0 : seconds * kSecondNs + of_day % 1'000'000 * 1000;
}

std::string days_text(std::int64_t ns) {
  const std::time_t seconds = ns / kSecondNs;
  std::tm local{};
  if (::localtime_r(&seconds, &local) == nullptr) return "0.0";
  // West of Greenwich the first hours of 1970 are of the day before.
  const std::int64_t since = ::timegm(&local) + kUnixDay * kDaySeconds;
  const std::int64_t us = since % kDaySeconds * 1'000'000 + ns % kSecondNs / 1000;
  const auto part =
      static_cast<std::int64_t>(static_cast<__int128>(us) * kPart / (kDaySeconds * 1'000'000));
  return fmt::format("{}.{:012d}", since / kDaySeconds, part);
}

}  // namespace trc

namespace {

const char *way(Direction direction) { return direction == Direction::kSent ? "Tx" : "Rx"; }

/// "11 22" of "1122".
std::string spaced(std::string_view digits) {
  std::string text;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    text += " " + std::string(digits.substr(i, 2));
  return text;
}

/// DLC and bytes of a classical frame.
std::string classical_tail(const Frame &frame) {
  std::string tail = fmt::format("{:<4}", frame.dlc);
  for (std::size_t i = 0; i < frame.payload_size(); ++i)
    tail += fmt::format(" {:02X}", frame.data[i]);
  return tail;
}

/// Type, identifier and what follows it of a CAN FD frame.
struct FdParts {
  const char *type;
  std::string_view id;
  std::string_view digits;
  std::size_t dlc;
};

FdParts fd_parts(const std::string &text) {
  static constexpr const char *kFdTypes[] = {"FD", "FB", "FE", "BI"};
  const std::size_t hash = text.find('#');
  const std::string_view all{text};
  const auto flags = text::parse_unsigned(all.substr(hash + 2, 1), 16).value_or(0) & 3U;
  const std::string_view digits = all.substr(hash + 3);
  const auto *length = std::lower_bound(kFdLengths.begin(), kFdLengths.end(), digits.size() / 2);
  return {kFdTypes[flags], all.substr(0, hash), digits,
          static_cast<std::size_t>(length - kFdLengths.begin())};
}

}  // namespace

std::string trc_text(const CanLog &log) {
  // Whole microseconds, so that start and offsets together give the time.
  const std::int64_t first_ns = log.start_ns + log.earliest() / kNanosecond;
  const std::int64_t start = first_ns - (first_ns % 1000 + 1000) % 1000;
  const auto numbers = channel_numbers(log);
  std::string text = ";$FILEVERSION=2.1\r\n";
  if (log.start_ns != 0 && start >= 0)
    text += fmt::format(";$STARTTIME={}\r\n", trc::days_text(start));
  text += ";$COLUMNS=N,O,T,B,I,d,R,L,D\r\n;\r\n";
  std::size_t number = 0;
  const auto line = [&](const auto &entry, const char *type, const std::string &id,
                        const std::string &tail) {
    const std::int64_t ns = log.start_ns + entry.time / kNanosecond - start;
    const unsigned bus = entry.channel.empty() ? 1 : numbers.at(entry.channel) + 1;
    fmt::format_to(std::back_inserter(text), "{:>7} {:>9}.{:03d} {} {:<2} {:>8} {} - {}\r\n",
                   ++number, ns / 1'000'000, ns / 1000 % 1000, type, bus, id, way(entry.direction),
                   tail);
  };
  walk(
      log,
      [&](const LogEntry &entry) {
        const Frame &frame = entry.frame;
        line(entry, frame.remote ? "RR" : "DT",
             fmt::format("{:0{}X}", frame.id, frame.extended ? 8 : 4), classical_tail(frame));
      },
      [&](const ForeignEntry &entry) {
        const FdParts parts = fd_parts(entry.text);
        line(entry, parts.type, (parts.id.size() == 3 ? "0" : "") + std::string(parts.id),
             fmt::format("{:<4}", parts.dlc) + spaced(parts.digits));
      });
  return text;
}

}  // namespace vericansim

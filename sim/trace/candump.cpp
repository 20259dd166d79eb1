// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// candump logs: parser and writer.
#include "trace/candump.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <limits>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using text::fail;
using text::Place;

constexpr std::uint64_t kErrorFlag = 0x20000000;  // SocketCAN CAN_ERR_FLAG
constexpr const char *kFrameForm =
    "; allowed: 123#0011, 1234ABCD#00.11, 123#R, 123#R8, 123#<8 bytes>_9.._F";

/// Identifier in candump's way: 3 digits are 11 bits, 8 digits are 29 bits. False: an error
/// message.
bool parse_id(std::string_view digits, Frame &frame, const Place &place) {
  const auto id = text::parse_unsigned(digits, 16);
  if (!id || (digits.size() != 3 && digits.size() != 8))
    fail(place, "identifier " + quoted(std::string(digits)) +
                    " is not allowed; allowed: 3 (11 bit) or 8 (29 bit) hexadecimal digits");
  if (digits.size() == 8 && (*id & kErrorFlag) != 0) return false;
  text::set_id(frame, *id, digits.size() == 8, place);
  return true;
}

/// The raw DLC behind '_': one hexadecimal digit 9..F, only with eight bytes (or R8).
void parse_raw_dlc(std::string_view digit, Frame &frame, const Place &place) {
  const auto dlc = text::parse_unsigned(digit, 16);
  if (!dlc || digit.size() != 1 || *dlc < 9 || frame.dlc != 8)
    fail(place, "raw DLC " + quoted(std::string(digit)) +
                    " is not allowed; allowed: _9 to _F after 8 bytes");
  frame.dlc = static_cast<std::uint8_t>(*dlc);
}

void parse_remote(std::string_view rest, Frame &frame, const Place &place) {
  frame.remote = true;
  if (rest.empty()) return;
  if (rest[0] < '0' || rest[0] > '8')
    fail(place, "remote DLC " + quoted(std::string(rest)) + " is not allowed; allowed: 0 to 8");
  frame.dlc = static_cast<std::uint8_t>(rest[0] - '0');
  if (rest.size() == 1) return;
  if (rest[1] != '_') fail(place, "frame ends with " + quoted(std::string(rest)) + kFrameForm);
  parse_raw_dlc(rest.substr(2), frame, place);
}

void parse_data(std::string_view rest, Frame &frame, const Place &place) {
  std::size_t count = 0;
  while (!rest.empty() && rest[0] != '_') {
    if (rest[0] == '.') {
      rest.remove_prefix(1);
      continue;
    }
    if (rest.size() < 2) fail(place, "odd number of data digits" + std::string(kFrameForm));
    text::set_byte(frame, count++, rest.substr(0, 2), place);
    rest.remove_prefix(2);
  }
  frame.dlc = static_cast<std::uint8_t>(count);
  if (!rest.empty()) parse_raw_dlc(rest.substr(1), frame, place);
}

/// "(1436509052.249713)" in nanoseconds since the epoch.
std::int64_t parse_stamp(std::string_view field, const Place &place) {
  const bool framed = field.size() > 2 && field.front() == '(' && field.back() == ')';
  const auto ns =
      framed ? text::parse_decimal(field.substr(1, field.size() - 2), 1'000'000'000) : std::nullopt;
  if (!ns)
    fail(place,
         "time " + quoted(std::string(field)) + " is not allowed; allowed: (seconds.microseconds)");
  return *ns;
}

/// Screen output after the channel: "123   [2]  11 22", "123   [0]  remote request".
bool parse_screen(const std::vector<std::string_view> &fields, std::size_t at, Frame &frame,
                  const Place &place) {
  if (fields.size() < at + 2 || fields[at + 1].size() != 3 || fields[at + 1].front() != '[')
    fail(place,
         fields.size() > at + 1 && fields[at + 1].size() == 4
             ? "CAN FD length " + quoted(std::string(fields[at + 1])) + "; allowed: [0] to [8]"
             : "expected IDENTIFIER [LENGTH] BYTES" + std::string(kFrameForm));
  if (!parse_id(fields[at], frame, place)) return false;
  const auto length = text::parse_unsigned(fields[at + 1].substr(1, 1), 10);
  if (!length || *length > 8)
    fail(place,
         "length " + quoted(std::string(fields[at + 1])) + " is not allowed; allowed: [0] to [8]");
  frame.dlc = static_cast<std::uint8_t>(*length);
  if (fields.size() > at + 2 && fields[at + 2] == "remote") {
    frame.remote = true;
    return true;
  }
  if (fields.size() < at + 2 + frame.dlc)
    fail(place,
         fmt::format("{} data bytes where the length says {}", fields.size() - at - 2, frame.dlc));
  for (std::size_t i = 0; i < frame.dlc; ++i) text::set_byte(frame, i, fields[at + 2 + i], place);
  return true;
}

}  // namespace

bool parse_candump_frame(std::string_view text, Frame &frame, const Place &place) {
  frame = Frame{};
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos)
    fail(place, "frame " + quoted(std::string(text)) + " has no '#'" + kFrameForm);
  if (!parse_id(text.substr(0, hash), frame, place)) return false;
  const std::string_view rest = text.substr(hash + 1);
  if (!rest.empty() && rest[0] == '#') return false;  // CAN FD
  if (!rest.empty() && (rest[0] == 'R' || rest[0] == 'r'))
    parse_remote(rest.substr(1), frame, place);
  else
    parse_data(rest, frame, place);
  return true;
}

bool looks_like_candump_text(std::string_view line) {
  const auto fields = text::split_blanks(line);
  return fields.size() >= 3 && fields[2].size() >= 3 && fields[2].front() == '[' &&
         fields[2].back() == ']';
}

CanLog parse_candump(std::string_view text, const std::string &file) {
  CanLog log;
  text::for_each_line(text, file, [&](std::string_view line, const Place &place) {
    const auto fields = text::split_blanks(line);
    if (fields.empty() || fields[0].front() == '#') return;
    const bool stamped = fields[0].front() == '(';
    const std::int64_t ns = stamped ? parse_stamp(fields[0], place) : 0;
    const std::size_t at = stamped ? 2 : 1;  // the frame follows the channel
    if (fields.size() <= at)
      fail(place, "expected (TIME) INTERFACE FRAME" + std::string(kFrameForm));
    LogEntry entry;
    const bool classical = fields[at].find('#') != std::string_view::npos
                               ? parse_candump_frame(fields[at], entry.frame, place)
                               : parse_screen(fields, at, entry.frame, place);
    if (!classical) {
      ++log.skipped;
      return;
    }
    if (log.entries.empty()) log.start_ns = ns;
    if (ns - log.start_ns > std::numeric_limits<Time>::max() / kNanosecond ||
        log.start_ns - ns > std::numeric_limits<Time>::max() / kNanosecond)
      fail(place, "time is more than 106 days from the first one");
    entry.time = (ns - log.start_ns) * kNanosecond;
    entry.channel = std::string(fields[at - 1]);
    log.entries.push_back(std::move(entry));
  });
  return log;
}

std::string candump_frame(const Frame &frame) {
  std::string text =
      frame.extended ? fmt::format("{:08X}#", frame.id) : fmt::format("{:03X}#", frame.id);
  const unsigned length = frame.dlc > 8 ? 8U : frame.dlc;
  if (frame.remote)
    text += length != 0 ? fmt::format("R{}", length) : "R";
  else
    for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02X}", frame.data[i]);
  if (frame.dlc > 8) text += fmt::format("_{:X}", frame.dlc);
  return text;
}

void CandumpWriter::write(const LogEntry &entry) {
  const std::int64_t us = start_ns_ / 1000 + entry.time / kMicrosecond;
  fmt::print(out_, "({:010d}.{:06d}) {} {}\n", us / 1'000'000, us % 1'000'000,
             entry.channel.empty() ? "can0" : entry.channel, candump_frame(entry.frame));
}

}  // namespace vericansim

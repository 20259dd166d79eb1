// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// candump logs: parser and writer.
#include "trace/candump.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <cctype>
#include <utility>

#include "trace/candump_screen.hpp"
#include "trace/fd_lengths.hpp"
#include "trace/input_error.hpp"
#include "trace/log_builder.hpp"

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
    fail(place, "identifier " + in_quotes(std::string(digits)) +
                    " is not allowed; allowed: 3 (11 bit) or 8 (29 bit) hexadecimal digits");
  if (digits.size() == 8 && (*id & kErrorFlag) != 0) return false;
  text::set_id(frame, *id, digits.size() == 8, place);
  return true;
}

/// The raw DLC behind '_': one hexadecimal digit 9..F, only with eight bytes (or R8).
void parse_raw_dlc(std::string_view digit, Frame &frame, const Place &place) {
  const auto dlc = text::parse_unsigned(digit, 16);
  if (!dlc || digit.size() != 1 || *dlc < 9 || frame.dlc != 8)
    fail(place, "raw DLC " + in_quotes(std::string(digit)) +
                    " is not allowed; allowed: _9 to _F after 8 bytes");
  frame.dlc = static_cast<std::uint8_t>(*dlc);
}

void parse_remote(std::string_view rest, Frame &frame, const Place &place) {
  frame.remote = true;
  if (rest.empty()) return;
  if (rest[0] < '0' || rest[0] > '8')
    fail(place, "remote DLC " + in_quotes(std::string(rest)) + " is not allowed; allowed: 0 to 8");
  frame.dlc = static_cast<std::uint8_t>(rest[0] - '0');
  if (rest.size() == 1) return;
  if (rest[1] != '_') fail(place, "frame ends with " + in_quotes(std::string(rest)) + kFrameForm);
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

/// What stands behind "##" or behind an error message's '#': bytes, and for CAN FD flags in front.
std::string checked_digits(std::string_view digits, std::size_t most, const Place &place) {
  std::string result;
  for (const char c : digits) {
    if (c == '.') continue;
    if (!text::parse_unsigned({&c, 1}, 16))
      fail(place, "data " + in_quotes(std::string(digits)) + " is not hexadecimal");
    result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  if (result.size() > most)
    fail(place,
         fmt::format("{} data digits are not allowed; allowed: up to {}", result.size(), most));
  return result;
}

/// A CAN FD frame or error message in the one form that candump writes.
ForeignEntry foreign_entry(std::string_view text, const Place &place) {
  constexpr std::size_t kFdDigits = 1 + 2 * 64, kErrorDigits = 2 * 8;
  const std::size_t hash = text.find('#');
  const bool fd = text.substr(hash).starts_with("##");
  ForeignEntry entry;
  entry.kind = fd ? ForeignEntry::Kind::kFd : ForeignEntry::Kind::kError;
  // An error message of Linux always has eight bytes; a raw DLC says nothing about it.
  const std::string_view data = text.substr(hash + (fd ? 2 : 1));
  const std::string digits =
      checked_digits(data.substr(0, data.find('_')), fd ? kFdDigits : kErrorDigits, place);
  if (digits.size() % 2 != (fd ? 1 : 0))
    fail(place, fd ? "CAN FD frame without flags or with half a byte; allowed: 123##<flags><data>"
                   : "odd number of data digits");
  if (fd && !is_fd_length(digits.size() / 2))
    fail(place, fmt::format("CAN FD frame of {} bytes is not allowed; allowed: {}",
                            digits.size() / 2, fmt::join(kFdLengths, ", ")));
  entry.text = checked_digits(text.substr(0, hash), 8, place) + (fd ? "##" : "#") + digits;
  if (Frame checked; fd)  // with the flag of an error message it is neither
    text::set_id(checked, text::parse_unsigned(text.substr(0, hash), 16).value_or(0), hash == 8,
                 place);
  return entry;
}

/// One line of a log: "(TIME) INTERFACE FRAME", with " R" or " T" behind it from `candump -x`.
void parse_log_line(const std::vector<std::string_view> &fields, LogBuilder &log,
                    const Place &place) {
  const bool stamped = fields[0].front() == '(';
  const std::size_t at = stamped ? 2 : 1;  // the frame follows the channel
  const std::string_view last = fields.size() > at + 1 ? fields[at + 1] : std::string_view{};
  if (fields.size() > at + 2 || (!last.empty() && last != "R" && last != "T"))
    fail(place, "what follows the frame, " + in_quotes(std::string(fields.back())) +
                    ", is not allowed; allowed: R or T");
  CandumpLine line;
  line.ns = stamped ? parse_candump_stamp(fields[0], place) : 0;
  line.channel = fields[at - 1];
  line.frame = fields[at];
  if (last == "R") line.direction = Direction::kReceived;
  if (last == "T") line.direction = Direction::kSent;
  add_candump_line(line, log, place);
}

}  // namespace

bool parse_candump_frame(std::string_view text, Frame &frame, const Place &place) {
  frame = Frame{};
  const std::size_t hash = text.find('#');
  if (hash == std::string_view::npos)
    fail(place, "frame " + in_quotes(std::string(text)) + " has no '#'" + kFrameForm);
  if (!parse_id(text.substr(0, hash), frame, place)) return false;
  const std::string_view rest = text.substr(hash + 1);
  if (!rest.empty() && rest[0] == '#') return false;  // CAN FD
  if (!rest.empty() && (rest[0] == 'R' || rest[0] == 'r'))
    parse_remote(rest.substr(1), frame, place);
  else
    parse_data(rest, frame, place);
  return true;
}

std::int64_t parse_candump_stamp(std::string_view field, const Place &place) {
  const bool framed = field.size() > 2 && field.front() == '(' && field.back() == ')';
  const auto ns =
      framed ? text::parse_decimal(field.substr(1, field.size() - 2), 1'000'000'000) : std::nullopt;
  if (!ns)
    fail(place, "time " + in_quotes(std::string(field)) +
                    " is not allowed; allowed: (seconds.microseconds)");
  return *ns;
}

std::optional<ForeignEntry::Kind> add_candump_line(const CandumpLine &line, LogBuilder &log,
                                                   const Place &place) {
  if (text::has_control(line.channel))
    fail(place, "interface " + in_quotes(line.channel) +
                    " is not allowed; allowed: a name without control characters");
  LogEntry entry{0, line.channel, {}, line.direction};
  if (parse_candump_frame(line.frame, entry.frame, place)) {
    log.add(line.ns, std::move(entry), place);
    return {};
  }
  ForeignEntry other = foreign_entry(line.frame, place);
  other.channel = line.channel;
  other.direction = line.direction;
  const ForeignEntry::Kind kind = other.kind;
  log.add(line.ns, std::move(other), place);
  return kind;
}

CanLog parse_candump(std::string_view text, const std::string &file) {
  LogBuilder log;
  CandumpScreen screen{text};
  text::for_each_line(text, file, [&](std::string_view line, const Place &place) {
    const auto fields = text::split_blanks(line);
    if (fields.empty() || fields[0].front() == '#') return;
    if (fields[0] == "DROPCOUNT:") {  // candump -d: frames that its computer has lost
      log.skip();
      return;
    }
    const std::size_t at = fields[0].front() == '(' ? 2 : 1;
    if (fields.size() > at && fields[at].find('#') != std::string_view::npos)
      parse_log_line(fields, log, place);
    else
      screen.parse(line, log, place);
    // A file that is cut within its last frame may hold a shorter one.
    if (line.data() + line.size() == text.data() + text.size())
      log.warn(fmt::format("line {} has no line end; its frame may be cut short", place.line));
  });
  return log.finish(true);
}

std::string candump_frame(const Frame &frame) {
  frame.validate();
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
  write(entry.time, entry.channel, candump_frame(entry.frame), entry.direction);
}

void CandumpWriter::write(const ForeignEntry &entry) {
  write(entry.time, entry.channel, entry.text, entry.direction);
}

void CandumpWriter::write(Time time, const std::string &channel, const std::string &frame,
                          Direction direction) {
  const std::int64_t ns = start_ns_ + time / kNanosecond;
  const std::int64_t fraction = ns % 1'000'000'000;
  fmt::print(
      out_, "({:010d}.{}) {} {}{}\n", ns / 1'000'000'000,
      nanoseconds_ ? fmt::format("{:09d}", fraction) : fmt::format("{:06d}", fraction / 1000),
      channel.empty() ? "can0" : channel, frame,
      direction == Direction::kUnknown ? ""
      : direction == Direction::kSent  ? " T"
                                       : " R");
}

}  // namespace vericansim

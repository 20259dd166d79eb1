// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GVRET logs: parser.
#include "trace/gvret.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

#include "trace/channel_numbers.hpp"

#include "trace/input_error.hpp"
#include "trace/log_builder.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

using text::fail;
using text::Place;

/// Places of the columns that differ between versions of the format.
struct Columns {
  std::size_t direction = 0;  ///< 0: none
  std::size_t bus = 3;
  std::size_t length = 4;
  std::size_t data = 5;
};

Columns parse_header(std::string_view line, const Place &place) {
  const auto names = text::split_commas(line);
  Columns columns;
  const auto length = std::find(names.begin(), names.end(), "LEN");
  const auto bus = std::find(names.begin(), names.end(), "Bus");
  const auto direction = std::find(names.begin(), names.end(), "Dir");
  if (names.size() < 5 || names[1] != "ID" || names[2] != "Extended" || length == names.end() ||
      bus == names.end())
    fail(place, "expected the columns Time Stamp,ID,Extended,Bus,LEN,D1,...");
  if (direction != names.end())
    columns.direction = static_cast<std::size_t>(direction - names.begin());
  columns.bus = static_cast<std::size_t>(bus - names.begin());
  columns.length = static_cast<std::size_t>(length - names.begin());
  columns.data = columns.length + 1;
  return columns;
}

// SavvyCAN writes eight bytes whatever LEN is, those behind it zero or left over from the frame
// before, and reads LEN of them. What is no byte there, or a ninth, is of another length.
void check_behind(const std::vector<std::string_view> &fields, const Columns &columns,
                  std::size_t length, const Place &place) {
  Frame ignored;
  for (std::size_t i = length; columns.data + i < fields.size(); ++i) {
    const std::string_view field = text::trimmed(fields[columns.data + i]);
    if (!field.empty()) text::set_byte(ignored, i, field, place);
  }
}

LogEntry parse_entry(const std::vector<std::string_view> &fields, const Columns &columns,
                     const Place &place) {
  if (fields.size() <= std::max({columns.length, columns.bus, columns.direction, std::size_t{2}}))
    fail(place, "too few columns; see the header line");
  LogEntry entry;
  const auto id = text::parse_unsigned(fields[1], 16);
  if (!id || (fields[2] != "true" && fields[2] != "false"))
    fail(place, "identifier " + in_quotes(std::string(fields[1])) + " or Extended " +
                    in_quotes(std::string(fields[2])) +
                    " is not allowed; allowed: hexadecimal, true or false");
  text::set_id(entry.frame, *id, fields[2] == "true", place);
  const auto length = text::parse_unsigned(fields[columns.length], 10);
  if (!length || *length > 8)
    fail(place, "LEN " + in_quotes(std::string(fields[columns.length])) +
                    " is not allowed; allowed: 0 to 8");
  if (fields.size() < columns.data + *length)
    fail(place, fmt::format("fewer data bytes than LEN = {}", *length));
  entry.frame.dlc = static_cast<std::uint8_t>(*length);
  for (std::size_t i = 0; i < *length; ++i)
    text::set_byte(entry.frame, i, text::trimmed(fields[columns.data + i]), place);
  check_behind(fields, columns, *length, place);
  const std::string_view direction =
      columns.direction != 0 ? text::trimmed(fields[columns.direction]) : std::string_view{};
  if (!direction.empty()) entry.direction = direction_of(direction, place);
  const auto bus = text::parse_unsigned(text::trimmed(fields[columns.bus]), 10);
  if (!bus)
    fail(place, "Bus " + in_quotes(std::string(fields[columns.bus])) +
                    " is not allowed; allowed: a number");
  entry.channel = fmt::format("can{}", *bus);
  return entry;
}

}  // namespace

CanLog parse_gvret(std::string_view text, const std::string &file) {
  LogBuilder log;
  Columns columns;
  bool header = false;
  text::for_each_line(text, file, [&](std::string_view line, const Place &place) {
    if (text::trimmed(line).empty()) return;
    if (!header) {
      columns = parse_header(line, place);
      header = true;
      return;
    }
    const auto fields = text::split_commas(line);
    const auto ns = text::parse_decimal(text::trimmed(fields[0]), 1000);
    if (!ns)
      fail(place, "time " + in_quotes(std::string(fields[0])) + " is no number of microseconds");
    log.add(*ns, parse_entry(fields, columns, place), place);
  });
  return log.finish(false);
}

std::string gvret_text(const CanLog &log) {
  const auto numbers = channel_numbers(log);
  std::string text = "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n";
  for (const LogEntry &entry : log.entries) {
    const std::int64_t ns = log.start_ns + entry.time / kNanosecond;
    fmt::format_to(std::back_inserter(text), "{},{:08X},{},{},{},{}", ns / 1000, entry.frame.id,
                   entry.frame.extended, entry.direction == Direction::kSent ? "Tx" : "Rx",
                   entry.channel.empty() ? 0 : numbers.at(entry.channel),
                   entry.frame.payload_size());
    for (std::size_t i = 0; i < 8; ++i)
      text += i < entry.frame.payload_size() ? fmt::format(",{:02X}", entry.frame.data[i]) : ",";
    text += '\n';
  }
  return text;
}

}  // namespace vericansim

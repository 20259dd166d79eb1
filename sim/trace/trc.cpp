// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PCAN-View trace files: parser.
#include "trace/trc.hpp"

#include <fmt/format.h>

#include "trace/input_error.hpp"
#include "trace/log_builder.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

using text::fail;
using text::Place;

/// ";$FILEVERSION=1.1"; the columns of other versions differ.
void check_version(std::string_view line, const Place &place) {
  constexpr std::string_view kKey = ";$FILEVERSION=";
  if (line.starts_with(kKey) && text::trimmed(line.substr(kKey.size())) != "1.1")
    fail(place, "version " + quoted(std::string(line.substr(kKey.size()))) +
                    " is not known; allowed: 1.1");
}

/// Columns: number, milliseconds, type, identifier, length, then bytes or "RTR".
Frame parse_frame(const std::vector<std::string_view> &fields, const Place &place) {
  Frame frame;
  const auto id = text::parse_unsigned(fields[3], 16);
  if (!id || (fields[3].size() != 4 && fields[3].size() != 8))
    fail(place, "identifier " + quoted(std::string(fields[3])) +
                    " is not allowed; allowed: 4 or 8 hexadecimal digits");
  text::set_id(frame, *id, fields[3].size() == 8, place);
  const auto length = text::parse_unsigned(fields[4], 10);
  if (!length || *length > 8)
    fail(place, "length " + quoted(std::string(fields[4])) + " is not allowed; allowed: 0 to 8");
  frame.dlc = static_cast<std::uint8_t>(*length);
  if (fields.size() > 5 && fields[5] == "RTR") {
    frame.remote = true;
    return frame;
  }
  if (fields.size() < 5 + *length)
    fail(place, fmt::format("{} data bytes where the length says {}", fields.size() - 5, *length));
  for (std::size_t i = 0; i < *length; ++i) text::set_byte(frame, i, fields[5 + i], place);
  return frame;
}

}  // namespace

CanLog parse_trc(std::string_view text, const std::string &file) {
  LogBuilder log;
  text::for_each_line(text, file, [&](std::string_view line, const Place &place) {
    check_version(line, place);
    const auto fields = text::split_blanks(line);
    if (fields.empty() || fields[0].front() == ';') return;
    if (fields.size() < 5) fail(place, "expected NUMBER) TIME TYPE IDENTIFIER LENGTH BYTES");
    if (fields[2] != "Rx" && fields[2] != "Tx") {
      log.skip();
      return;
    }
    const auto ns = text::parse_decimal(fields[1], 1'000'000);
    if (!ns)
      fail(place, "time " + quoted(std::string(fields[1])) + " is no number of milliseconds");
    const Direction direction = fields[2] == "Tx" ? Direction::kSent : Direction::kReceived;
    log.add(*ns, {0, "", parse_frame(fields, place), direction}, place);
  });
  return log.finish(false);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Pieces that the text formats share: lines, fields, numbers; each failure is an InputError with
// its line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim::text {

/// Where a value stands, for messages.
struct Place {
  std::string file;
  std::size_t line = 0;  ///< from 1
};

/// Throws InputError "file:line: message".
[[noreturn]] void fail(const Place &place, const std::string &message);

/// Calls `use(line, place)` for each line without its line end (LF or CR LF).
template <typename Use>
void for_each_line(std::string_view text, const std::string &file, Use use) {
  Place place{file, 0};
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++place.line;
    use(line, place);
  }
}

/// Fields between blanks or tabs.
[[nodiscard]] std::vector<std::string_view> split_blanks(std::string_view line);
/// Fields between commas; empty fields are kept.
[[nodiscard]] std::vector<std::string_view> split_commas(std::string_view line);
/// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A field of a CSV file as it is written (RFC 4180): in quotes if need be.
[[nodiscard]] std::string csv_field(std::string_view text);

/// Whether there is a control character in a text: in a table or on a terminal it is no text.
[[nodiscard]] bool has_control(std::string_view text);
/// The text with '?' for each of them.
[[nodiscard]] std::string printable(std::string_view text);

/// "1 frame", "2 frames".
[[nodiscard]] std::string counted(std::size_t count, std::string_view one, std::string_view many);

/// A whole unsigned number in `base`, or nothing if there is any other character or more than 64
/// bits.
[[nodiscard]] std::optional<std::uint64_t> parse_unsigned(std::string_view text, int base);
/// "1436509052.249713" in seconds or milliseconds (`unit` = picoseconds of one) without rounding by
/// a floating-point type; up to 12 decimals. Nothing if malformed or out of range.
[[nodiscard]] std::optional<std::int64_t> parse_decimal(std::string_view text, std::int64_t unit);

/// Sets the identifier; throws if it does not fit 11 or 29 bits.
void set_id(Frame &frame, std::uint64_t id, bool extended, const Place &place);
/// Parses two hexadecimal digits into data byte `index`; throws if it is no byte.
void set_byte(Frame &frame, std::size_t index, std::string_view digits, const Place &place);
/// The digits of the `count` data bytes from `fields[first]` on, one behind the other; throws if
/// there are fewer or more, or one is not of two characters.
[[nodiscard]] std::string byte_digits(const std::vector<std::string_view> &fields,
                                      std::size_t first, std::size_t count, const Place &place);

}  // namespace vericansim::text

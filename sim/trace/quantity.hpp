// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Quantities with units as people write them: "8 MHz", "500k", "10 ms", "40 m", "87.5 %".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bus/types.hpp"

namespace vericansim {

/// Each parses the whole text and gives nothing if it is malformed; blanks between number and unit
/// are allowed. Hz, kHz, MHz, GHz, or k and M; a bare number is Hz.
[[nodiscard]] std::optional<double> parse_frequency(std::string_view text);
/// bit/s, kbit/s, Mbit/s, or k and M; a bare number is bit/s.
[[nodiscard]] std::optional<double> parse_bitrate(std::string_view text);
/// ps, ns, us, ms, s; a bare number is refused, except 0. Rounded to picoseconds.
[[nodiscard]] std::optional<Time> parse_time(std::string_view text);
/// m, cm, km; a bare number is metres.
[[nodiscard]] std::optional<double> parse_length(std::string_view text);
/// "87.5 %" or 0.875: a part of 1.
[[nodiscard]] std::optional<double> parse_part(std::string_view text);
/// A decimal number, nothing else.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// Decimal, 0x or 0b.
[[nodiscard]] std::optional<std::uint64_t> parse_integer(std::string_view text);

/// "100 s", "1 us": nothing is rounded, in the largest unit that leaves a whole number.
[[nodiscard]] std::string exact_time(Time time);
/// "12.345 ms" with the unit that suits.
[[nodiscard]] std::string readable_time(Time time);

/// A number as people write it: whole ones with all their digits, others with ten significant ones.
[[nodiscard]] std::string plain_number(double value);

}  // namespace vericansim

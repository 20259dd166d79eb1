// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What candump prints on a screen, in: "can0  123   [2]  11 22", with all its options.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "trace/log_builder.hpp"
#include "trace/text.hpp"

namespace vericansim {

/// Reads the lines of one such text. Times in front (-t): absolute (a; A in this
/// computer's time zone), since the first line (z), or since the line before (d). A first time of
/// zero with a later one below its predecessor's means -td; -td whose distances only grow looks
/// like -tz and is taken as that. -x: direction, and for CAN FD the flags. What stands behind the
/// bytes (-a) is left out, as are the lines of -e that explain an error message. Without times all
/// entries are at 0.
class CandumpScreen {
 public:
  /// `text`: all of it, to see which kind of times it has.
  explicit CandumpScreen(std::string_view text);
  /// Adds the frame of `line`; throws InputError if there is none.
  void parse(std::string_view line, LogBuilder &log, const text::Place &place);

 private:
  using Fields = std::vector<std::string_view>;
  /// Takes the time off the front of `fields`.
  std::int64_t take_stamp(Fields &fields, const text::Place &place);

  bool differences_ = false;
  std::int64_t sum_ns_ = 0;
  bool error_message_ = false;  ///< the last line was one
};

/// True if `line` could be screen output of candump.
[[nodiscard]] bool looks_like_candump_screen(std::string_view line);

}  // namespace vericansim

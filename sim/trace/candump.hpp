// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The log format of can-utils' candump, in and out: "(1436509052.249713) can0 123#11223344".
#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include "trace/log.hpp"
#include "trace/text.hpp"

namespace vericansim {

/// Parses a whole log: lines of `candump -l`, or of candump's screen output ("can0  123   [2]  11
/// 22", also with a time in front, then without times all entries are at 0). Empty lines and '#'
/// comments are skipped; CAN FD frames ("##") and error messages (identifier with bit 29) are
/// counted as skipped. Throws InputError with the line of the first mistake.
[[nodiscard]] CanLog parse_candump(std::string_view text, const std::string &file);

/// Parses "123#1122", "12345678#R8", "123#1122334455667788_F" (raw DLC 9..15 after '_').
/// Returns false for a CAN FD frame or an error message, which are no classical frames.
bool parse_candump_frame(std::string_view text, Frame &frame, const text::Place &place);

/// The inverse of parse_candump_frame().
[[nodiscard]] std::string candump_frame(const Frame &frame);

/// True if `line` could be screen output of candump.
[[nodiscard]] bool looks_like_candump_text(std::string_view line);

/// Writes candump logs.
class CandumpWriter {
 public:
  /// `start_ns` is added to each time; the stream must outlive the writer.
  explicit CandumpWriter(std::ostream &out, std::int64_t start_ns = 0)
      : out_{out}, start_ns_{start_ns} {}
  /// Appends one frame; times are cut to microseconds.
  void write(const LogEntry &entry);

 private:
  std::ostream &out_;
  std::int64_t start_ns_;
};

}  // namespace vericansim

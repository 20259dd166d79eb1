// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The log format of can-utils' candump, in and out: "(1436509052.249713) can0 123#11223344".
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "trace/log.hpp"
#include "trace/text.hpp"

namespace vericansim {

/// Parses a whole log: lines of `candump -l` (with -x also the direction behind the frame), or of
/// candump's screen output (candump_screen.hpp). Empty lines and '#' comments are left out; CAN FD
/// frames ("##") and error messages (identifier with bit 29) are counted as skipped and kept in
/// CanLog::others. Throws InputError with the line of the first mistake.
[[nodiscard]] CanLog parse_candump(std::string_view text, const std::string &file);

/// Parses "123#1122", "12345678#R8", "123#1122334455667788_F" (raw DLC 9..15 after '_').
/// Returns false for a CAN FD frame or an error message, which are no classical frames.
bool parse_candump_frame(std::string_view text, Frame &frame, const text::Place &place);

/// The inverse of parse_candump_frame(). Throws as Frame::validate().
[[nodiscard]] std::string candump_frame(const Frame &frame);

/// "(1436509052.249713)" in nanoseconds; throws InputError if it is no such time.
[[nodiscard]] std::int64_t parse_candump_stamp(std::string_view field, const text::Place &place);

class LogBuilder;

/// A line of a log, taken apart.
struct CandumpLine {
  std::int64_t ns = 0;  ///< since the Unix epoch, or whatever the log counts from
  std::string channel;
  std::string frame;  ///< "123#1122"
  Direction direction = Direction::kUnknown;
};
/// Adds it as what it is: a classical frame, or what is returned. Throws InputError if its frame
/// cannot be read.
std::optional<ForeignEntry::Kind> add_candump_line(const CandumpLine &line, LogBuilder &log,
                                                   const text::Place &place);

/// Writes candump logs.
class CandumpWriter {
 public:
  /// `start_ns` is added to each time; the stream must outlive the writer. `nanoseconds`: nine
  /// decimals, as of `candump -N`, instead of six.
  explicit CandumpWriter(std::ostream &out, std::int64_t start_ns = kLogOriginNs,
                         bool nanoseconds = false)
      : out_{out}, start_ns_{start_ns}, nanoseconds_{nanoseconds} {}
  /// Appends one frame; times are cut to microseconds or nanoseconds. Throws as
  /// Frame::validate().
  void write(const LogEntry &entry);
  /// The same for what is no classical frame.
  void write(const ForeignEntry &entry);

 private:
  void write(Time time, const std::string &channel, const std::string &frame, Direction direction);

  std::ostream &out_;
  std::int64_t start_ns_;
  bool nanoseconds_;
};

}  // namespace vericansim

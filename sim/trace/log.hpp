// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CanLog: recorded traffic, whatever the file format: frames with their times, in the order of the
// bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bus/types.hpp"
#include "model/frame.hpp"
#include "trace/input_file.hpp"
#include "trace/log_format.hpp"

namespace vericansim {

/// Whether the recording computer sent the frame or received it.
enum class Direction : std::uint8_t { kUnknown, kReceived, kSent };

/// One recorded frame.
struct LogEntry {
  Time time = 0;             ///< picoseconds since the first entry of the log
  std::string channel = {};  ///< interface name ("can0"); empty where the format has none
  Frame frame = {};
  Direction direction = Direction::kUnknown;
};

/// What classical CAN cannot carry: a CAN FD frame or an error message of a driver. `convert` takes
/// it along; a replay passes over it.
struct ForeignEntry {
  enum class Kind : std::uint8_t { kFd, kError };
  std::size_t before = 0;  ///< index in CanLog::entries of the frame that follows
  Time time = 0;           ///< as LogEntry::time; negative before the first classical frame
  std::string channel;
  Kind kind = Kind::kError;
  std::string text;  ///< as candump writes it: "123##1AABB", "20000080#0000000000000000"
  Direction direction = Direction::kUnknown;
};

/// What a simulation's time 0 is in the logs that it writes: 1 s, ns. can-utils' log2asc takes
/// times below 1 s for "no frame yet".
inline constexpr std::int64_t kLogOriginNs = 1'000'000'000;

/// A recording. Entries that classical CAN cannot carry are in `others`; status lines and what else
/// is no frame are only counted.
struct CanLog {
  std::vector<LogEntry> entries;
  std::size_t skipped = 0;    ///< lines or packets that hold no classical data or remote frame
  std::int64_t start_ns = 0;  ///< absolute time of the first entry (Unix epoch), 0 if unknown
  std::vector<ForeignEntry> others;   ///< counted in `skipped`, too
  std::vector<std::string> warnings;  ///< what a reader should know who trusts the recording

  /// How many of `skipped` are of this kind.
  [[nodiscard]] std::size_t count(ForeignEntry::Kind kind) const;
  /// Time of the earliest entry, 0 or below: before the first classical frame there may be others,
  /// and times may go back.
  [[nodiscard]] Time earliest() const;
};

/// "3 CAN FD frames, 2 error messages, 1 other line or packet"; empty if nothing was skipped.
[[nodiscard]] std::string skipped_text(const CanLog &log);

/// Reads a log of any known format ("-": standard input, .gz is unpacked); the format is taken from
/// the first bytes. Throws InputError if the file cannot be read or parsed.
[[nodiscard]] CanLog read_log(const std::string &path);
/// Reads `text` as if it stood in the file `path`.
[[nodiscard]] CanLog parse_log(std::string_view text, const std::string &path);

}  // namespace vericansim

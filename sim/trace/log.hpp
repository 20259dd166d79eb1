// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CanLog: recorded traffic, whatever the file format: frames with their times, in the order of the
// bus.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// One recorded frame.
struct LogEntry {
  Time time = 0;        ///< picoseconds since the first entry of the log
  std::string channel;  ///< interface name ("can0"); empty where the format has none
  Frame frame;
};

/// A recording. Entries that classical CAN cannot carry (CAN FD frames, error messages of a driver,
/// status lines) are counted, not kept.
struct CanLog {
  std::vector<LogEntry> entries;
  std::size_t skipped = 0;    ///< lines or packets that hold no classical data or remote frame
  std::int64_t start_ns = 0;  ///< absolute time of the first entry (Unix epoch), 0 if unknown
};

/// Formats by what the file holds, never by its name.
enum class LogFormat { kCandump, kPcap, kTrc, kGvret };

/// "candump", "pcap", "PCAN-View trc" or "GVRET csv".
[[nodiscard]] const char *name_of(LogFormat format);

/// Reads a log of any known format; the format is taken from the first bytes.
/// Throws InputError if the file cannot be read or parsed.
[[nodiscard]] CanLog read_log(const std::string &path);
/// Reads `text` as if it stood in the file `path`.
[[nodiscard]] CanLog parse_log(std::string_view text, const std::string &path);

/// The format that read_log() will take for `path`. Throws InputError if the file is of no known
/// kind.
[[nodiscard]] LogFormat detect_log_format(const std::string &path);
/// The same for `text`, as if it stood in the file `path`.
[[nodiscard]] LogFormat detect_log_format(std::string_view text, const std::string &path);

/// Reads a whole file. Throws InputError if it cannot be opened.
[[nodiscard]] std::string read_text_file(const std::string &path);

}  // namespace vericansim

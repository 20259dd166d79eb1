// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The formats of recordings: names, file names, and what they can hold.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vericansim {

/// Formats by what the file holds, never by its name.
enum class LogFormat : std::uint8_t {
  kCandump,
  kPcap,
  kPcapng,
  kTrc,
  kGvret,
  kAsc,
  kBlf,
  kCsv,
  kSqlite,
};

/// What there is to know of a format.
struct LogFormatTraits {
  LogFormat format;
  const char *option;  ///< its name on the command line: "asc"
  const char *name;    ///< for people: "Vector ASC"
  const char *ending;  ///< of file names; empty: no file name means this format
  bool python;         ///< read and written by python-can
  bool fd;             ///< its writer has CAN FD frames,
  bool errors;         ///< error messages,
  bool remote;         ///< remote frames,
  bool raw_dlc;        ///< and DLC 9 to 15
};

[[nodiscard]] const LogFormatTraits &traits_of(LogFormat format);
/// "candump", "pcap", "PCAN-View trc", "GVRET csv", "Vector ASC" and so on.
[[nodiscard]] const char *name_of(LogFormat format);

/// The format of `option`, or, if that is empty, of the ending of `path` (before ".gz"). Throws
/// InputError with the names and endings that there are.
[[nodiscard]] LogFormat output_format(const std::string &option, const std::string &path);

/// The format that read_log() will take for `path`. Throws InputError if the file is of no known
/// kind.
[[nodiscard]] LogFormat detect_log_format(const std::string &path);
/// The same for `text`, as if it stood in the file `path`.
[[nodiscard]] LogFormat detect_log_format(std::string_view text, const std::string &path);

}  // namespace vericansim

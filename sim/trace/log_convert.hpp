// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Recordings from one format to another, with what the other one cannot hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trace/log.hpp"

namespace vericansim {

/// What came of a conversion.
struct Conversion {
  std::string bytes;              ///< the new file
  std::size_t frames = 0;         ///< entries of all kinds in it
  std::vector<std::string> lost;  ///< one phrase for each kind of loss, with its count
  bool faithful = true;           ///< identifier, data and order of all frames in it are the same
  std::string difference;         ///< if not: which frame is the first other one, and what it is
};

/// The time at which a file or a line has the first entry of `log`: its time of day. Without one it
/// is 0, unless something lies before it, whose time no format could hold: that is at 0 then.
[[nodiscard]] std::int64_t written_start_ns(const CanLog &log);

/// `log` in `format`. The new file is read again and compared entry by entry, so that `lost` is
/// what a reader of it really misses. `path` is for messages. Throws InputError if python-can is
/// needed and not there, or if the new file cannot be read.
[[nodiscard]] Conversion convert(const CanLog &log, LogFormat format, const std::string &path);

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PCAN-View trace files (.trc), in and out, after PEAK's "TRC file format".
#pragma once

#include <string>
#include <string_view>

#include "trace/log.hpp"

namespace vericansim {

/// Parses versions 1.0 to 1.3, 2.0 and 2.1: "1)  48.6  Rx  09F11201  8  FF 50 ..."; comment lines
/// begin with ';'. Times are milliseconds since the file's $STARTTIME (this computer's time zone).
/// CAN FD frames are kept in CanLog::others; error, status and warning lines are counted as
/// skipped. Throws InputError with the line of the first mistake.
[[nodiscard]] CanLog parse_trc(std::string_view text, const std::string &file);

/// A file of version 2.1 with everything but error messages; times to the microsecond. A log that
/// knows no time of day gets none.
[[nodiscard]] std::string trc_text(const CanLog &log);

}  // namespace vericansim

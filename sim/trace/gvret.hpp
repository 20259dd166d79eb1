// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SavvyCAN's native comma-separated logs (GVRET), in and out.
#pragma once

#include <string>
#include <string_view>

#include "trace/log.hpp"

namespace vericansim {

/// Parses "Time Stamp,ID,Extended,Bus,LEN,D1,...,D8": microseconds, hexadecimal identifier and
/// bytes; newer files have a column "Dir" after Extended. Bytes beyond LEN are ignored. Throws
/// InputError with the line of the first mistake.
[[nodiscard]] CanLog parse_gvret(std::string_view text, const std::string &file);

/// Data frames as SavvyCAN's newer versions write them: microseconds since the epoch or since the
/// first frame, column "Dir".
[[nodiscard]] std::string gvret_text(const CanLog &log);

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PCAN-View trace files (.trc), version 1.1, in.
#pragma once

#include <string>
#include <string_view>

#include "trace/log.hpp"

namespace vericansim {

/// Parses "1)  48.6  Rx  09F11201  8  FF 50 ..."; comment lines begin with ';'. Error, status and
/// warning lines are counted as skipped. Identifiers of 4 digits are 11 bits, of 8 digits 29 bits.
/// Throws InputError with the line of the first mistake.
[[nodiscard]] CanLog parse_trc(std::string_view text, const std::string &file);

}  // namespace vericansim

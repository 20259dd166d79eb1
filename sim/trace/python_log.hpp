// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Recordings in the formats that python-can knows, through sim/python/log_format.py.
#pragma once

#include <string>
#include <string_view>

#include "trace/log.hpp"

namespace vericansim {

/// Reads `bytes`, which stood in the file `path`. Interfaces that the format only numbers are
/// "can0", "can1"... Throws InputError if the file is damaged or python-can is not installed.
[[nodiscard]] CanLog parse_python_log(std::string_view bytes, LogFormat format,
                                      const std::string &path);

/// The file that holds `log`; what the format cannot hold must not be in it (log_convert.hpp).
/// Interfaces become numbers: the digits at the end of their names, or, where two names end alike
/// or one has none, their order. `path` is for messages.
[[nodiscard]] std::string python_log_bytes(const CanLog &log, LogFormat format,
                                           const std::string &path);

}  // namespace vericansim

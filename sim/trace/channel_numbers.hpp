// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of interfaces, for formats that have no names.
#pragma once

#include <map>
#include <string>

#include "trace/log.hpp"

namespace vericansim {

/// A number from 0 for each interface of `log`: the digits at the end of its name ("can2": 2), or,
/// if a name has none, two end alike or one is above 254, the order in which they appear.
[[nodiscard]] std::map<std::string, unsigned> channel_numbers(const CanLog &log);

}  // namespace vericansim

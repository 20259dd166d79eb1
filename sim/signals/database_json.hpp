// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What sim/python/dbc_to_json.py prints, as messages.
#pragma once

#include <string>
#include <vector>

#include "signals/database.hpp"

namespace vericansim {

/// The messages of the file `path`. Throws InputError with the script's line and message if that is
/// what the JSON holds.
[[nodiscard]] std::vector<SignalMessage> messages_of_json(const std::string &path,
                                                          const std::string &json);

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What sim/python/dbc_to_json.py prints, as messages.
#pragma once

#include <string>
#include <vector>

#include "signals/database.hpp"

namespace vericansim {

struct DatabaseContent {
  std::vector<SignalMessage> messages;
  std::string text;  ///< the file in UTF-8, if it was in another encoding
};

/// The content of the file `path`. Throws InputError with the script's line and message if that is
/// what the JSON holds.
[[nodiscard]] DatabaseContent parse_database_json(const std::string &path, const std::string &json);

}  // namespace vericansim

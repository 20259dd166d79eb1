// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The nodes of a bus as `verican memory scan` lists them, and what is wrong with the list.
#pragma once

#include <string>
#include <vector>

#include "cli/cli.hpp"
#include "verican_remote.h"

namespace vericansim::cli {

using MemoryNodes = std::vector<verican_remote_identity_t>;

/// Numbers, and serial numbers, that several nodes have (RN-11).
[[nodiscard]] std::vector<std::string> complaints(const MemoryNodes &nodes);

/// Numbers under which two answers to one poll have come that differ.
[[nodiscard]] std::vector<std::string> complaints(const verican_remote_answers_t &answers);

/// The list as a table.
[[nodiscard]] std::string to_text(const MemoryNodes &nodes);
/// The list for --json; `number` is null where it is one of several shared ones.
[[nodiscard]] Json to_json(const MemoryNodes &nodes);

}  // namespace vericansim::cli

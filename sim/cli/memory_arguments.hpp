// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the subcommands of `verican memory` check of their arguments. All throw InputError, with
// what is allowed, but for require_answers().
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/memory_work.hpp"

namespace vericansim::cli {

using Bytes = std::vector<std::uint8_t>;

/// Refuses the `value` of `what`.
[[noreturn]] void refuse(const char *what, const std::string &value, const std::string &allowed);

/// The node that the options mean; `or_all`: or VERICAN_REMOTE_ALL.
[[nodiscard]] unsigned node_of(const MemoryCalls &calls, const MemoryOptions &options,
                               bool or_all = false);

/// There is something to move, and it ends below 0x1000.
void check_range(unsigned address, std::size_t length);

/// The node has `length` bytes from there on; `what` has them, a file or an option. Whole transfers
/// are held against that before anything is sent, so that none is left half done.
void require_room(MemoryCalls &calls, unsigned node, unsigned address, std::size_t length,
                  const std::string &what);

/// Hexadecimal bytes, each word one or more.
[[nodiscard]] Bytes bytes_of(const std::vector<std::string> &words);

/// Throws MemoryFailure if no node has answered: whoever asks all nodes has then, as a rule,
/// another bus or other numbers in mind.
void require_answers(const MemoryCalls &calls, bool any);

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of a Board's commands: what is missing or out of range is refused.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vericansim {

/// Throws InputError.
[[noreturn]] void refuse(const std::string &message);

/// Word `n`; without it refuse(), saying that the command needs `what`.
[[nodiscard]] std::string_view word(const std::vector<std::string_view> &words, std::size_t n,
                                    const char *what);

/// An integer from `low` to `high`, otherwise refuse().
[[nodiscard]] std::uint64_t number(std::string_view text, std::uint64_t low, std::uint64_t high,
                                   const char *what);

}  // namespace vericansim

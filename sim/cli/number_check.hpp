// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Values on the command line that CLI11 would take for others.
#pragma once

#include <string_view>

#include "cli/cli.hpp"

namespace vericansim::cli {

/// Whether a whole number has zeros in front, as in 010.
[[nodiscard]] bool has_leading_zeros(std::string_view number);

/// Adds a check to each option of `app` and of its subcommands that takes a number. Refused are a
/// whole number with zeros in front (strtoull() reads it as octal), one below 0 where there is no
/// sign, and what is no finite number. Flags take no value.
void check_numbers(CLI::App &app);

}  // namespace vericansim::cli

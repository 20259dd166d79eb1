// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a command line that CLI11 has refused, or would take for another one.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace vericansim::cli {

/// Throws InputError if a value is empty: it would stand for none. A shell makes it of a variable
/// that is not set.
void refuse_empty(int argc, char **argv);

/// Throws std::invalid_argument if the first word is no command of `app`: CLI11 would say that
/// there is no command at all.
void refuse_unknown_command(const CLI::App &app, int argc, char **argv);

/// One line that says what `error`, thrown by app.parse(), is about.
[[nodiscard]] std::string parse_mistake(const CLI::App &app, const CLI::ParseError &error, int argc,
                                        char **argv);

}  // namespace vericansim::cli

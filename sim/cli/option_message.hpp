// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What CLI11 says, in the words of this tool.
#pragma once

#include <string>

namespace vericansim::cli {

/// CLI11 writes the ends of ranges as "1e+06" and "1000.000000"; versions and addresses stay.
[[nodiscard]] std::string plain_digits(const std::string &text);

/// The message of an error of the command line: values as the user has typed them, shortened if
/// they are long, and the ends of ranges in plain digits.
[[nodiscard]] std::string option_message(const std::string &error, int argc, char **argv);

}  // namespace vericansim::cli

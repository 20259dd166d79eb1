// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs `verican` as a user does, and says what it printed.
#pragma once

#include <string>

namespace tb {

struct ToolResult {
  int code = -1;      ///< exit code; -1: it did not end by itself
  std::string out;    ///< stdout
  std::string error;  ///< stderr
};

/// The contents of a file; empty if there is none.
[[nodiscard]] std::string slurp(const std::string &path);
/// A name in the test program's own temporary folder that belongs to the running test.
[[nodiscard]] std::string temporary(const std::string &suffix);
/// Runs `verican ARGUMENTS`.
[[nodiscard]] ToolResult run_tool(const std::string &arguments);
/// Path of one of the example programs: "ping" gives .../ping.elf.
[[nodiscard]] std::string example_elf(const std::string &name);
/// Path of a test program of tb/firmware/programs.
[[nodiscard]] std::string test_elf(const std::string &name);

}  // namespace tb

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Messages on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace vericansim::cli {

/// Writes to standard error. A message that nobody can take, for the device is full or the reader
/// gone, is lost and changes nothing: the exit code stays that of what is told.
template <typename... Args>
void print_error(fmt::format_string<Args...> format, Args &&...args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// InputError: bad input of the user, told in one line: file, line, value, what is allowed.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace vericansim {

/// What a user typed or a file holds cannot be used. what() is "file:line: message", one line.
class InputError : public std::runtime_error {
 public:
  /// `line` counts from 1; 0 means that no line can be named (a binary file, an option).
  InputError(const std::string &file, std::size_t line, const std::string &message)
      : std::runtime_error(one_line(line != 0 ? file + ":" + std::to_string(line) + ": " + message
                                              : file + ": " + message)) {}

 private:
  /// Names and values from a file may hold anything; a message holds no control characters.
  static std::string one_line(std::string text) {
    for (char &c : text)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return text;
  }
};

/// A value from a file as it may appear in a message: control characters become '?', and long text
/// is cut.
[[nodiscard]] inline std::string in_quotes(const std::string &text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  for (std::size_t i = 0; i < text.size() && i < kLongest; ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    result += (c < 0x20 || c >= 0x7F) ? '?' : text[i];
  }
  return result + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace vericansim

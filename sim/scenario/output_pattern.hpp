// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputPattern: a regular expression (ECMAScript) for what firmware prints.
#pragma once

#include <regex>
#include <string>

namespace vericansim {

/// A regular expression that is looked for in time that grows as the text does, and on a stack that
/// does not grow with it. So there is no back reference and no look-ahead.
class OutputPattern {
 public:
  /// What may be given, for messages.
  static constexpr const char *kAllowed =
      "a regular expression (ECMAScript) of up to 1000 characters, without back references and "
      "look-ahead";

  /// Throws std::regex_error if `pattern` is none of these.
  explicit OutputPattern(const std::string &pattern);
  /// True if it is somewhere in `text`. Throws std::regex_error if that takes too much.
  [[nodiscard]] bool found_in(const std::string &text) const;

 private:
  std::regex up_to_it_;  // from the begin of the text to the end of what is looked for
};

}  // namespace vericansim

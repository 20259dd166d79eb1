// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputPattern: see output_pattern.hpp.
#include "scenario/output_pattern.hpp"

#include <string_view>

namespace vericansim {
namespace {

// libstdc++'s usual way calls itself for each letter and tries each way to match: a long text ends
// the stack, and (a+)* the patience. This one follows all ways at once and refuses back references.
constexpr auto kFlags =
    std::regex::ECMAScript | std::regex::nosubs | std::regex_constants::__polynomial;

constexpr std::size_t kLongestPattern = 1000;  // parentheses in each other cost stack

/// (?= and (?!, which would look at all of the text behind each letter.
bool looks_ahead(std::string_view pattern) {
  bool in_set = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::string_view rest = pattern.substr(i);
    if (rest.front() == '\\')
      ++i;
    else if (in_set)
      in_set = rest.front() != ']';
    else if (rest.starts_with("(?=") || rest.starts_with("(?!"))
      return true;
    else
      in_set = rest.front() == '[';
  }
  return false;
}

/// The pattern with all that may be before it, so that one pass over the text is enough.
std::string with_begin(const std::string &pattern) {
  if (pattern.size() > kLongestPattern || looks_ahead(pattern))
    throw std::regex_error{std::regex_constants::error_complexity};
  static_cast<void>(std::regex{pattern, kFlags});  // its parentheses are its own
  return "[^]*?(?:" + pattern + ")";
}

}  // namespace

OutputPattern::OutputPattern(const std::string &pattern) : up_to_it_{with_begin(pattern), kFlags} {}

bool OutputPattern::found_in(const std::string &text) const {
  return std::regex_search(text, up_to_it_, std::regex_constants::match_continuous);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See option_message.hpp.
#include "cli/option_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the number that begins at `from` ends, with its dots and its positive exponent.
std::size_t end_of_number(const std::string &text, std::size_t from) {
  std::size_t end = from;
  while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
  while (text[end - 1] == '.') --end;  // of a sentence
  if (end + 2 >= text.size() || text.compare(end, 2, "e+") != 0 || !is_digit(text[end + 2]))
    return end;
  end += 2;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end;
}

/// A number as a person writes it, if it has an exponent or nothing but zeros behind its dot.
std::string plain_number_of(const std::string &number) {
  constexpr std::size_t kLongest = 40;  // more than a range has
  const std::size_t dot = number.find('.');
  const bool one_dot = dot != std::string::npos && dot == number.rfind('.');
  const bool whole = one_dot && number.find_first_not_of('0', dot + 1) == std::string::npos;
  const bool exponent = number.find('e') != std::string::npos;
  if (number.size() > kLongest || !(whole || exponent) || (dot != std::string::npos && !one_dot))
    return number;
  const double value = std::strtod(number.c_str(), nullptr);
  return std::isfinite(value) ? fmt::format("{:.15g}", value) : number;
}

/// With words that are longer than any of the tool's cut.
std::string without_long_words(const std::string &text) {
  constexpr std::size_t kLongest = 80, kKept = 40;
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size() - 1) + 1;
    const std::string_view word{text.data() + at, end - at};
    result += word.substr(0, word.size() > kLongest ? kKept : word.size());
    if (word.size() > kLongest) result += word.back() == ' ' ? "... " : "...";
    at = end;
  }
  return result;
}

bool is_typed(const std::string &value, int argc, char **argv) {
  return std::any_of(argv, argv + argc,
                     [&](const char *word) { return std::string_view{word}.ends_with(value); });
}

}  // namespace

std::string plain_digits(const std::string &text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size();) {
    if (!is_digit(text[at])) {
      plain += text[at++];
      continue;
    }
    const std::size_t end = end_of_number(text, at);
    plain += plain_number_of(text.substr(at, end - at));
    at = end;
  }
  return plain;
}

std::string option_message(const std::string &error, int argc, char **argv) {
  constexpr std::string_view kValue = "Value ", kRange = " not in range ";
  constexpr std::string_view kConversion = "Could not convert: ", kIs = " = ";
  const std::size_t range = error.rfind(kRange), value = error.find(kValue);
  if (range != std::string::npos && value < range) {
    const std::size_t from = value + kValue.size();
    const std::string given = error.substr(from, range - from);
    // A unit has made another number of what was typed.
    return without_long_words(error.substr(0, from) +
                              (is_typed(given, argc, argv) ? given : plain_digits(given))) +
           plain_digits(error.substr(range));
  }
  constexpr std::string_view kFlag = " was given a disallowed flag override";
  if (error.ends_with(kFlag))
    return "--" + error.substr(0, error.size() - kFlag.size()) + " takes no value";
  // Numbers that are none have been refused before, so the type cannot hold this one.
  if (const std::size_t is = error.find(kIs);
      error.starts_with(kConversion) && is != std::string::npos)
    return error.substr(kConversion.size(), is - kConversion.size()) + ": " +
           in_quotes(error.substr(is + kIs.size())) + " is not allowed; allowed: smaller numbers";
  return without_long_words(error);
}

}  // namespace vericansim::cli

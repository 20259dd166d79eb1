// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See number_check.hpp.
#include "cli/number_check.hpp"

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

std::string refused(const std::string &value, const char *allowed) {
  return in_quotes(value) + " is not allowed; allowed: " + allowed;
}

constexpr std::string_view kDigits = "0123456789", kHexDigits = "0123456789abcdefABCDEF";

bool consists_of(std::string_view text, std::string_view letters) {
  return !text.empty() && text.find_first_not_of(letters) == std::string_view::npos;
}

std::string check_whole(const std::string &value) {
  std::string_view digits = value;
  if (digits.starts_with('-') || digits.starts_with('+')) digits.remove_prefix(1);
  const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  if (hexadecimal ? !consists_of(digits.substr(2), kHexDigits) : !consists_of(digits, kDigits))
    return refused(value, "whole numbers, decimal or hexadecimal as in 0x10");
  return has_leading_zeros(digits)
             ? refused(value, "decimal without zeros in front, or hexadecimal as in 0x10")
             : "";
}

std::string check_unsigned(const std::string &value) {
  return value.starts_with('-') ? refused(value, "0 and more") : check_whole(value);
}

// "inf" and "nan" are what strtod() reads beside numbers.
std::string check_finite(const std::string &value) {
  char *end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  const bool whole = end != value.c_str() && *end == '\0';
  return whole && std::isfinite(number) ? "" : refused(value, "a number, as in 12.5");
}

}  // namespace

bool has_leading_zeros(std::string_view number) {
  return number.size() > 1 && number[0] == '0' && consists_of(number, kDigits);
}

void check_numbers(CLI::App &app) {
  for (CLI::Option *option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("UINT")) option->check(check_unsigned);
    if (type.starts_with("INT")) option->check(check_whole);
    if (type.starts_with("FLOAT")) option->check(check_finite);
    if (option->get_items_expected_max() == 0) option->disable_flag_override();
  }
  for (CLI::App *command : app.get_subcommands({})) check_numbers(*command);
}

}  // namespace vericansim::cli

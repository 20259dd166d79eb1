// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See rate_option.hpp.
#include "cli/rate_option.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "cli/print_error.hpp"
#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

using Units = std::map<std::string, double>;

const Units kMultiples{{"k", 1e3}, {"M", 1e6}};
const Units kHertz{{"k", 1e3}, {"M", 1e6}, {"Hz", 1}, {"kHz", 1e3}, {"MHz", 1e6}, {"GHz", 1e9}};

/// Takes `ending` off `text`; false if it has another one.
bool take_off(std::string &text, std::string_view ending) {
  text = CLI::detail::trim_copy(text);
  if (!CLI::detail::to_lower(text).ends_with(ending)) return false;
  text.resize(text.size() - ending.size());
  return true;
}

/// CLI11 multiplies by units, but keeps six digits of what comes out.
bool multiply(std::string &text, const Units &units) {
  return CLI::AsNumberWithUnit{units}(text).empty();
}

/// Whether `text` is a number with one of the units, and is now one without.
bool to_number(std::string &text, const Units &units) {
  // CLI11 takes a unit alone for one of it.
  if (text.find_first_of("0123456789") == std::string::npos) return false;
  try {
    const std::size_t unit = text.find_last_of("0123456789.") + 1;
    std::string rounded = text, factor = "1" + text.substr(unit);
    if (!multiply(rounded, units) || !multiply(factor, units)) return false;
    const long double number = std::stold(text.substr(0, unit)) * std::stold(factor);
    const auto value = static_cast<double>(number);
    // One that is too large for any rate is cited as it is.
    text = std::isfinite(value) ? fmt::format("{}", value) : fmt::format("{:g}", number);
    return true;
  } catch (const CLI::ValidationError &) {
    return false;
  } catch (const std::out_of_range &) {
    return false;
  }
}

template <typename Convert>
CLI::Validator rate(const char *allowed, Convert convert) {
  const auto take = [allowed, convert](std::string &text) {
    std::string number = text;
    if (!convert(number)) return in_quotes(text) + " is not allowed; allowed: " + allowed;
    text = number;
    return std::string{};
  };
  return {take, "FLOAT [UNIT]"};
}

}  // namespace

CLI::Validator bitrate_units() {
  return rate("bit/s, as in 500000, 500k or '500 kbit/s'", [](std::string &text) {
    // Letters alone are units to CLI11. Hz is what --bitrate always knew in some commands.
    const bool bits = take_off(text, "bit/s");
    return to_number(text, bits ? kMultiples : kHertz);
  });
}

CLI::Validator clock_units() {
  return rate("Hz, as in 8000000, 8M or '8 MHz'",
              [](std::string &text) { return to_number(text, kHertz); });
}

CLI::Option *add_bitrate_option(CLI::App &command, const std::string &names, double &bitrate,
                                const std::string &help) {
  return command.add_option(names, bitrate, help)
      ->transform(bitrate_units())
      ->check(CLI::Range(1e3, 1e6));
}

void warn_of_bitrate(const Wave &wave, const std::string &path) {
  if (const std::string why = doubtful_bitrate(wave); !why.empty())
    print_error("verican: warning: {}: {}\n", path, why);
}

void warn_of_beginning(const Wave &wave, int sample_point, const std::string &path) {
  if (const std::string what = passed_over(wave, sample_point); !what.empty())
    print_error("verican: warning: {}: {}\n", path, what);
}

}  // namespace vericansim::cli

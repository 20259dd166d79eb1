// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Output that the subcommands share.
#include "cli/cli.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "cli/print_error.hpp"
#include "simulation/stop_request.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::cli {

Json to_json(const Frame &frame) {
  std::string data;
  for (unsigned i = 0; i < frame.payload_size(); ++i) data += fmt::format("{:02X}", frame.data[i]);
  return {{"id", frame.id},
          {"extended", frame.extended},
          {"remote", frame.remote},
          {"dlc", frame.dlc},
          {"data", data}};
}

std::string time_text(Time time) { return readable_time(time); }

Time time_option(const std::string &option, const std::string &text) {
  const auto time = parse_time(text);
  if (!time || *time <= 0)
    throw InputError(option, 0,
                     in_quotes(text) + " is not allowed; allowed: a time above 0, as in '50 ms'");
  return *time;
}

Time time_option(const std::string &option, const std::string &text, Time least, Time most) {
  const auto time = parse_time(text);
  if (!time || *time < least || *time > most)
    throw InputError(option, 0,
                     fmt::format("{} is not allowed; allowed: {} to {}, as in '50 ms'",
                                 in_quotes(text), exact_time(least), exact_time(most)));
  return *time;
}

void print_json(const Json &json) {
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

std::string at_least_one(const std::string &value) {
  return parse_integer(value).value_or(0) == 0
             ? in_quotes(value) + " is not allowed; allowed: 1 or more"
             : "";
}

int exit_code_after(int code) {
  constexpr int kSignal = 128;
  return stop_requested() ? kSignal + stop_signal() : code;
}

Progress::Progress(std::string title)
    : title_{std::move(title)}, terminal_{isatty(STDERR_FILENO) != 0} {}

Progress::~Progress() {
  if (shown_ >= 0) print_error("\r\033[K");
}

void Progress::show(double part) {
  if (!terminal_) return;
  const int percent = static_cast<int>(part * 100);
  if (percent == shown_) return;
  shown_ = percent;
  constexpr int kWidth = 40;
  const int full = percent * kWidth / 100;
  print_error("\r{} [{}{}] {:3d} %", title_, std::string(static_cast<std::size_t>(full), '#'),
              std::string(static_cast<std::size_t>(kWidth - full), ' '), percent);
  std::fflush(stderr);
}

}  // namespace vericansim::cli

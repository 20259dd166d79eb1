// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// python-can's formats: between us and the script go lines of a candump log.
#include "trace/python_log.hpp"

#include <fmt/format.h>

#include <sstream>

#include "trace/candump.hpp"
#include "trace/channel_numbers.hpp"
#include "trace/log_walk.hpp"
#include "trace/python_helper.hpp"

namespace vericansim {
namespace {

constexpr const char *kScript = "log_format.py";
constexpr const char *kNoChannel = "-";

/// What the script says in front of the frames, in lines that are comments for others: how much it
/// has passed over, and warnings.
void take_remarks(std::string_view lines, CanLog &log) {
  constexpr std::string_view kSkipped = "# skipped ", kWarning = "# warning ";
  for (; lines.starts_with("# "); lines.remove_prefix(lines.find('\n') + 1)) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    if (line.starts_with(kWarning)) log.warnings.emplace_back(line.substr(kWarning.size()));
    if (line.starts_with(kSkipped))
      log.skipped += text::parse_unsigned(line.substr(kSkipped.size()), 10).value_or(0);
  }
}

}  // namespace

CanLog parse_python_log(std::string_view bytes, LogFormat format, const std::string &path) {
  const std::string lines = run_python({kScript, {"read", traits_of(format).option}, bytes, path});
  CanLog log = parse_candump(lines, path + ": message");
  take_remarks(lines, log);
  const auto without_name = [](auto &entry) {
    if (entry.channel == kNoChannel) entry.channel.clear();
  };
  walk(log, without_name, without_name);
  return log;
}

std::string python_log_bytes(const CanLog &log, LogFormat format, const std::string &path) {
  const auto numbers = channel_numbers(log);
  std::ostringstream lines;
  CandumpWriter writer{lines, log.start_ns, true};
  const auto write = [&](auto entry) {
    entry.channel =
        entry.channel.empty() ? kNoChannel : fmt::format("can{}", numbers.at(entry.channel));
    writer.write(entry);
  };
  walk(log, write, write);
  return run_python({kScript, {"write", traits_of(format).option}, lines.str(), path});
}

}  // namespace vericansim

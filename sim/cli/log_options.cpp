// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Options for recordings: see log_options.hpp.
#include "cli/log_options.hpp"

#include <fmt/format.h>

#include "cli/cli.hpp"
#include "trace/input_error.hpp"
#include "trace/output_file.hpp"
#include "trace/quantity.hpp"

namespace vericansim::cli {
namespace {

std::optional<Time> moment(const std::string &option, const std::string &text) {
  if (text.empty()) return {};
  const auto time = parse_time(text);
  if (!time || *time < 0)
    throw InputError(option, 0,
                     in_quotes(text) +
                         " is not allowed; allowed: a time since the recording's first "
                         "frame, as in '1.5 s'");
  return time;
}

}  // namespace

void add_selection(CLI::App &command, LogSelection &selection) {
  command.add_option("--interface", selection.interface,
                     "Recording: only this interface, or all as one bus (must be told if there are "
                     "several)");
  command.add_option("--filter", selection.filters,
                     "Recording: only identifiers ID:MASK, or ID~MASK for all others, hexadecimal; "
                     "repeatable, one must match");
  command.add_option("--from", selection.from, "Recording: from this time after its first frame");
  command.add_option("--to", selection.to, "Recording: up to this time after its first frame");
}

std::string SelectedLog::note() const {
  return interfaces.size() > 1 ? "all interfaces as one bus: " + interfaces_text(interfaces) : "";
}

SelectedLog read_selected(const std::string &path, const LogSelection &selection, bool several) {
  LogFilter filter;
  filter.interface = selection.interface;
  for (const std::string &text : selection.filters) filter.ids.push_back(parse_filter(text));
  filter.from = moment("--from", selection.from);
  filter.to = moment("--to", selection.to);
  filter.several = several;
  SelectedLog result{filtered(read_log(path), filter, path), {}};
  result.interfaces = interfaces_of(result.log);
  return result;
}

void add_ids_options(CLI::App &command, IdsOutput &output) {
  command.add_flag("--ids", output.text,
                   "For each identifier: count, period, jitter, last data, changed bytes");
  command.add_option("--ids-csv", output.csv, "The same as a CSV file");
}

IdentifierTable identifiers_of(const CanLog &log) {
  IdentifierTable table;
  for (const LogEntry &entry : log.entries) table.add(entry.channel, entry.frame, entry.time);
  return table;
}

void write_ids_csv(const IdentifierTable &table, const IdsOutput &output) {
  if (output.csv.empty()) return;
  OutputFile file{output.csv};
  write_csv(table, file.stream());
  file.commit();
}

}  // namespace vericansim::cli

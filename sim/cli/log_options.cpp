// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Options for recordings: see log_options.hpp.
#include "cli/log_options.hpp"

#include <fmt/format.h>

#include <utility>

#include "cli/cli.hpp"
#include "cli/print_error.hpp"
#include "trace/input_error.hpp"
#include "trace/output_file.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

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

std::optional<StepBack> first_step_back(const CanLog &log) {
  for (std::size_t i = 1; i < log.entries.size(); ++i)
    if (const Time by = log.entries[i - 1].time - log.entries[i].time; by > 0)
      return StepBack{i + 1, by};
  return std::nullopt;
}

}  // namespace

nlohmann::ordered_json to_json(const std::optional<StepBack> &step) {
  if (!step) return nullptr;
  return {{"frame", step->frame}, {"by_ps", step->by}};
}

void add_selection(CLI::App &command, LogSelection &selection, bool several) {
  command.add_option("--interface", selection.interface,
                     several ? "Recording: only this interface"
                             : "Recording: only this interface, or all as one bus; to be told if "
                               "there are several");
  command
      .add_option("--filter", selection.filters,
                  "Recording: only identifiers ID:MASK, or ID~MASK for all others, hexadecimal; "
                  "repeatable, one must match")
      ->allow_extra_args(false);
  command.add_option("--from", selection.from, "Recording: from this time after its first frame");
  command.add_option("--to", selection.to, "Recording: up to this time after its first frame");
}

void check_senders(unsigned senders, unsigned nodes) {
  if (senders > nodes)
    throw InputError("--senders", 0,
                     fmt::format("{0} are more than the {1} nodes; allowed: 1 to {1}, or --nodes "
                                 "{0}",
                                 senders, nodes));
}

std::string SelectedLog::note() const {
  return interfaces.size() > 1 ? "all interfaces as one bus: " + interfaces_text(interfaces) : "";
}

std::string SelectedLog::why_empty() const {
  if (whole != 0)
    return fmt::format("none of its {} is chosen", text::counted(whole, "frame", "frames"));
  const std::string others = skipped_text(log);
  return "holds no classical CAN frame" + (others.empty() ? "" : ", only " + others);
}

CanLog read_and_warn(const std::string &path) {
  CanLog log = read_log(path);
  for (const std::string &text : log.warnings)
    print_error("verican: warning: {}: {}\n", path, text);
  if (const auto step = first_step_back(log))
    print_error("verican: warning: {}: frame {} is {} before frame {}\n", path, step->frame,
                readable_time(step->by), step->frame - 1);
  return log;
}

SelectedLog read_selected(const std::string &path, const LogSelection &selection, bool several) {
  LogFilter filter;
  filter.interface = selection.interface;
  for (const std::string &text : selection.filters) filter.ids.push_back(parse_filter(text));
  filter.from = moment("--from", selection.from);
  filter.to = moment("--to", selection.to);
  filter.several = several;
  CanLog read = read_and_warn(path);
  SelectedLog result;
  result.whole = read.entries.size();
  result.step_back = first_step_back(read);
  result.log = filtered(std::move(read), filter, path);
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

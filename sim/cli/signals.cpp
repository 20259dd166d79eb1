// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican signals: recorded frames as the messages and signals of databases.
#include <fmt/format.h>

#include <memory>

#include "cli/cli.hpp"
#include "cli/log_options.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "signals/signal_output.hpp"
#include "trace/candump.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/log_convert.hpp"
#include "trace/text.hpp"

namespace vericansim::cli {
namespace {

struct SignalsOptions {
  std::string log;
  std::vector<std::string> databases;
  std::string csv;
  bool table = false;
  bool json = false;
};

std::string line_of(const LogEntry &entry, std::int64_t start_ns, const DecodedFrame &decoded) {
  const std::int64_t us = (start_ns + entry.time / kNanosecond) / 1000;
  return fmt::format("({:010d}.{:06d}) {} {} :: {}", us / 1'000'000, us % 1'000'000,
                     entry.channel.empty() ? "can0" : entry.channel, candump_frame(entry.frame),
                     to_text(decoded, entry.frame));
}

Json json_of(const LogEntry &entry, const DecodedFrame &decoded) {
  Json json{
      {"time_ps", entry.time}, {"channel", entry.channel}, {"frame", cli::to_json(entry.frame)}};
  vericansim::add_signals(json, decoded);
  return json;
}

int signals(const SignalsOptions &options) {
  std::vector<NamedFile> inputs{{"the log", options.log}}, outputs;
  const auto database = with_files(nullptr, options.databases);
  add_databases(inputs, database);
  add_file(outputs, "--csv", options.csv);
  claim_files(inputs, outputs);
  const CanLog log = read_and_warn(options.log);
  const std::int64_t start_ns = written_start_ns(log);
  const bool lines = !options.json && !options.table && options.csv.empty();
  std::unique_ptr<SignalCsv> csv;
  if (!options.csv.empty()) csv = std::make_unique<SignalCsv>(options.csv, start_ns);
  SignalStatistics statistics{database};
  Json list = Json::array();
  for (const LogEntry &entry : log.entries) {
    const DecodedFrame decoded = decode(*database, entry.frame);
    statistics.add(decoded.message, decoded.values);
    if (csv) csv->write(entry, decoded);
    if (lines) fmt::print("{}\n", line_of(entry, start_ns, decoded));
    if (options.json) list.push_back(json_of(entry, decoded));
  }
  const SignalReport report = statistics.report();
  if (csv && report.known != 0) csv->finish();
  if (options.json) {
    Json json = to_json(report);
    json["entries"] = list;
    print_json(json);
  }
  if (options.table) fmt::print("{}", to_text(report));
  if (log.skipped != 0)
    print_error("verican: warning: {}: without {}\n", options.log, skipped_text(log));
  if (report.known != 0) return kOk;
  print_error("verican: {}: none of its {} is in the database\n", options.log,
              text::counted(log.entries.size(), "frame", "frames"));
  return kFailed;
}

}  // namespace

void add_signals(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<SignalsOptions>();
  CLI::App *command = app.add_subcommand(
      "signals", "Recorded frames as messages and signals of databases (docs/signals.md)");
  command->add_option("log", options->log, "Log of frames, as for replay")->required();
  add_database_option(*command, options->databases);
  command->get_option("--dbc")->required();
  command->add_option("--csv", options->csv, "Write the signals of all frames, CSV");
  CLI::Option *table = command->add_flag("--table", options->table,
                                         "Last, smallest, largest and mean value of each");
  command->add_flag("--json", options->json, "Frames and table as JSON")->excludes(table);
  command->callback([options, &exit_code] { exit_code = signals(*options); });
}

}  // namespace vericansim::cli

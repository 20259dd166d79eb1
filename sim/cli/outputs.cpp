// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of all subcommands that write what happens on a bus.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "cli/cli.hpp"
#include "trace/input_error.hpp"
#include "trace/output_file.hpp"

namespace vericansim::cli {

namespace {

/// Length of a path without its ending, of which ".gz" is a part: "a.b/bus.vcd.gz" gives 7.
std::size_t stem_length(const std::string &path) {
  std::filesystem::path stem = path;
  if (stem.extension() == ".gz") stem.replace_extension();
  return stem.replace_extension().string().size();
}

bool is_standard_input(const std::string &path) {
  return path == "-" || path == "/dev/stdin" || path == "/dev/fd/0" || path == "/proc/self/fd/0";
}

void check_standard_input(const CLI::App &command) {
  std::string reader;
  for (const char *name : {"scenario", "input", "log", "wave", "--bus", "--dbc"}) {
    const CLI::Option *option = command.get_option_no_throw(name);
    if (option == nullptr) continue;
    for (const std::string &path : option->results()) {
      if (!is_standard_input(path)) continue;
      if (!reader.empty())
        throw InputError(
            "standard input", 0,
            fmt::format("is the file of {} and of {}; allowed: of one of them", reader, name));
      reader = name;
    }
  }
}

}  // namespace

void add_output_options(CLI::App &command, Outputs &outputs, const std::string &report_names) {
  command.add_option("--vcd", outputs.vcd, "Write the waveform as VCD");
  command.add_option("--fst", outputs.fst, "Write the waveform as FST");
  command.add_option("--candump", outputs.candump, "Write the frames as a candump log");
  command.add_option("--pcap", outputs.pcap, "Write the frames as a capture for Wireshark");
  command.add_option(report_names, outputs.report,
                     "Write a page to look at, HTML (docs/report.md)");
  add_report_frames_option(command, outputs);
  add_database_option(command, outputs.dbc);
  command.add_flag("--signals", outputs.signals, "A table of the signals (docs/signals.md)");
  command.add_option("--signals-csv", outputs.signals_csv, "Write the signals of all frames, CSV");
  command.add_flag(
      "--ids", outputs.ids,
      "For each identifier on the bus: count, period, jitter, last data, changed bytes");
  command.add_option("--ids-csv", outputs.ids_csv, "The same as a CSV file");
}

void add_report_frames_option(CLI::App &command, Outputs &outputs) {
  command
      .add_option("--report-frames", outputs.report_frames,
                  "The page keeps bits and edges of so many frames (200000)")
      ->check(CLI::Range(1U, 10'000'000U))
      ->each([&outputs](const std::string &) { outputs.report_frames_given = true; });
}

void add_database_option(CLI::App &command, std::vector<std::string> &files) {
  command
      .add_option("--dbc", files, "Database of signals, DBC; may be given again (docs/signals.md)")
      ->allow_extra_args(false);
  command.parse_complete_callback([&command] { check_standard_input(command); });
}

void load_databases(Outputs &outputs, const std::vector<std::string> &files) {
  outputs.database = with_files(outputs.database, files);
  if (outputs.database) return;
  for (const auto &[wanted, option] :
       {std::pair{outputs.signals, "--signals"}, {!outputs.signals_csv.empty(), "--signals-csv"}})
    if (wanted)
      throw InputError(option, 0, "needs a database; allowed: --dbc FILE, dbc in the scenario");
}

void require_page(const Outputs &outputs) {
  if (outputs.report.empty() && outputs.report_frames_given)
    throw InputError(
        "--report-frames", 0,
        "no page is written; allowed: with --report-page, or outputs.report of the scenario");
}

void require_signals(const Outputs &outputs, const std::vector<std::string> &files, bool json) {
  if (files.empty() || json || outputs.signals || !outputs.signals_csv.empty() ||
      !outputs.report.empty())
    return;
  throw InputError("--dbc", 0,
                   "nothing shows its signals; allowed: with --signals, --signals-csv, --json or "
                   "--report-page, or outputs.report of the scenario");
}

void override_outputs(Outputs &target, const Outputs &given, bool json) {
  for (const auto path : kOutputPaths)
    if (!(given.*path).empty()) target.*path = given.*path;
  target.signals = given.signals;
  target.ids = given.ids;
  load_databases(target, given.dbc);
  target.report_frames_given = given.report_frames_given;
  if (given.report_frames_given) target.report_frames = given.report_frames;
  require_page(target);
  require_signals(target, given.dbc, json);
}

Outputs outputs_for(const Outputs &outputs, double bitrate) {
  Outputs result = outputs;
  for (const auto path : kOutputPaths) {
    std::string &name = result.*path;
    std::error_code error;
    const auto type = std::filesystem::status(name, error).type();
    const bool device = type == std::filesystem::file_type::character;
    if (name.empty() || device) continue;
    if (is_standard_output(name) || type == std::filesystem::file_type::fifo)
      throw InputError(name, 0,
                       "cannot take the outputs of several bit rates; allowed: a file's name, or "
                       "one bit rate");
    name.insert(stem_length(name), fmt::format("-{:g}k", bitrate / 1e3));
  }
  return result;
}

}  // namespace vericansim::cli

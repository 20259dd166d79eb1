// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican report: a page of a scenario, a recorded waveform or recorded traffic.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/cli.hpp"
#include "cli/console.hpp"
#include "cli/live_run.hpp"
#include "cli/log_options.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "cli/rate_option.hpp"
#include "cli/scenario_input.hpp"
#include "session/replay.hpp"
#include "simulation/stop_request.hpp"
#include "simulation/wave_report.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"

namespace vericansim::cli {
namespace {

struct ReportOptions {
  CLI::App *command = nullptr;
  std::string input;
  Outputs outputs;
  std::string signal;
  double bitrate = 0;
  ReplayOptions replay;
  LogSelection selection;
};

bool has_ending(const std::string &path, std::initializer_list<const char *> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char *ending) { return without_gz(path).ends_with(ending); });
}

const char *interrupted_text(bool interrupted) { return interrupted ? "; interrupted" : ""; }

constexpr std::initializer_list<const char *> kOfLogs = {
    "--nodes", "--senders", "--fast", "--interface", "--filter", "--from", "--to"};

/// Options that say nothing about an input of this kind.
void refuse_options(const ReportOptions &options, std::initializer_list<const char *> names,
                    const char *of) {
  for (const char *name : names)
    if (options.command->count(name) != 0)
      throw InputError(name, 0,
                       fmt::format("is an option of {}, and {} is none", of, options.input));
}

int report_scenario(const ReportOptions &options) {
  refuse_options(options, kOfLogs, "logs of frames");
  refuse_options(options, {"--signal"}, "waveforms");
  Scenario scenario = scenario_input(options.input);
  if (options.bitrate != 0) scenario.bitrates = {options.bitrate};
  const auto database = with_files(scenario.outputs.database, options.outputs.dbc);
  scenario.outputs.database = database;
  claim_files(inputs_of(scenario), files_of(options.outputs, scenario.bitrates));
  check_bitrates(scenario);
  const StopSignals signals;
  int code = kOk;
  for (const double bitrate : scenario.bitrates) {
    scenario.outputs =
        scenario.bitrates.size() > 1 ? outputs_for(options.outputs, bitrate) : options.outputs;
    scenario.outputs.database = database;
    const RunReport report = simulate(scenario, bitrate, true);
    code = std::max(code, exit_code_of(report));
    fmt::print("{}\n{}\n\n", to_text(report), scenario.outputs.report);
    flush_standard_output();
    complain(report.boards);
    if (stop_requested()) break;
  }
  return code;
}

/// No output is the input or a database.
void claim(const char *role, const ReportOptions &options) {
  std::vector<NamedFile> inputs{{role, options.input}};
  add_databases(inputs, options.outputs.database);
  claim_files(inputs, files_of(options.outputs));
}

int report_recorded_wave(const ReportOptions &options) {
  refuse_options(options, kOfLogs, "logs of frames");
  WaveDecodeOptions decode;
  decode.signal = options.signal;
  if (options.bitrate != 0) decode.bitrate = options.bitrate;
  claim("the waveform", options);
  const Wave wave = read_wave(options.input, decode);
  const StopSignals signals;
  WaveReport report;
  {
    Progress progress{"report"};
    report = report_wave(wave, options.input, options.outputs,
                         [&](double part) { progress.show(part); });
  }
  if (report.frames + report.unacknowledged == 0) warn_of_bitrate(wave, options.input);
  warn_of_beginning(wave, decode.sample_point, options.input);
  if (report.cut) fmt::print("{}\n", cut_text(*report.cut));
  fmt::print(
      "signal {}, {:.0f} bit/s: {} frames, {} without ACK, {} error frames, {} overload "
      "frames in {}{}\n{}\n",
      wave.signal, wave.bitrate, report.frames, report.unacknowledged, report.error_frames,
      report.overload_frames, time_text(wave.end - wave.begin()),
      interrupted_text(report.interrupted), options.outputs.report);
  if (report.frames + report.unacknowledged + report.error_frames + report.overload_frames != 0 ||
      report.cut || report.interrupted)
    return kOk;
  print_error("verican: {}: no frame is in it\n", options.input);
  return kFailed;
}

int report_log(const ReportOptions &options) {
  refuse_options(options, {"--signal"}, "waveforms");
  check_senders(options.replay.senders, options.replay.nodes);
  claim("the log", options);
  const SelectedLog selected = read_selected(options.input, options.selection, false);
  const StopSignals signals;
  ReplayOptions replay_options = options.replay;
  if (options.bitrate != 0) replay_options.bitrate = options.bitrate;
  replay_options.outputs = options.outputs;
  ReplayReport report;
  {
    Progress progress{"report"};
    report = replay(selected.log, replay_options, [&](double part) { progress.show(part); });
  }
  fmt::print("{}: {} frames at {:.0f} bit/s through {} nodes, {} error frames{}\n{}\n",
             options.input, report.on_bus, replay_options.bitrate, report.nodes.size(),
             report.error_frames, interrupted_text(report.interrupted), options.outputs.report);
  if (const std::string note = selected.note(); !note.empty()) fmt::print("{}\n", note);
  if (!report.failure.empty()) fmt::print("FAIL  {}\n", report.failure);
  for (const ReplayNode &node : report.nodes)
    if (!node.complete) fmt::print("FAIL  {}: {}\n", node.name, node.first_difference);
  return report.ok() ? kOk : kFailed;
}

int report(ReportOptions &options) {
  if (options.outputs.report.empty()) {
    if (options.input == "-")
      throw InputError(
          "--out", 0, "is missing, and standard input has no name; allowed: the page's name, or -");
    const std::size_t slash = options.input.rfind('/');
    const std::size_t dot = options.input.rfind('.');
    const bool ending = dot != std::string::npos && (slash == std::string::npos || dot > slash);
    options.outputs.report = options.input.substr(0, ending ? dot : std::string::npos) + ".html";
  }
  if (has_ending(options.input, {".yaml", ".yml"})) return report_scenario(options);
  load_databases(options.outputs, options.outputs.dbc);
  if (has_ending(options.input, {".vcd"})) return exit_code_after(report_recorded_wave(options));
  if (has_ending(options.input, {".fst"}))
    throw InputError(options.input, 0,
                     "FST cannot be read; allowed: a scenario (.yaml), a waveform (.vcd), a log of "
                     "frames");
  return exit_code_after(report_log(options));
}

}  // namespace

void add_report(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App *command = app.add_subcommand(
      "report", "A page to look at, of a scenario, a waveform or a log (docs/report.md)");
  options->command = command;
  command
      ->add_option("input", options->input,
                   "Scenario (.yaml), waveform (.vcd), or a recording of any known format")
      ->required();
  command->add_option("-o,--out", options->outputs.report, "HTML file (the input's name, .html)");
  command->add_option("--signal,-s", options->signal,
                      "Waveform: signal of the bus, or the end of its name (guessed)");
  add_bitrate_option(*command, "--bitrate,-b", options->bitrate,
                     "Bit rate, bit/s (the scenario's; of a waveform detected; of a log 500k)");
  command->add_option("--nodes,-n", options->replay.nodes, "Log: nodes that it is sent through (2)")
      ->check(CLI::Range(2U, 64U));
  command
      ->add_option("--senders", options->replay.senders,
                   "Log: nodes that share its identifiers (1)")
      ->check(CLI::Range(1U, 64U));
  command->add_flag("--fast", options->replay.fast,
                    "Log: as fast as the bus allows, instead of as recorded");
  add_selection(*command, options->selection);
  add_report_frames_option(*command, options->outputs);
  add_database_option(*command, options->outputs.dbc);
  command->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace vericansim::cli

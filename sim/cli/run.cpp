// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican run: simulates a scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/cli.hpp"
#include "cli/console.hpp"
#include "cli/live_run.hpp"
#include "cli/output_files.hpp"
#include "cli/rate_option.hpp"
#include "cli/scenario_input.hpp"
#include "simulation/stop_request.hpp"

namespace vericansim::cli {
namespace {

struct RunOptions {
  std::string scenario;
  Outputs outputs;
  std::string duration;
  double bitrate = 0;
  bool json = false;
};

void override_with(Scenario &scenario, const RunOptions &options) {
  override_outputs(scenario.outputs, options.outputs, options.json);
  if (options.bitrate != 0) scenario.bitrates = {options.bitrate};
  if (options.duration.empty()) return;
  const Time duration =
      time_option("--duration", options.duration, kShortestDuration, kLongestDuration);
  scenario.cut_short = scenario.endless || duration < scenario.duration;
  scenario.duration = duration;
  scenario.endless = false;
}

int run(const RunOptions &options) {
  Scenario scenario = scenario_input(options.scenario);
  override_with(scenario, options);
  const Outputs outputs = scenario.outputs;
  const bool several = scenario.bitrates.size() > 1;
  claim_files(inputs_of(scenario), files_of(outputs, scenario.bitrates));
  check_bitrates(scenario);
  const StopSignals signals;
  int code = kOk;
  Json list = Json::array();
  for (const double bitrate : scenario.bitrates) {
    scenario.outputs = several ? outputs_for(outputs, bitrate) : outputs;
    const RunReport report = simulate(scenario, bitrate, !options.json);
    code = std::max(code, exit_code_of(report));
    if (options.json)
      list.push_back(to_json(report));
    else
      fmt::print("{}\n", to_text(report));
    flush_standard_output();
    complain(report.boards);
    if (stop_requested()) break;
  }
  if (options.json) print_json({{"ok", code == kOk}, {"runs", list}});
  return code;
}

}  // namespace

void add_run(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App *command = app.add_subcommand("run", "Simulate a scenario file (docs/scenario.md)");
  command->add_option("scenario", options->scenario, "YAML file")->required();
  add_output_options(*command, options->outputs);
  command->add_option("--duration", options->duration,
                      "Simulated time instead of the scenario's, as in '50 ms'");
  add_bitrate_option(*command, "--bitrate", options->bitrate,
                     "Bit rate instead of the scenario's, bit/s");
  command->add_flag("--json", options->json, "The report as JSON");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican paper: the experiments of the papers that the core and its clocks follow.
#include <fmt/format.h>

#include <memory>

#include "cli/cli.hpp"
#include "cli/timesync_output.hpp"
#include "paper/paper.hpp"
#include "simulation/stop_request.hpp"
#include "timesync/p4_experiment.hpp"
#include "timesync/sync_way.hpp"

namespace vericansim::cli {
namespace {

struct PaperOptions {
  std::string folder = "paper-waves";
  std::string pages;
  bool fst = false;
  bool no_waves = false;
  bool json = false;
};

Json to_json(const PaperExperiment &experiment) {
  Json checks = Json::array();
  for (const PaperCheck &check : experiment.checks)
    checks.push_back({{"figure", check.figure},
                      {"reported", check.reported},
                      {"seen", check.seen},
                      {"ok", check.ok}});
  return {{"name", experiment.name},
          {"wave", experiment.files.wave},
          {"page", experiment.files.page},
          {"checks", checks}};
}

/// The synchronised clocks of the second paper, on RTL, in as many intervals as show its figures
/// (TM-123); `verican timesync --p4` has more of them.
P4Result synchronise() {
  SyncCase setting = p4_case();
  setting.intervals = 30;
  setting.seeds = 1;
  return run_p4(sync_way("skip"), setting);
}

std::string in_brackets(const std::string &file) { return file.empty() ? "" : "  (" + file + ")"; }

int run(const PaperOptions &options) {
  const StopSignals signals;
  const auto experiments = run_paper(
      {options.no_waves ? "" : options.folder, options.fst ? ".fst" : ".vcd", options.pages});
  bool ok = !stop_requested();
  Json list = Json::array();
  if (!options.json)
    fmt::print(
        "Son, Park, Kang: Design and Implementation of CAN IP using FPGA (2016)\n"
        "50 kbit/s, 10 quanta of 2 us: PROP 5, PS1 2, PS2 2, sample point 80 %\n");
  for (const PaperExperiment &experiment : experiments) {
    list.push_back(to_json(experiment));
    if (!options.json)
      fmt::print("\n{}{}{}\n", experiment.name, in_brackets(experiment.files.wave),
                 in_brackets(experiment.files.page));
    for (const PaperCheck &check : experiment.checks) {
      ok = ok && check.ok;
      if (!options.json)
        fmt::print("  {} fig. {}  {}\n                seen: {}\n", check.ok ? "ok  " : "FAIL",
                   check.figure, check.reported, check.seen);
    }
  }
  Json clocks;
  if (!stop_requested()) {
    const P4Result result = synchronise();
    clocks = cli::to_json(result);
    ok = ok && clocks["ok"].get<bool>();
    if (!options.json) {
      fmt::print("\n");
      print_p4(result);
    }
  }
  if (options.json)
    print_json({{"ok", ok},
                {"interrupted", stop_requested()},
                {"experiments", list},
                {"clock_synchronisation", clocks}});
  else
    fmt::print("\n{}\n", stop_requested() ? "Interrupted; these are not all experiments."
                         : ok             ? "All as the papers report."
                                          : "Not all is as the papers report.");
  return exit_code_after(ok ? kOk : kFailed);
}

}  // namespace

void add_paper(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<PaperOptions>();
  CLI::App *command =
      app.add_subcommand("paper", "Repeat the published experiments and compare with the papers");
  CLI::Option *out =
      command->add_option("--out", options->folder, "Folder for the waveforms (paper-waves)");
  command->add_option("--report,--report-page", options->pages,
                      "Folder for a page of each experiment, HTML (docs/report.md)");
  CLI::Option *fst = command->add_flag("--fst", options->fst, "FST instead of VCD");
  command->add_flag("--no-waves", options->no_waves, "Write no waveforms")
      ->excludes(out)
      ->excludes(fst);
  command->add_flag("--json", options->json, "Results as JSON");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican paper: the experiments of the paper that the core follows.
#include <fmt/format.h>

#include <memory>

#include "cli/cli.hpp"
#include "paper/paper.hpp"
#include "simulation/stop_request.hpp"

namespace vericansim::cli {
namespace {

struct Options {
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

std::string in_brackets(const std::string &file) { return file.empty() ? "" : "  (" + file + ")"; }

int run(const Options &options) {
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
  if (options.json)
    print_json({{"ok", ok}, {"interrupted", stop_requested()}, {"experiments", list}});
  else
    fmt::print("\n{}\n", stop_requested() ? "Interrupted; these are not all experiments."
                         : ok             ? "All as the paper reports."
                                          : "Not all is as the paper reports.");
  return exit_code_after(ok ? kOk : kFailed);
}

}  // namespace

void add_paper(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App *command =
      app.add_subcommand("paper", "Repeat the published experiments and compare with the paper");
  command->add_option("--out", options->folder, "Folder for the waveforms (paper-waves)");
  command->add_option("--report,--report-page", options->pages,
                      "Folder for a page of each experiment, HTML (docs/report.md)");
  command->add_flag("--fst", options->fst, "FST instead of VCD");
  command->add_flag("--no-waves", options->no_waves, "Write no waveforms");
  command->add_flag("--json", options->json, "Results as JSON");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican firmware: Cortex-M3 binaries on simulated buses.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "cli/cli.hpp"
#include "cli/console.hpp"
#include "cli/live_run.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "cli/rate_option.hpp"
#include "cli/scenario_input.hpp"
#include "session/firmware_run.hpp"
#include "simulation/stop_request.hpp"
#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

using firmware::BoardReport;
using firmware::FirmwareReport;
using firmware::FirmwareSetup;

struct FirmwareOptions {
  std::vector<std::string> files;
  std::string bus, second_bus;
  Outputs outputs;
  std::string limit;
  FirmwareSetup setup;
  bool run_hard_fault = false;
  bool report = false;
  bool json = false;
};

Json to_json(const FirmwareReport &report) {
  Json boards = Json::array(), buses = Json::array();
  for (const BoardReport &b : report.boards) boards.push_back(firmware::to_json(b));
  for (const RunReport &bus : report.buses) buses.push_back(vericansim::to_json(bus));
  return {{"ok", report.ok()}, {"boards", boards}, {"buses", buses}};
}

/// What did not end well, on stderr.
void complain_of(const FirmwareReport &report) {
  cli::complain(report.boards);
  for (const RunReport &bus : report.buses)
    for (const CheckResult &check : bus.checks)
      if (!check.ok)
        print_error("verican: {}: {}: {} (expected {})\n", bus.name, check.what, check.seen,
                    check.wanted);
}

/// The scenarios of the buses, each with one bit rate.
void read_buses(const FirmwareOptions &options, FirmwareSetup &setup) {
  setup.scenarios.push_back(scenario_input(options.bus));
  setup.bitrate = only_bitrate(setup.scenarios.front(), setup.bitrate);
  if (options.second_bus.empty()) return;
  const Scenario &second = setup.scenarios.emplace_back(scenario_input(options.second_bus));
  if (second.bitrates.size() > 1)
    throw InputError(second.file, 0, "has several bit rates; allowed for --second-bus: one");
}

FirmwareSetup make_setup(const FirmwareOptions &options) {
  FirmwareSetup setup = options.setup;
  for (const std::string &file : options.files) setup.images.push_back(firmware::read_elf(file));
  read_buses(options, setup);
  override_outputs(setup.scenarios.front().outputs, options.outputs, options.json);
  for (Scenario &scenario : setup.scenarios) scenario.outputs.ids = options.outputs.ids;
  if (!options.limit.empty()) setup.limit = time_option("--time", options.limit);
  setup.cpu.catch_hard_fault = !options.run_hard_fault;
  return setup;
}

void claim_files_of(const FirmwareOptions &options, const FirmwareSetup &setup) {
  std::vector<NamedFile> inputs, outputs;
  for (const std::string &file : options.files) inputs.push_back({"the firmware", file});
  for (const Scenario &scenario : setup.scenarios) {
    for (NamedFile &file : inputs_of(scenario)) inputs.push_back(std::move(file));
    for (NamedFile &file : files_of(scenario.outputs)) outputs.push_back(std::move(file));
  }
  claim_files(inputs, outputs);
}

/// The report, or only the tables that are wanted.
void print(const FirmwareOptions &options, const std::vector<RunReport> &buses) {
  for (const RunReport &bus : buses) {
    const std::string text = options.report ? to_text(bus) : tables_text(bus);
    if (text.empty()) continue;
    fmt::print("\n{}{}", options.report ? "" : bus.name + "\n", text);
  }
}

int run(const FirmwareOptions &options) {
  const FirmwareSetup setup = make_setup(options);
  claim_files_of(options, setup);
  const StopSignals signals;
  FirmwareReport report;
  {
    Console console{setup.images.size() == 1};
    Progress progress{"firmware"};
    report = run_firmware(
        setup,
        [&](std::size_t board, std::string_view text) {
          if (!options.json) console.print(firmware::firmware_node(board), text);
        },
        [&](double part) { progress.show(part); });
  }
  if (options.json)
    print_json(to_json(report));
  else
    print(options, report.buses);
  flush_standard_output();
  complain_of(report);
  return exit_code_after(exit_code_of(report.boards, report.ok() ? kOk : kFailed));
}

void add_bus_options(CLI::App &command, FirmwareOptions &options) {
  command.add_option("elf", options.files, "ELF file; with several each gets a board")->required();
  command
      .add_option("--bus", options.bus,
                  "Scenario file: bit rate, other nodes, traffic, faults, expectations")
      ->required();
  CLI::Option *second = command.add_flag("--second-core", options.setup.second_core,
                                         "The board has two cores, both on this bus");
  command
      .add_option("--second-bus", options.second_bus,
                  "The board has two cores; scenario file of the second one's bus")
      ->excludes(second);
  add_bitrate_option(command, "--bitrate", options.setup.bitrate,
                     "Bit rate instead of the scenario's, bit/s");
}

void add_result_options(CLI::App &command, FirmwareOptions &options) {
  // --report prints.
  cli::add_output_options(command, options.outputs, "--report-page");
  command.add_flag("--report", options.report, "Print what the buses saw, as 'verican run' does");
  command.add_flag("--json", options.json, "Everything as JSON, the firmware's output included");
}

}  // namespace

void add_firmware(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<FirmwareOptions>();
  CLI::App *command = app.add_subcommand(
      "firmware", "Run Cortex-M3 firmware on a simulated board (docs/firmware.md)");
  add_bus_options(*command, *options);
  add_result_options(*command, *options);
  command->add_option("--time", options->limit,
                      "Longest simulated time, as in '50 ms' (the scenario's duration and drain)");
  command->add_flag("--endless", options->setup.endless,
                    "The firmware does not end by itself: reaching the limit is success");
  command
      ->add_option("--clocks-per-instruction", options->setup.cpu.clocks_per_instruction,
                   "Speed of the CPU (2)")
      ->check(CLI::Range(1U, 100U));
  command->add_flag("--run-hard-fault-handler", options->run_hard_fault,
                    "Enter the firmware's HardFault handler instead of stopping");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli

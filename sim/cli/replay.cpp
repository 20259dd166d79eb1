// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican replay: recorded traffic to a bus of simulated nodes.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/cli.hpp"
#include "cli/console.hpp"
#include "cli/live_run.hpp"
#include "cli/log_options.hpp"
#include "cli/output_files.hpp"
#include "cli/rate_option.hpp"
#include "cli/scenario_input.hpp"
#include "session/replay.hpp"
#include "simulation/stop_request.hpp"

namespace vericansim::cli {
namespace {

struct ReplayCommand {
  std::string log, bus;
  double bitrate = 0;
  ReplayOptions replay;
  LogSelection selection;
  bool json = false;
};

Json to_json(const ReplayReport &report) {
  Json nodes = Json::array();
  for (const ReplayNode &node : report.nodes)
    nodes.push_back({{"name", node.name},
                     {"to_send", node.to_send},
                     {"sent", node.sent},
                     {"expected", node.expected},
                     {"received", node.received},
                     {"complete", node.complete},
                     {"errors", node.counts.errors},
                     {"lost_arbitration", node.counts.lost_arbitration},
                     {"first_difference", node.first_difference}});
  return {{"frames", report.frames},
          {"on_bus", report.on_bus},
          {"error_frames", report.error_frames},
          {"skipped", report.skipped},
          {"duration_ps", report.duration},
          {"load", report.load},
          {"wall_seconds", report.wall_seconds},
          {"node_cycles", report.node_cycles},
          {"nodes", nodes},
          {"interrupted", report.interrupted},
          {"failure", report.failure},
          {"bus", vericansim::to_json(report.run)},
          {"ok", report.ok()}};
}

void print(const ReplayCommand &options, const ReplayReport &report) {
  fmt::print("{}: {} frames{} at {:.0f} bit/s through {} nodes\n", options.log, report.frames,
             report.skipped != 0
                 ? fmt::format(" ({} entries are no classical frames)", report.skipped)
                 : "",
             options.replay.bitrate, report.nodes.size());
  fmt::print(
      "  recorded {}, simulated {}, load {:.1f} %, {} frames and {} error frames on the bus\n",
      time_text(report.recorded), time_text(report.duration), report.load * 100, report.on_bus,
      report.error_frames);
  fmt::print("  {:<8} {:>8} {:>8} {:>9} {:>9} {:>9} {:>8}  {}\n", "node", "to send", "sent",
             "to come", "received", "arb lost", "errors", "every frame, bit-exact and in order");
  for (const ReplayNode &n : report.nodes)
    fmt::print("  {:<8} {:>8} {:>8} {:>9} {:>9} {:>9} {:>8}  {}\n", n.name, n.to_send, n.sent,
               n.expected, n.received, n.counts.lost_arbitration, n.counts.errors,
               n.complete ? "yes" : "NO: " + n.first_difference);
  if (report.longest_gap >= kLongGap)
    fmt::print("  a gap of {} was passed over\n", long_time(report.longest_gap));
  if (!report.failure.empty()) fmt::print("  FAIL  {}\n", report.failure);
  if (report.interrupted)
    fmt::print("  interrupted; what had not come by then is not counted as missing\n");
  fmt::print("  {:.1f} million node-cycles in {:.2f} s: {:.1f} million a second\n",
             static_cast<double>(report.node_cycles) / 1e6, report.wall_seconds,
             static_cast<double>(report.node_cycles) / 1e6 / std::max(report.wall_seconds, 1e-9));
}

/// Prints what both forms of the command say of the recording itself.
int finish(const ReplayCommand &options, const SelectedLog &selected, Json json, int code) {
  if (options.json) {
    json["interfaces"] = selected.interfaces;
    json["step_back"] = to_json(selected.step_back);
    json["identifiers"] = vericansim::to_json(identifiers_of(selected.log));
    print_json(json);
  } else if (const std::string note = selected.note(); !note.empty()) {
    fmt::print("  {}\n", note);
  }
  return code;
}

/// Through plain nodes, which do nothing else.
int replay_alone(ReplayCommand &options) {
  if (options.bitrate != 0) options.replay.bitrate = options.bitrate;
  check_senders(options.replay.senders, options.replay.nodes);
  load_databases(options.replay.outputs, options.replay.outputs.dbc);
  require_page(options.replay.outputs);
  require_signals(options.replay.outputs, options.replay.outputs.dbc, options.json);
  std::vector<NamedFile> inputs{{"the log", options.log}};
  add_databases(inputs, options.replay.outputs.database);
  claim_files(inputs, files_of(options.replay.outputs));
  const SelectedLog selected = read_selected(options.log, options.selection, false);
  const StopSignals signals;
  ReplayReport report;
  {
    Progress progress{"replay"};
    report = replay(selected.log, options.replay, [&](double part) { progress.show(part); });
  }
  if (!options.json) print(options, report);
  const int code = finish(options, selected, options.json ? to_json(report) : Json{},
                          exit_code_after(report.ok() ? kOk : kFailed));
  const std::string tables = options.json ? "" : tables_text(report.run);
  if (!tables.empty()) fmt::print("\n{}", tables);
  return code;
}

/// Among the nodes of a scenario.
int replay_on_bus(const ReplayCommand &options) {
  Scenario bus = scenario_input(options.bus);
  const double bitrate = only_bitrate(bus, options.bitrate);
  override_outputs(bus.outputs, options.replay.outputs, options.json);
  std::vector<NamedFile> inputs = inputs_of(bus);
  add_file(inputs, "the log", options.log);
  claim_files(inputs, files_of(bus.outputs));
  const SelectedLog selected = read_selected(options.log, options.selection, false);
  const StopSignals signals;
  const RunReport report =
      simulate(replay_scenario(bus, selected.log, options.replay), bitrate, !options.json);
  if (!options.json) fmt::print("{}", to_text(report));
  const int code = exit_code_of(report);
  finish(options, selected, {{"bus", vericansim::to_json(report)}, {"ok", code == kOk}}, code);
  flush_standard_output();
  complain(report.boards);
  return code;
}

int run(ReplayCommand &options) {
  options.replay.file = std::filesystem::path(options.log).filename().string();
  return options.bus.empty() ? replay_alone(options) : replay_on_bus(options);
}

}  // namespace

void add_replay(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<ReplayCommand>();
  ReplayOptions &replay = options->replay;
  CLI::App *command = app.add_subcommand(
      "replay", "Recorded traffic through simulated nodes; each must receive every frame");
  command->add_option("log", options->log, "Recording of any known format; - is standard input")
      ->required();
  CLI::Option *bus = command->add_option(
      "--bus", options->bus,
      "Scenario file: other nodes, traffic, faults, expectations; its duration does not count");
  command->add_option("--nodes,-n", replay.nodes, "Nodes on the bus (2)")
      ->check(CLI::Range(2U, 64U))
      ->excludes(bus);
  command
      ->add_option("--senders", replay.senders, "Nodes that share the identifiers of the log (1)")
      ->check(CLI::Range(1U, 64U));
  add_bitrate_option(*command, "--bitrate,-b", options->bitrate,
                     "Bit rate, bit/s (500k, or the scenario's)");
  command
      ->add_option("--clock,-c", replay.clock_hz,
                   "Clock of each node, of a scenario those that it lacks, Hz (8M)")
      ->transform(clock_units())
      ->check(CLI::Range(1e5, 1e9));
  command->add_option("--ppm", replay.ppm, "Clocks are spread over +- this error (100)")
      ->check(CLI::Range(0.0, 5e3))
      ->excludes(bus);
  command->add_option("--cable", replay.cable_m, "Length of the bus, m (0)")
      ->check(CLI::Range(0.0, 1e4))
      ->excludes(bus);
  command->add_option("--mailboxes", replay.num_mb, "Message buffers of each node (64)")
      ->check(CLI::IsMember({16U, 32U, 64U}))
      ->excludes(bus);
  command->add_option("--frames", replay.limit, "Take only so many frames from the log (all)")
      ->check(at_least_one);
  command->add_flag("--fast", replay.fast, "As fast as the bus allows, instead of as recorded");
  add_selection(*command, options->selection);
  add_output_options(*command, replay.outputs);
  command->add_flag("--json", options->json, "The report as JSON");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli

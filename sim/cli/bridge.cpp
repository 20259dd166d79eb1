// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican bridge: CAN interfaces of the host as nodes of the simulated bus.
#include "bridge/bridge.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "bridge/raw_port.hpp"
#include "cli/bridge_socketcand.hpp"
#include "cli/cli.hpp"
#include "cli/live_run.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "cli/rate_option.hpp"
#include "cli/scenario_input.hpp"
#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

struct BridgeOptions {
  std::vector<std::string> interfaces;
  std::string monitor;
  std::string bus;
  double bitrate = 0;
  double clock = 0;
  unsigned nodes = 1;
  Outputs outputs;
  std::vector<std::string> filters;
  std::string errors = "own";
  unsigned restart_ms = 100;
  RawPortOptions raw;
  SocketcandOptions socketcand;
  std::string time;
  bool fast = false;
  bool end_when_down = false;
  bool json = false;
};

// The smallest clock that a bit of eight quanta allows: the fewer clocks, the faster the
// simulation.
constexpr double kClocksPerBit = 8;

/// On a terminal a line of its own for what is said, in place of the one that tells how far it is.
void say(const std::string &line) {
  print_error("{}verican bridge: {}\n", ::isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "", line);
  std::fflush(stderr);
}

/// Twice a second, and only on a terminal: simulated time, and the lag as it is now.
class StatusLine {
 public:
  StatusLine() : terminal_{::isatty(STDERR_FILENO) != 0 && !is_quiet()} {}
  ~StatusLine() {
    if (terminal_) print_error("\r\033[K");
  }
  StatusLine(const StatusLine &) = delete;
  StatusLine &operator=(const StatusLine &) = delete;

  void show(Bridge &bridge, const BridgeOptions &options) {
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || now < next_) return;
    next_ = now + std::chrono::milliseconds{500};
    print_error("\r\033[K{:.1f} s", static_cast<double>(bridge.elapsed()) / kSecond);
    if (!options.fast)
      print_error(", lag {:.1f} ms", static_cast<double>(bridge.pacer().lag()) / 1e6);
    std::fflush(stderr);
  }

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point next_{};
};

/// Names of all interfaces, the monitor's too, and buses.
std::vector<std::string> port_names(const BridgeOptions &options) {
  std::vector<std::string> names = options.interfaces;
  if (!options.monitor.empty()) names.push_back(options.monitor);
  for (const std::string &bus : bus_names(options.socketcand)) names.push_back(bus);
  return names;
}

/// A bus of plain nodes that receive, and so acknowledge. They leave the names of ports out, for a
/// node of that name would be the port's and not another one.
Scenario plain_bus(const BridgeOptions &options, double clock) {
  Scenario scenario;
  scenario.file = "--nodes";
  scenario.name = "bridge";
  const std::vector<std::string> taken = port_names(options);
  for (unsigned i = 0; scenario.nodes.size() < options.nodes; ++i) {
    NodeSpec node;
    node.name = fmt::format("node{}", i);
    if (std::find(taken.begin(), taken.end(), node.name) != taken.end()) continue;
    node.clock.frequency_hz = clock;
    scenario.nodes.push_back(node);
  }
  return scenario;
}

/// Fills in scenario, bit rate and clock.
void set_up_bus(BridgeSetup &setup, const BridgeOptions &options) {
  if (options.bus.empty()) {
    setup.bitrate = options.bitrate != 0 ? options.bitrate : 500e3;
    setup.port_clock_hz = options.clock != 0 ? options.clock : kClocksPerBit * setup.bitrate;
    setup.scenario = plain_bus(options, setup.port_clock_hz);
  } else {
    setup.scenario = scenario_input(options.bus);
    setup.bitrate = only_bitrate(setup.scenario, options.bitrate);
    setup.port_clock_hz = options.clock;
    if (options.clock == 0)
      setup.port_clock_hz = setup.scenario.nodes.empty()
                                ? kClocksPerBit * setup.bitrate
                                : setup.scenario.nodes.front().clock.frequency_hz;
  }
  override_outputs(setup.scenario.outputs, options.outputs, options.json);
}

/// Throws InputError for options that could not do anything.
void check_options(const BridgeOptions &options) {
  if (options.interfaces.empty() && options.socketcand.address.empty())
    throw InputError("--if", 0,
                     "nothing to bridge; name a CAN interface, as in '--if vcan0', or offer a bus "
                     "by TCP, as in '--socketcand 29536'");
  if (options.end_when_down && options.interfaces.empty() && options.monitor.empty())
    throw InputError("--end-when-down", 0, "needs an interface; allowed: with --if or --monitor");
}

void open_ports(BridgeSetup &setup, const BridgeOptions &options) {
  const std::vector<std::string> names = port_names(options);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      throw InputError(options.socketcand.address.empty() ? "--if" : "--bus-name", 0,
                       vericansim::in_quotes(names[i]) + " is named twice");
  for (const std::string &name : options.interfaces)
    setup.ports.push_back(std::make_unique<RawCanPort>(name, options.raw));
  if (options.monitor.empty()) return;
  RawPortOptions monitor;
  monitor.receives = false;
  monitor.option = "--monitor";
  setup.monitor = std::make_unique<RawCanPort>(options.monitor, monitor);
}

BridgeSetup make_setup(const BridgeOptions &options) {
  check_options(options);
  BridgeSetup setup;
  for (const std::string &filter : options.filters)
    setup.options.filters.push_back(parse_filter(filter));
  setup.options.errors = options.errors == "none"    ? ErrorChoice::kNone
                         : options.errors == "state" ? ErrorChoice::kState
                                                     : ErrorChoice::kOwn;
  setup.options.restart = static_cast<Time>(options.restart_ms) * kMillisecond;
  setup.fast = options.fast;
  if (!options.time.empty()) setup.limit = time_option("--time", options.time);
  setup.end_when_down = options.end_when_down;
  if (!is_quiet()) setup.say = say;
  set_up_bus(setup, options);
  open_ports(setup, options);
  return setup;
}

void print(const BridgeOptions &options, const BridgeReport &report,
           const SocketcandServer *server) {
  if (options.json) {
    Json json = to_json(report);
    if (server != nullptr) json["socketcand"] = to_json(server->counts());
    print_json(json);
  } else {
    fmt::print("{}{}{}", to_text(report), server != nullptr ? to_text(server->counts()) : "",
               options.bus.empty() ? "" : "\n" + to_text(report.bus));
    const std::string tables = options.bus.empty() ? tables_text(report.bus) : "";
    if (!tables.empty()) fmt::print("\n{}", tables);
  }
  flush_standard_output();
}

int run(const BridgeOptions &options) {
  // Host time in which clients may take the last messages.
  constexpr std::chrono::seconds kLastMessages{10};
  BridgeSetup setup = make_setup(options);
  claim_files(inputs_of(setup.scenario), files_of(setup.scenario.outputs));
  const auto server = open_socketcand(options.socketcand, setup);
  HostWall wall;
  BridgeReport report;
  {
    Bridge bridge{std::move(setup), wall};
    if (server) {
      say(server->description());
      server->wait_for_clients(options.socketcand.wait_for_clients, wall, say);
    }
    bridge.start();
    say("ready: " + bridge.description());
    StatusLine status;
    while (!wall.stop_requested() && bridge.round()) status.show(bridge, options);
    report = bridge.finish();
  }
  if (server) server->finish(kLastMessages);
  print(options, report, server.get());
  return report.ok() && (!server || server->counts().ok()) ? kOk : kFailed;
}

void add_bus_options(CLI::App &command, BridgeOptions &options) {
  CLI::Option *nodes =
      command
          .add_option("--nodes", options.nodes,
                      "Plain nodes on the bus, which receive and so acknowledge (1)")
          ->check(CLI::Range(0, 60));
  command
      .add_option("--bus", options.bus,
                  "Scenario file instead: nodes, traffic, faults; its duration does not count")
      ->excludes(nodes);
  add_bitrate_option(command, "--bitrate", options.bitrate,
                     "Bit rate (500k, or the scenario's), bit/s");
  command
      .add_option("--clock", options.clock,
                  "Clock of the nodes, Hz (8 clocks a bit, or that of the scenario's first node)")
      ->transform(clock_units())
      ->check(CLI::Range(8e3, 1e9));
}

void add_port_options(CLI::App &command, BridgeOptions &options) {
  CLI::Option *interface =
      command
          .add_option("--if", options.interfaces, "CAN interface that is a node; may be repeated")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--monitor", options.monitor,
                     "CAN interface that gets everything that is on the bus, in bus order");
  command
      .add_flag("--echo", options.raw.echo,
                "Give programs their own frames when these have really been sent")
      ->needs(interface);
  command
      .add_option("--filter", options.filters,
                  "Frames of the bus for the programs, ID:MASK or ID~MASK; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--errors", options.errors,
                  "Error messages: none, state (changes of state), own (and each error) (own)")
      ->check(CLI::IsMember({"none", "state", "own"}));
  command.add_option("--restart-ms", options.restart_ms,
                     "Simulated ms from bus-off to the begin of recovery; 0: only SIGUSR1 or "
                     "down and up again begin it (100)");
  command
      .add_option("--queue", options.raw.queue,
                  "Frames of programs that may wait for the bus, each interface (100000)")
      ->check(CLI::Range(1, 100'000'000))
      ->needs(interface);
  command.add_flag("--end-when-down", options.end_when_down,
                   "End when an interface goes down, instead of waiting for it");
}

void add_run_options(CLI::App &command, BridgeOptions &options) {
  command.add_flag("--fast", options.fast,
                   "As fast as possible; without it simulated time is held to real time");
  command.add_option("--time", options.time, "Simulated time to run, as in '10 s' (no end)");
  add_output_options(command, options.outputs);
  command.add_flag("--json", options.json, "The report as JSON");
}

}  // namespace

void add_bridge(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<BridgeOptions>();
  CLI::App *command = app.add_subcommand(
      "bridge", "CAN interfaces of this computer as nodes of a simulated bus (docs/bridge.md)");
  add_bus_options(*command, *options);
  add_port_options(*command, *options);
  add_socketcand_options(*command, options->socketcand);
  add_run_options(*command, *options);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Firmware on simulated buses: see firmware_run.hpp.
#include "session/firmware_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "session/session.hpp"
#include "trace/input_error.hpp"

namespace vericansim::firmware {
namespace {

FirmwareRole role_of(const FirmwareSetup &setup, const ElfImage &image) {
  FirmwareRole role;
  role.file = image.file;
  role.image = std::make_shared<const ElfImage>(image);
  role.clocks_per_instruction = setup.cpu.clocks_per_instruction;
  role.run_hard_fault_handler = !setup.cpu.catch_hard_fault;
  role.endless = setup.endless;
  return role;
}

/// Gives the node `name` to firmware.
NodeSpec &place(Scenario &scenario, const std::string &name, NodeRole role) {
  NodeSpec &node = scenario.nodes[take_core(scenario, name, "runs firmware")];
  node.role = std::move(role);
  return node;
}

// One core for each board, and perhaps a second one for the only board, with the same clock.
std::vector<Scenario> place_cores(const FirmwareSetup &setup) {
  std::vector<Scenario> scenarios = setup.scenarios;
  const bool second = setup.second_core || scenarios.size() > 1;
  if (second && setup.images.size() != 1)
    throw std::invalid_argument("a second core needs exactly one firmware file");
  for (std::size_t i = 0; i < setup.images.size(); ++i)
    place(scenarios.front(), firmware_node(i), role_of(setup, setup.images[i]));
  if (!second) return scenarios;
  NodeSpec &other = place(scenarios.back(), firmware_node(1), SecondCoreRole{firmware_node(0)});
  const Scenario &first = scenarios.front();
  for (const NodeSpec &node : first.nodes)
    if (node.name == firmware_node(0)) other.clock = node.clock;
  return scenarios;
}

}  // namespace

bool FirmwareReport::ok() const {
  return std::all_of(buses.begin(), buses.end(), [](const RunReport &bus) { return bus.ok(); });
}

std::string firmware_node(std::size_t index) {
  return index == 0 ? "firmware" : fmt::format("firmware{}", index + 1);
}

FirmwareReport run_firmware(const FirmwareSetup &setup,
                            const std::function<void(std::size_t, std::string_view)> &output,
                            const std::function<void(double)> &progress) {
  std::vector<SessionBus> buses;
  for (Scenario &scenario : place_cores(setup)) buses.push_back({std::move(scenario)});
  Scenario &first = buses.front().scenario;
  buses.front().bitrate = setup.bitrate;
  first.until_done = true;
  SessionOptions options;
  options.limit = setup.limit != 0 ? setup.limit : first.duration + first.drain;
  options.progress = progress;
  if (output)
    options.output = [&](std::string_view node, std::string_view text) {
      for (std::size_t i = 0; i < setup.images.size(); ++i)
        if (firmware_node(i) == node) output(i, text);
    };
  Session session{std::move(buses), std::move(options)};
  FirmwareReport report;
  report.buses = session.run();
  report.boards = report.buses.front().boards;
  return report;
}

}  // namespace vericansim::firmware

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: kinds of nodes, and the end, back to text.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "scenario/scenario_text.hpp"
#include "trace/quantity.hpp"

namespace vericansim::detail {
namespace {

[[noreturn]] void impossible(const std::string &who, const std::string &why) {
  throw std::invalid_argument(fmt::format("{} cannot be written as text: {}", who, why));
}

/// The text may be read from any folder.
std::string file_text(const std::string &path) {
  return yaml_text(std::filesystem::absolute(path).lexically_normal().string());
}

std::string flag_text(const char *key, bool value) {
  return value ? fmt::format(", {}: true", key) : "";
}

std::string filter_text(const std::vector<IdFilter> &filters) {
  std::string text;
  for (const IdFilter &filter : filters) text += (text.empty() ? "" : ", ") + to_text(filter);
  return text.empty() ? "" : ", filter: [" + text + "]";
}

std::string programs_text(const ProgramSettings &programs) {
  const ProgramSettings usual;
  std::string text = filter_text(programs.filters);
  if (programs.errors != usual.errors) text += ", errors: " + programs.errors;
  if (programs.restart != usual.restart) text += ", restart: " + exact_time(programs.restart);
  return text;
}

/// Writes each kind; `name` is that of its node, or listener.
struct RoleWriter {
  const std::string &name;

  [[noreturn]] void refuse(const std::string &why) const {
    impossible(fmt::format("node '{}'", name), why);
  }

  std::string operator()(const TrafficRole & /*role*/) const { return ""; }

  std::string operator()(const FirmwareRole &role) const {
    if (!role.endless) refuse("its firmware must end, which is an option of 'verican firmware'");
    std::string text = ", firmware: " + file_text(role.file);
    if (role.clocks_per_instruction != FirmwareRole{}.clocks_per_instruction)
      text += fmt::format(", clocks_per_instruction: {}", role.clocks_per_instruction);
    return text + flag_text("run_hard_fault_handler", role.run_hard_fault_handler);
  }

  std::string operator()(const SecondCoreRole &role) const {
    return ", second_core_of: " + yaml_text(role.board);
  }

  std::string operator()(const ReplayRole &role) const {
    if (role.log) refuse("its recording is in memory, not in a file");
    const ReplayRole usual;
    std::string text = ", replay: " + file_text(role.file);
    if (!role.channel.empty()) text += ", channel: " + yaml_text(role.channel);
    if (role.start != usual.start) text += ", start: " + exact_time(role.start);
    if (role.from != usual.from) text += ", from: " + exact_time(role.from);
    if (role.to != usual.to) text += ", to: " + exact_time(role.to);
    if (role.saturated) text += ", rate: saturated";
    if (!role.saturated && role.rate != usual.rate) text += fmt::format(", rate: {}", role.rate);
    text += flag_text("loop", role.loop) + filter_text(role.filters);
    if (role.frames != 0) text += fmt::format(", frames: {}", role.frames);
    if (role.shares != 1) text += fmt::format(", share: {}/{}", role.share + 1, role.shares);
    return text;
  }

  std::string operator()(const InterfaceRole &role) const {
    std::string text = ", interface: " + yaml_text(role.interface) + programs_text(role.programs) +
                       flag_text("echo", role.echo);
    if (role.queue != InterfaceRole{}.queue) text += fmt::format(", queue: {}", role.queue);
    return text + flag_text("end_when_down", role.end_when_down);
  }

  std::string operator()(const MonitorRole &role) const {
    return ", monitor: " + yaml_text(role.interface);
  }

  std::string operator()(const SocketcandRole &role) const {
    std::string text = ", socketcand: " + yaml_text(role.address) + programs_text(role.programs);
    if (role.wait_for_clients != 0)
      text += fmt::format(", wait_for_clients: {}", role.wait_for_clients);
    return text;
  }

  std::string operator()(const RemoteRole &role) const { return remote_text(role); }

  std::string operator()(const OwnRole & /*role*/) const { refuse("a program works it by itself"); }
};

}  // namespace

std::string yaml_text(const std::string &text) {
  const bool plain =
      !text.empty() && text != "null" && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '.';
      });
  if (plain) return text;
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

std::string role_text(const NodeSpec &node) { return std::visit(RoleWriter{node.name}, node.role); }

std::string listener_text(const ListenerSpec &listener) {
  return "  - {name: " + yaml_text(listener.name) +
         std::visit(RoleWriter{listener.name}, listener.role) + "}\n";
}

bool any_programs(const Scenario &scenario) {
  return !scenario.listeners.empty() ||
         std::any_of(scenario.nodes.begin(), scenario.nodes.end(),
                     [](const NodeSpec &node) { return has_programs(node.role); });
}

bool any_finite_replay(const Scenario &scenario) {
  return std::any_of(scenario.nodes.begin(), scenario.nodes.end(), [](const NodeSpec &node) {
    const auto *replay = std::get_if<ReplayRole>(&node.role);
    return replay != nullptr && !replay->loop;
  });
}

std::string end_text(const Scenario &scenario) {
  const bool programs = any_programs(scenario), finite = any_finite_replay(scenario);
  if (scenario.endless && !programs && !(finite && scenario.until_done))
    impossible(scenario.name, "a run without end needs programs or a recording as nodes");
  std::string text;
  if (!scenario.endless) text += "duration: " + exact_time(scenario.duration) + "\n";
  const Pacing usual = programs ? Pacing::kRealTime : Pacing::kFast;
  if (scenario.pacing != usual)
    text += scenario.pacing == Pacing::kFast ? "pacing: fast\n" : "pacing: real_time\n";
  const bool done = scenario.endless && finite && !programs;
  if (scenario.until_done != done) text += "end: done\n";
  return text;
}

}  // namespace vericansim::detail

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: remote nodes, commands of their hosts and their user logic back to text.
#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>

#include "scenario/scenario_text.hpp"
#include "trace/quantity.hpp"

namespace vericansim::detail {
namespace {

/// The profile with all the parts of `config`, and no others.
std::string profile_of(const RemoteConfig &config) {
  for (const char *name : {"small", "standard", "full"}) {
    RemoteConfig profile = RemoteConfig::profile(name);
    profile.name_bits = config.name_bits;
    profile.mem_bytes = config.mem_bytes;
    profile.stage_bytes = config.stage_bytes;
    profile.serial = config.serial;
    profile.same_id = config.same_id;
    if (profile == config) return name;
  }
  throw std::invalid_argument("a remote node that is of no profile cannot be written as text");
}

/// "{0x040: 01 A5}".
template <class Bytes>
std::string places_text(const std::map<unsigned, Bytes> &places) {
  std::string text;
  for (const auto &[address, bytes] : places) {
    text += fmt::format("{}0x{:03X}:", text.empty() ? "" : ", ", address);
    for (const unsigned byte : bytes) text += fmt::format(" {:02X}", byte);
  }
  return "{" + text + "}";
}

std::string repeat_text(Time period, std::uint64_t count) {
  std::string text;
  if (period != 0) text += ", period: " + exact_time(period);
  if (count != std::numeric_limits<std::uint64_t>::max()) text += fmt::format(", count: {}", count);
  return text;
}

std::string ramp_text(const UserSpec &user) {
  if (!user.ramp) return "";
  return fmt::format(", ramp: 0x{:03X}, from: {}, step: {}", *user.ramp, user.from, user.step);
}

}  // namespace

std::string commands_text(const Scenario &scenario, const RemoteCommandSpec &commands) {
  std::string text = "  - {node: " + yaml_text(scenario.nodes[commands.node].name);
  if (commands.at != 0) text += ", at: " + exact_time(commands.at);
  text += repeat_text(commands.period, commands.count) + ", do: [";
  for (const RemoteStep &step : commands.steps)
    text += (&step == commands.steps.data() ? "" : ", ") + yaml_text(step.text);
  return text + "]}\n";
}

std::string user_text(const Scenario &scenario, const UserSpec &user) {
  std::string text = "  - {node: " + yaml_text(scenario.nodes[user.node].name);
  if (user.after_apply) text += ", after: apply, delay: " + exact_time(user.at);
  if (!user.after_apply && user.at != 0) text += ", at: " + exact_time(user.at);
  text += repeat_text(user.period, user.count);
  if (!user.write.empty()) text += ", write: " + places_text(user.write);
  text += ramp_text(user);
  if (user.plant)
    text += fmt::format(", plant: {{set_point: 0x{:03X}, measured: 0x{:03X}}}",
                        user.plant->set_point, user.plant->measured);
  if (user.event) text += fmt::format(", event: {}", *user.event);
  return text + "}\n";
}

std::string remote_text(const RemoteRole &role) {
  const RemoteConfig &config = role.config;
  std::string text = ", type: remote, profile: " + profile_of(config);
  const auto number = [&](const char *key, std::uint32_t value, std::uint32_t usual) {
    if (value != usual) text += fmt::format(", {}: {}", key, value);
  };
  const RemoteConfig usual;
  number("number", role.number, 0);
  number("serial", config.serial, usual.serial);
  number("name_bits", config.name_bits, usual.name_bits);
  number("memory_bytes", config.mem_bytes, usual.mem_bytes);
  number("stage_bytes", config.stage_bytes, usual.stage_bytes);
  if (config.same_id) text += ", same_id: true";
  if (role.body == RemoteRole::Body::kRtl) text += ", made_of: rtl";
  if (role.body == RemoteRole::Body::kModel) text += ", made_of: model";
  return role.memory.empty() ? text : text + ", memory: " + places_text(role.memory);
}

}  // namespace vericansim::detail

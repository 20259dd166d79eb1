// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: remote nodes back to text.
#include <fmt/format.h>

#include <stdexcept>

#include "scenario/scenario_text.hpp"

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

}  // namespace

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
  std::string memory;
  for (const auto &[address, bytes] : role.memory) {
    memory += fmt::format("{}0x{:03X}:", memory.empty() ? "" : ", ", address);
    for (const unsigned byte : bytes) memory += fmt::format(" {:02X}", byte);
  }
  return memory.empty() ? text : text + ", memory: {" + memory + "}";
}

}  // namespace vericansim::detail

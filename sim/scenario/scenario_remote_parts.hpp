// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the readers of remote nodes, their hosts' commands and their user logic share.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "scenario/scenario_parts.hpp"

namespace vericansim::detail {

/// Where the memory of a node ends, below the configuration.
[[nodiscard]] inline unsigned memory_end(const RemoteConfig &config) {
  return config.mem_bytes - 512;
}
/// "01 A5": 1 to `most` hexadecimal bytes.
[[nodiscard]] std::vector<std::uint8_t> parse_bytes(const YamlValue &value, std::size_t most);
/// Adds the bytes of `value`, from address `at` on, to those of `memory`; throws if one is there.
void add_bytes(const YamlValue &value, unsigned at, std::vector<std::uint8_t> bytes,
               std::map<unsigned, std::vector<std::uint8_t>> &memory);
/// An address of the memory as a key of a map; throws that of `value` unless it is below `end`.
[[nodiscard]] unsigned parse_address(const std::string &key, const YamlValue &value, unsigned end);
/// The node of that name and its role; throws if it is no remote node.
[[nodiscard]] NodeId parse_remote_name(const YamlValue &value, const Scenario &scenario);
/// NameBits of the scenario's remote nodes; throws, as `value`, if there are none, or they differ.
[[nodiscard]] RemoteConfig common_config(const YamlValue &value, const Scenario &scenario);

}  // namespace vericansim::detail

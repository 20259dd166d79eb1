// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: the kinds of nodes.
#include <filesystem>

#include "scenario/scenario_parts.hpp"
#include "trace/input_error.hpp"

namespace vericansim::detail {
namespace {

/// A file that a scenario names: relative to the scenario's own folder.
std::string file_of(const YamlValue &value) {
  const std::string path = value.text();
  if (path.empty()) value.refuse("the name of a file");
  return (std::filesystem::path{value.file()}.parent_path() / path).lexically_normal().string();
}

FirmwareRole parse_firmware(const YamlValue &value, YamlMap &map) {
  FirmwareRole role;
  role.file = file_of(value);
  map.with("clocks_per_instruction", [&](const YamlValue &v) {
    role.clocks_per_instruction = static_cast<unsigned>(v.integer(1, 100));
  });
  map.with("run_hard_fault_handler",
           [&](const YamlValue &v) { role.run_hard_fault_handler = v.boolean(); });
  return role;
}

SecondCoreRole parse_second_core(const YamlValue &value, const Scenario &scenario) {
  for (const NodeSpec &other : scenario.nodes) {
    const auto *second = std::get_if<SecondCoreRole>(&other.role);
    if (second != nullptr && second->board == value.text())
      value.fail("the board " + quoted(value.text()) +
                 " has its second core already: " + quoted(other.name));
  }
  for (const NodeSpec &other : scenario.nodes)
    if (other.name == value.text() && std::holds_alternative<FirmwareRole>(other.role))
      return {value.text()};
  value.refuse("the name of a node above that has firmware");
}

}  // namespace

NodeRole parse_role(YamlMap &map, const Scenario &scenario) {
  NodeRole role;
  std::string kind;
  const auto is = [&](const char *key, auto parse) {
    map.with(key, [&](const YamlValue &v) {
      if (!kind.empty()) v.fail("a node is of one kind, and this one has '" + kind + "'");
      kind = key;
      role = parse(v);
    });
  };
  is("firmware", [&](const YamlValue &v) { return parse_firmware(v, map); });
  is("second_core_of", [&](const YamlValue &v) { return parse_second_core(v, scenario); });
  return role;
}

}  // namespace vericansim::detail

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See memory_nodes.hpp.
#include "cli/memory_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

namespace vericansim::cli {
namespace {

constexpr const char *kFeatures[] = {
    "stage", "producers", "map", "queue of 4", "protection", "block", "automatic rate", "counters"};

std::string features_text(unsigned features) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < std::size(kFeatures); ++i)
    if ((features >> i & 1) != 0) names.emplace_back(kFeatures[i]);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string number_text(unsigned number) {
  if (number == 0) return "none";
  return number == VERICAN_REMOTE_UNKNOWN ? "?" : std::to_string(number);
}

/// Of nodes without a number, and of those that share one, only the serial number is known.
bool is_known(const verican_remote_identity_t &node) { return node.version != 0; }

}  // namespace

std::vector<std::string> complaints(const MemoryNodes &nodes) {
  std::map<unsigned, std::vector<std::string>> serials;  // by number
  std::map<std::uint32_t, std::vector<std::string>> numbers;
  for (const verican_remote_identity_t &node : nodes) {
    if (node.doubled) serials[node.number].push_back(fmt::format("{:08X}", node.serial));
    numbers[node.serial].push_back(number_text(node.number));
  }
  std::vector<std::string> all;
  for (const auto &[number, who] : serials)
    all.push_back(number == VERICAN_REMOTE_UNKNOWN
                      ? fmt::format("nodes with serial numbers {} share numbers with other nodes",
                                    fmt::join(who, ", "))
                      : fmt::format("number {}: the nodes with serial numbers {} have it", number,
                                    fmt::join(who, ", ")));
  for (const auto &[serial, who] : numbers)
    if (who.size() > 1)
      all.push_back(fmt::format("serial number {:08X}: the nodes with numbers {} have it", serial,
                                fmt::join(who, ", ")));
  return all;
}

std::vector<std::string> complaints(const verican_remote_answers_t &answers) {
  std::vector<std::string> all;
  for (unsigned number = 0; number < VERICAN_REMOTE_NUMBERS; ++number)
    if ((answers.differing >> number & 1) != 0)
      all.push_back(fmt::format("number {}: two nodes have it", number));
  return all;
}

std::string to_text(const MemoryNodes &nodes) {
  std::string text = "node  serial    memory  stage  features\n";
  for (const verican_remote_identity_t &n : nodes) {
    text += fmt::format("{:>4}  {:08X}", number_text(n.number), n.serial);
    if (is_known(n))
      text += fmt::format("  {:>6}  {:>5}  {}", n.memory, n.stage, features_text(n.features));
    text += "\n";
  }
  return text;
}

Json to_json(const MemoryNodes &nodes) {
  Json list = Json::array();
  for (const verican_remote_identity_t &n : nodes) {
    list.push_back({{"number", n.number},
                    {"doubled", n.doubled},
                    {"serial", n.serial},
                    {"memory", n.memory},
                    {"stage", n.stage},
                    {"features", n.features}});
    if (n.number == VERICAN_REMOTE_UNKNOWN) list.back()["number"] = nullptr;
  }
  return list;
}

}  // namespace vericansim::cli

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See scenario_warnings.hpp.
#include "scenario/scenario_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using Names = std::vector<std::string>;

template <typename Key>
void add_shared(const std::map<Key, Names> &nodes, const char *what, const char *hint,
                std::vector<std::string> &warnings) {
  for (const auto &[key, names] : nodes)
    if (names.size() > 1)
      warnings.push_back(fmt::format(fmt::runtime(what), key) +
                         fmt::format(" is that of {}: {}", fmt::join(names, ", "), hint));
}

/// A received frame replaces the identifier in its buffer: a base frame leaves none of the last 18
/// bits, so that a filter that compares those takes others from then on (flexcan.md 3.5).
void add_filters_that_change(const NodeSpec &node, std::vector<std::string> &warnings) {
  constexpr std::uint32_t kLast = 0x3FFFF;
  for (std::size_t i = 0; i < node.host.filters.size(); ++i) {
    const RxFilter &filter = node.host.filters[i];
    if (!filter.match_format && filter.extended && (filter.mask & kLast) != 0)
      warnings.push_back(
          fmt::format("filters[{}] of {} may take other frames behind its first base frame, which "
                      "has none of the last 18 bits of 'mask'",
                      i, in_quotes(node.name)));
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Scenario &scenario) {
  std::map<unsigned, Names> numbers;
  std::map<std::uint32_t, Names> serials;
  std::vector<std::string> warnings;
  for (const NodeSpec &node : scenario.nodes) {
    add_filters_that_change(node, warnings);
    const auto *role = std::get_if<RemoteRole>(&node.role);
    if (role == nullptr) continue;
    const std::string name = in_quotes(node.name);
    if (role->number >= 2) numbers[role->number].push_back(name);  // 0 and 1: none
    serials[role->config.serial].push_back(name);
  }
  add_shared(numbers, "number {}", "their answers destroy each other", warnings);
  add_shared(serials, "serial number 0x{:08X}", "ASSIGN means all of them", warnings);
  return warnings;
}

}  // namespace vericansim

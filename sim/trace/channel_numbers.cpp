// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers of interfaces: see channel_numbers.hpp.
#include "trace/channel_numbers.hpp"

#include <optional>
#include <set>

#include "trace/log_walk.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

/// The digits at the end of "can2".
std::optional<unsigned> number_in(const std::string &name) {
  constexpr unsigned kHighest = 254;  // formats count from 1 in a byte
  const std::size_t last = name.find_last_not_of("0123456789");
  const auto number = text::parse_unsigned(
      std::string_view{name}.substr(last == std::string::npos ? 0 : last + 1), 10);
  if (!number || *number > kHighest) return {};
  return static_cast<unsigned>(*number);
}

}  // namespace

std::map<std::string, unsigned> channel_numbers(const CanLog &log) {
  std::map<std::string, unsigned> by_order, by_name;
  std::set<unsigned> used;
  const auto add = [&](const auto &entry) {
    if (entry.channel.empty()) return;
    if (!by_order.try_emplace(entry.channel, static_cast<unsigned>(by_order.size())).second) return;
    const auto number = number_in(entry.channel);
    if (number && used.insert(*number).second) by_name[entry.channel] = *number;
  };
  walk(log, add, add);
  return by_name.size() == by_order.size() ? by_name : by_order;
}

}  // namespace vericansim

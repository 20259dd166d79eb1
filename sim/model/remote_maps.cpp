// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a node takes over from the statements of others.
#include "model/remote_maps.hpp"

#include <algorithm>

namespace vericansim {

RemoteMaps::RemoteMaps(const RemoteConfig &config, const RemoteMemory &memory)
    : config_{config}, memory_{memory}, waited_(config.num_map) {}

bool RemoteMaps::on(unsigned k) const { return (memory_.word(address(k)) & 0x8000) != 0; }

bool RemoteMaps::matches(unsigned k, const Frame &frame) const {
  const unsigned mask = memory_.word(address(k) + 2) & 0x7FF;
  if (!on(k) || ((memory_.word(address(k)) ^ frame.id) & mask) != 0) return false;
  const unsigned all_of_a = (1U << config_.address_bits()) - 1;
  const bool port = (frame.id & all_of_a) >= config_.first_port();
  return !port || (mask & all_of_a) == all_of_a;
}

std::optional<RemoteMaps::Place> RemoteMaps::find(const Frame &frame) const {
  for (unsigned k = 0; k < waited_.size(); ++k) {
    if (!matches(k, frame)) continue;
    const unsigned wanted = flags(k) & 0x0F;
    if (frame.dlc > 8 || wanted > frame.dlc) return std::nullopt;
    const unsigned free_bits = frame.id & ~memory_.word(address(k) + 2) & 0x7F;
    return Place{k, memory_.word(address(k) + 4) | free_bits, wanted != 0 ? wanted : frame.dlc,
                 (flags(k) & 0x20) != 0};
  }
  return std::nullopt;
}

void RemoteMaps::taken(unsigned entry) { waited_[entry] = 0; }

void RemoteMaps::tick() {
  for (unsigned k = 0; k < waited_.size(); ++k)
    waited_[k] = on(k) ? std::min(waited_[k] + 1, 0xFFFFU) : 0;
}

void RemoteMaps::restart() { waited_.assign(waited_.size(), 0); }

bool RemoteMaps::is_late(unsigned k) const {
  const unsigned limit = 10U * memory_[address(k) + 7];
  return on(k) && limit != 0 && waited_[k] >= limit;
}

bool RemoteMaps::stale() const {
  for (unsigned k = 0; k < waited_.size(); ++k)
    if (is_late(k)) return true;
  return false;
}

bool RemoteMaps::stale_leads_to_safe() const {
  for (unsigned k = 0; k < waited_.size(); ++k)
    if (is_late(k) && (flags(k) & 0x40) != 0) return true;
  return false;
}

}  // namespace vericansim

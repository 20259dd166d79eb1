// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Tolerances: see rule_tolerance.hpp.
#include "judge/rule_tolerance.hpp"

#include <cstdlib>

namespace vericansim {

bool settle_tec(NodeModel &model, const NodeBit &bit) {
  const NodeEvents &events = model.events();
  const bool after_rtr = events.at.field == Field::kIde || events.at.field == Field::kR1;
  const bool allowed = events.error == NodeError::kStuff && events.at.is_stuff && after_rtr &&
                       std::abs(static_cast<int>(bit.tec) - model.tec()) == 8;
  if (allowed) model.preset_counters(static_cast<int>(bit.tec), model.rec());
  return allowed;
}

bool settle_rec(NodeModel &model, int last_rec, bool &crc_step, const NodeBit &bit) {
  const int node = static_cast<int>(bit.rec);
  if (node >= 128 && model.rec() >= 128) return true;
  const bool set_back = last_rec >= 128 && model.rec() >= 119 && model.rec() <= 127;
  if (set_back && node >= 119 && node <= 127) {
    model.preset_counters(model.tec(), node);
    return true;
  }
  const bool crc = model.events().error == NodeError::kCrc || (bit.errors & kErrCrc) != 0;
  if (std::abs(node - model.rec()) != 1 || !crc || crc_step) return false;
  crc_step = true;
  return true;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Parameters of can_remote.
#include "model/remote_config.hpp"

#include <algorithm>
#include <initializer_list>
#include <stdexcept>

namespace vericansim {
namespace {

void require(const char *name, unsigned value, std::initializer_list<unsigned> allowed) {
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
  std::string text = std::string{name} + " " + std::to_string(value) + " is not allowed; allowed:";
  for (const unsigned one : allowed) text += " " + std::to_string(one);
  throw std::invalid_argument(text);
}

}  // namespace

RemoteConfig RemoteConfig::profile(const std::string &name) {
  RemoteConfig config;
  if (name == "small") return config;
  config.num_prod = config.num_map = 8;
  config.tx_depth = 4;
  config.protect = true;
  if (name == "standard") return config;
  if (name != "full")
    throw std::invalid_argument("profile '" + name +
                                "' is not allowed; allowed: small, standard, full");
  config.block = config.auto_rate = config.counters = true;
  return config;
}

void RemoteConfig::validate() const {
  require("NameBits", name_bits, {3, 5});
  require("MemBytes", mem_bytes, {1024, 2048, 4096});
  require("StageBytes", stage_bytes, {0, 8, 16});
  require("TxDepth", tx_depth, {1, 4});
  require("NumProd", num_prod, {0, 4, 8});
  require("NumMap", num_map, {0, 4, 8});
  if (rate_rows == 0 || rate_rows > 15)
    throw std::invalid_argument("a rate table has 1 to 15 rows, not " + std::to_string(rate_rows));
}

std::uint8_t RemoteConfig::features() const {
  const bool parts[] = {stage_bytes != 0, num_prod != 0, num_map != 0, tx_depth == 4,
                        protect,          block,         auto_rate,    counters};
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= parts[i] ? 1U << i : 0;
  return static_cast<std::uint8_t>(bits);
}

}  // namespace vericansim

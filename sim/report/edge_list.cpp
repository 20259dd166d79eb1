// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// EdgeList: see edge_list.hpp.
#include "report/edge_list.hpp"

namespace vericansim {

void EdgeList::change(Time time, Level level) {
  if (level == level_) return;
  level_ = level;
  const Time tick = (time - start_ + kTick / 2) / kTick;
  auto distance = static_cast<std::uint64_t>(tick - last_);
  last_ = tick;
  for (; distance > 0x7F; distance >>= 7)
    packed_.push_back(static_cast<std::uint8_t>(distance | 0x80));
  packed_.push_back(static_cast<std::uint8_t>(distance));
}

std::vector<std::uint32_t> EdgeList::distances() const {
  std::vector<std::uint32_t> result;
  std::uint64_t distance = 0;
  unsigned shift = 0;
  for (const std::uint8_t byte : packed_) {
    distance |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    shift += 7;
    if ((byte & 0x80) != 0) continue;
    for (; distance >= kLongest; distance -= kLongest) result.push_back(kLongest);
    result.push_back(static_cast<std::uint32_t>(distance));
    distance = 0;
    shift = 0;
  }
  return result;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The rows of a node that tell of itself.
#include "model/remote_status.hpp"

#include <bit>
#include <optional>

namespace vericansim {
namespace {

std::optional<RemoteCounter> counter_of(RemoteCode code) {
  switch (code) {
    case RemoteCode::kFunction: return RemoteCounter::kFunction;
    case RemoteCode::kValue: return RemoteCounter::kValue;
    case RemoteCode::kAddress:
    case RemoteCode::kProtected:
    case RemoteCode::kLocked: return RemoteCounter::kAddress;
    case RemoteCode::kBusy: return RemoteCounter::kBusy;
    case RemoteCode::kSequence: return RemoteCounter::kSequence;
    default: return std::nullopt;
  }
}

}  // namespace

void RemoteStatus::accept(unsigned at, RemoteCode result) {
  ++accepted;
  code = result;
  a = static_cast<std::uint8_t>(at);
}

void RemoteStatus::refuse(unsigned at, RemoteCode why) {
  ++refused;
  code = why;
  a = static_cast<std::uint8_t>(at);
  if (const auto counter = counter_of(why)) count(*counter);
}

void RemoteStatus::count(RemoteCounter counter) {
  std::uint8_t &value = counters[static_cast<std::size_t>(counter)];
  if (value != 0xFF) ++value;
}

void RemoteStatus::clear() {
  counters.fill(0);
  duplicate = watchdog = bus_off = false;
}

std::array<std::uint8_t, 8> RemoteStatus::row() const {
  const bool passive = tec > 127 || rec > 127;
  const bool flags[] = {unlocked, passive, duplicate, stale, watchdog, bus_off};
  unsigned first = static_cast<unsigned>(state);
  for (unsigned i = 0; i < 6; ++i) first |= flags[i] ? 4U << i : 0;
  return {static_cast<std::uint8_t>(first),
          tec,
          rec,
          static_cast<std::uint8_t>(code),
          a,
          accepted,
          refused,
          trigger};
}

std::array<std::uint8_t, 8> remote_ident(const RemoteConfig &config) {
  const unsigned sizes = config.name_bits << 4 | (std::bit_width(config.mem_bytes) - 1U);
  std::array<std::uint8_t, 8> row{1, config.features(), static_cast<std::uint8_t>(sizes),
                                  static_cast<std::uint8_t>(config.stage_bytes)};
  for (unsigned i = 0; i < 4; ++i) row[4 + i] = static_cast<std::uint8_t>(config.serial >> (8 * i));
  return row;
}

}  // namespace vericansim

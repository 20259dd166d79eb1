// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteUser: see remote_user.hpp.
#include "simulation/remote_user.hpp"

namespace vericansim {

void RemoteUser::start(Time start, Time stop) {
  stop_ = stop;
  never_acts_ = !spec_.after_apply && start + spec_.at >= stop;
  if (!spec_.after_apply) schedule(start + spec_.at);
}

void RemoteUser::schedule(Time when) {
  if (when >= stop_ || times_ >= spec_.count) return;
  bus_.at(when, [this, when] {
    act();
    if (spec_.period != 0) schedule(when + spec_.period);
  });
}

void RemoteUser::applied() {
  if (!spec_.after_apply || times_ >= spec_.count) return;
  bus_.at(bus_.now() + spec_.at, [this] { act(); });
}

void RemoteUser::act() {
  for (const auto &[address, bytes] : spec_.write) {
    unsigned at = address;
    for (const std::uint8_t byte : bytes) write(at++, 1, byte);
  }
  if (spec_.ramp) write(*spec_.ramp, 2, (spec_.from + times_ * spec_.step) & 0xFFFF);
  if (spec_.plant) step_plant(*spec_.plant);
  ++times_;
  if (!spec_.event && !on_written) return;
  // User logic waits for its port at most 24 clocks in a row (RN-50), so this is behind the write.
  constexpr double kClocks = 64;
  const auto wait = static_cast<Time>(kClocks * 1e12 / unit_.oscillator().config().frequency_hz);
  bus_.at(bus_.now() + wait, [this] {
    if (on_written) on_written();
    if (spec_.event) unit_.event(*spec_.event);
  });
}

// Bytes of one word go in one access (RN-51).
void RemoteUser::write(unsigned address, unsigned length, std::uint64_t bytes) {
  while (length != 0) {
    const unsigned lane = address % 4;
    const unsigned n = std::min(length, 4 - lane);
    const unsigned lanes = ((1U << n) - 1) << lane;
    unit_.user_write(address / 4, static_cast<std::uint32_t>(bytes) << (8 * lane), lanes);
    address += n;
    length -= n;
    bytes >>= 8 * n;
  }
}

void RemoteUser::step_plant(const PlantSpec &plant) {
  const std::uint32_t wanted =
      unit_.safe() ? 0U : unit_.peek(plant.set_point) | unit_.peek(plant.set_point + 1) << 8U;
  const auto difference = static_cast<std::int32_t>(wanted - current_);
  current_ += static_cast<std::uint32_t>(difference / 4);
  const std::uint32_t voltage = 40000 - current_ / 8;
  const std::uint32_t word = (current_ & 0xFFFF) | voltage << 16;
  write(plant.measured, 4, word);
  if (on_measured) on_measured(word);
}

}  // namespace vericansim

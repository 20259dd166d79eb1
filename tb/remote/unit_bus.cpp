// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Remote nodes with a host and another node on a bus of bits.
#include "remote/unit_bus.hpp"

#include <utility>

#include "trace/candump.hpp"

namespace vericansim {

namespace {

std::vector<std::unique_ptr<RemoteUnit>> list_of(std::unique_ptr<RemoteUnit> made) {
  std::vector<std::unique_ptr<RemoteUnit>> units;
  units.push_back(std::move(made));
  return units;
}

}  // namespace

UnitBus::UnitBus(std::unique_ptr<RemoteUnit> made) : UnitBus{list_of(std::move(made))} {}

UnitBus::UnitBus(std::vector<std::unique_ptr<RemoteUnit>> made)
    : units{std::move(made)},
      unit{units.front().get()},
      host{"host", {.timing = timing()}, clock()},
      other{"other", {.timing = timing()}, clock()} {
  bus.add(host);
  bus.add(other);
  for (const auto &one : units) bus.add(*one);
  host.start();
  other.start();
  run_bits(20);
}

std::vector<std::string> UnitBus::start() {
  for (const auto &one : units) one->start();
  run_bits(20);
  return settle();
}

std::vector<std::string> UnitBus::send(const Frame &frame, bool from_other) {
  host.received().clear();
  (from_other ? other : host).request(frame);
  run_bits(2);
  std::vector<std::string> said = settle();
  if (from_other && !said.empty()) said.erase(said.begin());  // the frame itself
  return said;
}

std::vector<std::string> UnitBus::settle(unsigned bits) {
  constexpr unsigned kIdle = 20;
  for (unsigned idle = 0; idle < kIdle && bits != 0; --bits) {
    run_bits(1);
    bool busy = host.pending() || other.pending() || !host.idle();
    for (const auto &one : units) busy = busy || !one->idle();
    idle = busy ? 0 : idle + 1;
  }
  std::vector<std::string> said;
  for (const Frame &frame : host.received()) said.push_back(candump_frame(frame));
  host.received().clear();
  return said;
}

}  // namespace vericansim

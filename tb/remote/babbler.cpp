// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See babbler.hpp.
#include "remote/babbler.hpp"

#include "bus/faults.hpp"
#include "remote/random_host.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

constexpr unsigned kNode = 3;
constexpr NodeId kHostId = 0, kOtherId = 1, kNodeId = 2;
constexpr unsigned kQueue = 4;    // frames that always wait
constexpr unsigned kStep = 40;    // bits: less than any frame has
constexpr unsigned kBreaks = 25;  // one step in so many has a flipped bit

/// Any request. Statements are left out: one of the node's own number is a collision with it
/// (RN-11), and errors, not requests, end in bus-off.
Frame any_request(RandomHost &dice) {
  Frame frame = dice.frame();
  if (!frame.extended) frame.id &= 0x3FF;
  return frame;
}

/// Flips a bit for one of the three, or for all.
void flip(ScheduledFaults &flips, RandomHost &dice, Time now) {
  static constexpr NodeId kVictims[] = {kHostId, kOtherId, kNodeId, kAllNodes};
  const Time from = now + dice.upto(kStep) * UnitBus::kBit + dice.upto(1000) * kNanosecond;
  flips.add(kVictims[dice.upto(4)], Effect::kFlip, {from, from + UnitBus::kBit});
}

/// Whether the node does what correct commands say: SAFE, then the number that it had.
bool works(RtlBus &bus) {
  for (const char *command : {"000#02", "002#0000000000000000", "003#03"}) (void)bus.send(command);
  return bus.send("1A0#R1").size() == 1;
}

}  // namespace

void UserWaits::on_bit(NodeId node, const BitRecord &bit) {
  if (node != kHostId) return;
  ++result_.bits;
  result_.idle_bits += bit.at.field == Field::kIdle;
}

BabbleResult babble(const std::string &profile, unsigned seed, unsigned bits) {
  RtlBus bus{rtl_unit(kNode, RemoteConfig::profile(profile))};
  ScheduledFaults flips;
  bus.bus.add(flips);
  (void)bus.start();
  BabbleResult result;
  UserWaits waits{bus.node(), kNodeId, result};
  bus.bus.add(waits);
  RandomHost dice{seed};
  bus.host.clear_events();
  for (unsigned at = 0; at < bits; at += kStep) {
    while (bus.host.waiting() < kQueue) bus.host.request(any_request(dice));
    if (dice.once_in(kBreaks)) flip(flips, dice, bus.bus.now());
    bus.run_bits(kStep);
    bus.host.received().clear();
    bus.host.sent().clear();
  }
  bus.bus.remove(waits);
  result.frames = bus.host.events().sent;
  result.broken = bus.host.events().failed;
  bus.host.cancel();
  (void)bus.settle();
  bus.run_bits(static_cast<unsigned>(kMillisecond / UnitBus::kBit));
  result.answers = works(bus);
  return result;
}

}  // namespace vericansim

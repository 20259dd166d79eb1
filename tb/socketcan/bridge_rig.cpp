// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BridgeRig: see bridge_rig.hpp.
#include "socketcan/bridge_rig.hpp"

#include <fmt/format.h>

#include "bridge/frame_form.hpp"

namespace vericansim::test {

// ---- FakePort

std::optional<PortMessage> FakePort::take() {
  if (outgoing.empty()) return {};
  const PortMessage message = outgoing.front();
  outgoing.pop_front();
  return message;
}

bool FakePort::put(const PortMessage &message) {
  if (room == 0) {
    ++refusals;
    return false;
  }
  --room;
  got.push_back(message);
  return true;
}

void FakePort::send(const Frame &frame, std::uint64_t client) {
  outgoing.push_back({.frame = to_can_frame(frame), .client = client});
}

std::vector<Frame> FakePort::frames() const {
  std::vector<Frame> result;
  for (const PortMessage &message : got)
    if (!message.echo)
      if (const auto frame = from_can_frame(message.frame)) result.push_back(*frame);
  return result;
}

std::vector<Frame> FakePort::echoes() const {
  std::vector<Frame> result;
  for (const PortMessage &message : got)
    if (message.echo)
      if (const auto frame = from_can_frame(message.frame)) result.push_back(*frame);
  return result;
}

std::vector<can_frame> FakePort::errors() const { return errors(CAN_ERR_FLAG); }

std::vector<can_frame> FakePort::errors(canid_t classes) const {
  std::vector<can_frame> result;
  for (const PortMessage &message : got)
    if ((message.frame.can_id & CAN_ERR_FLAG) != 0 && (message.frame.can_id & classes) == classes)
      result.push_back(message.frame);
  return result;
}

// ---- FakeWall

void FakeWall::wait(std::vector<pollfd> &, std::optional<WallTime> timeout) {
  on_wait();
  if (timeout) {
    time += *timeout;
    timeouts.push_back(*timeout);
  } else {
    ++endless_waits;
  }
}

// ---- BridgeRig

BridgeRig::BridgeRig(const RigOptions &options) {
  constexpr double kClocksPerBit = 8;
  BridgeSetup setup;
  setup.bitrate = options.bitrate;
  setup.port_clock_hz = kClocksPerBit * options.bitrate;
  for (unsigned i = 0; i < options.nodes; ++i) {
    NodeSpec node;
    node.name = fmt::format("node{}", i);
    node.clock.frequency_hz = setup.port_clock_hz;
    setup.scenario.nodes.push_back(node);
  }
  for (unsigned i = 1; i <= options.remotes; ++i) {
    NodeSpec node;
    node.name = fmt::format("remote{}", i);
    node.clock.frequency_hz = setup.port_clock_hz;
    RemoteRole role;
    role.number = i;
    node.role = role;
    setup.scenario.nodes.push_back(node);
  }
  setup.scenario.faults = options.faults;
  setup.scenario.traffic = options.traffic;
  for (unsigned i = 0; i < options.ports; ++i) {
    auto port = std::make_unique<FakePort>(fmt::format("can{}", i));
    ports_.push_back(port.get());
    setup.ports.push_back(std::move(port));
  }
  if (options.monitor) {
    auto port = std::make_unique<FakePort>("monitor");
    monitor_ = port.get();
    setup.monitor = std::move(port);
  }
  setup.options = options.options;
  setup.fast = options.fast;
  setup.limit = options.limit;
  setup.end_when_down = options.end_when_down;
  setup.say = [this](const std::string &line) { said.push_back(line); };
  bridge_ = std::make_unique<Bridge>(std::move(setup), wall);
  bridge_->start();
}

bool BridgeRig::run_until(const std::function<bool()> &done, Time limit) {
  constexpr unsigned kRounds = 200'000;
  const Time end = bridge_->elapsed() + limit;
  for (unsigned rounds = 0; rounds < kRounds && bridge_->elapsed() <= end; ++rounds) {
    if (done()) return true;
    bridge_->round();
  }
  return done();
}

void BridgeRig::run_for(Time time) {
  const Time end = bridge_->elapsed() + time;
  bridge_->round();  // takes what has been sent since
  for (Time before = -1; bridge_->elapsed() < end && bridge_->elapsed() != before;) {
    before = bridge_->elapsed();
    bridge_->round();
  }
}

// ---- Frames

Frame numbered_frame(unsigned number) {
  Frame frame;
  frame.extended = (number & 2) != 0;
  frame.remote = number % 7 == 3;
  frame.dlc = number % 16;
  // Odd multipliers keep the lowest bit: even and odd numbers never have the same identifier.
  frame.id = frame.extended ? (number * 0x9E3779B1U) & 0x1FFFFFFF : (number * 0x2F5U) & 0x7FF;
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(i < 4 ? number >> (8 * i) : number * 31 + i);
  return frame;
}

TrafficSpec beat(Time period) {
  TrafficSpec spec;
  spec.name = "beat";
  spec.frame = {.id = 0x055, .dlc = 1, .data = {0x42}};
  spec.period = period;
  return spec;
}

}  // namespace vericansim::test

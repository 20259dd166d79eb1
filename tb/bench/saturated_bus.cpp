// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SaturatedBus: see saturated_bus.hpp.
#include "bench/saturated_bus.hpp"

#include <stdexcept>
#include <string>

namespace vericansim {

BitTiming SaturatedBus::timing(unsigned megahertz) {
  switch (megahertz) {
    case 8: return {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2};
    case 16: return {.prescaler = 1, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 4};
    case 50: return {.prescaler = 5, .prop = 3, .ps1 = 3, .ps2 = 3, .sjw = 3};
    case 80: return {.prescaler = 8, .prop = 3, .ps1 = 3, .ps2 = 3, .sjw = 3};
    default:
      throw std::invalid_argument("no 1 Mbit/s timing for " + std::to_string(megahertz) + " MHz");
  }
}

SaturatedBus::SaturatedBus(unsigned nodes, unsigned megahertz, bool drift, bool with_time) {
  for (unsigned i = 0; i < nodes; ++i) {
    ClockConfig clock{.frequency_hz = megahertz * 1e6};
    if (drift) {
      clock.error_ppm = (i % 2 == 0 ? 1.0 : -1.0) * (50.0 + 13.0 * i);
      clock.phase = static_cast<Time>(1013 * i);
    }
    const std::string name = "node" + std::to_string(i);
    nodes_.push_back(with_time ? RtlNode::create_with_time(name, clock)
                               : RtlNode::create(name, clock));
    bus_.add(*nodes_.back());
    HostConfig config;
    config.timing = timing(megahertz);
    hosts_.push_back(std::make_unique<Host>(*nodes_.back(), config));
    hosts_.back()->start();
  }
  const auto ready = [this] {
    for (const auto &host : hosts_) {
      if (!host->ready()) return false;
    }
    return true;
  };
  if (!bus_.run_until(ready, 100 * kMillisecond)) throw std::runtime_error("a node does not start");
  bus_.run_for(50 * kMicrosecond);
  // Two frames wait at each node; each one sent is replaced.
  for (unsigned i = 0; i < nodes; ++i) {
    Host &host = *hosts_[i];
    host.on_received = [](const HostFrame &) {};
    host.on_sent = [&host](const HostFrame &sent) {
      Frame next = sent.frame;
      ++next.data[0];
      host.send(next);
    };
    Frame frame{
        .id = 0x100 + 16 * i, .dlc = 8, .data = {0, 0x55, 0xC3, 0x0F, 0x99, 0x12, 0xE0, 0x7B}};
    host.send(frame);
    host.send(frame);
  }
}

std::uint64_t SaturatedBus::cycles() const {
  std::uint64_t sum = 0;
  for (const auto &node : nodes_) sum += node->cycles();
  return sum;
}

std::uint64_t SaturatedBus::received() const {
  std::uint64_t sum = 0;
  for (const auto &host : hosts_) sum += host->stats().received;
  return sum;
}

}  // namespace vericansim

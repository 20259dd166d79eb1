// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DriverNode: the C driver on a whole core. Each of its register accesses runs the bus until the
// AHB transfer is done, so that software takes simulated time. DriverBus: some of them on one bus.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "harness/core_build.hpp"
#include "node/rtl_node.hpp"
#include "verican/verican.h"

namespace vericansim {

/// A frame to send.
inline verican_frame_t driver_frame(std::uint32_t id, unsigned dlc = 8, unsigned flags = 0,
                                    std::uint64_t data = 0x0123456789ABCDEF) {
  verican_frame_t frame{};
  frame.id = id;
  frame.dlc = static_cast<std::uint8_t>(dlc);
  frame.flags = static_cast<std::uint8_t>(flags);
  for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(data >> (56 - 8 * i));
  return frame;
}

/// One core with its driver.
class DriverNode {
 public:
  DriverNode(std::string name, const ClockConfig &clock, const CoreBuild &build)
      : DriverNode{make_node(std::move(name), build, clock), clock} {}
  DriverNode(std::unique_ptr<RtlNode> node, const ClockConfig &clock) : rtl_{std::move(node)} {
    verican_config_default(&config);
    config.port.read32 = &read;
    config.port.write32 = &write;
    config.port.context = this;
    config.clock_hz = static_cast<std::uint32_t>(clock.frequency_hz);
    config.bitrate = 1'000'000;
    config.rx_ring = ring_.data();
    config.rx_ring_size = static_cast<std::uint16_t>(ring_.size());
    config.callbacks = {&on_sent, &on_state, nullptr, nullptr, this};
  }
  DriverNode(const DriverNode &) = delete;
  DriverNode &operator=(const DriverNode &) = delete;

  /// verican_init() and verican_start().
  verican_result_t up() {
    const verican_result_t result = verican_init(&dev, &config);
    return result == VERICAN_OK ? verican_start(&dev) : result;
  }
  [[nodiscard]] RtlNode &rtl() { return *rtl_; }
  /// The processor does not wait for its writes: they go out back to back, in front of a read.
  void post_writes() { config.port.write32 = &post; }
  /// Takes everything out of the ring.
  std::vector<verican_frame_t> received() {
    std::vector<verican_frame_t> frames;
    verican_frame_t frame;
    while (verican_receive(&dev, &frame) == VERICAN_OK) frames.push_back(frame);
    return frames;
  }
  verican_status_t status() {
    verican_status_t status{};
    verican_get_status(&dev, &status);
    return status;
  }

  verican_config_t config{};
  verican_t dev{};
  std::vector<verican_tx_event_t> events;                     ///< what on_sent told
  std::vector<verican_state_t> states;                        ///< what on_state told
  std::function<void(const verican_tx_event_t &)> when_sent;  ///< called besides
  bool interrupts = true;                                     ///< serve() calls the handler

  /// Serves the interrupt line as it is.
  void serve() {
    if (interrupts && rtl_->irq()) verican_irq_handler(&dev);
  }

 private:
  static DriverNode &self(void *context) { return *static_cast<DriverNode *>(context); }
  static std::uint32_t read(void *context, std::uint32_t offset) {
    return self(context).rtl_->read32(offset);
  }
  static void write(void *context, std::uint32_t offset, std::uint32_t value) {
    self(context).rtl_->write32(offset, value);
  }
  static void post(void *context, std::uint32_t offset, std::uint32_t value) {
    self(context).rtl_->master().submit({.address = offset, .write = true, .data = value});
  }
  static void on_sent(void *user, verican_t *, const verican_tx_event_t *event) {
    self(user).events.push_back(*event);
    if (self(user).when_sent) self(user).when_sent(*event);
  }
  static void on_state(void *user, verican_t *, verican_state_t state) {
    self(user).states.push_back(state);
  }

  std::unique_ptr<RtlNode> rtl_;
  std::vector<verican_frame_t> ring_ = std::vector<verican_frame_t>(128);
};

/// A bus of such nodes, all with one ideal clock.
class DriverBus {
 public:
  explicit DriverBus(unsigned nodes, unsigned num_mb = 64, const ClockConfig &clock = {})
      : DriverBus{nodes, CoreBuild{.num_mb = num_mb}, clock} {}
  DriverBus(unsigned nodes, const CoreBuild &build, const ClockConfig &clock = {}) {
    for (unsigned n = 0; n < nodes; ++n) {
      nodes_.push_back(std::make_unique<DriverNode>("node" + std::to_string(n), clock, build));
      bus.add(nodes_.back()->rtl());
    }
  }
  DriverNode &operator[](unsigned n) { return *nodes_[n]; }

  /// Runs the bus and serves the interrupts for `duration` ps.
  void run(Time duration) {
    const Time end = bus.now() + duration;
    while (bus.now() < end) step();
  }
  /// Until `done()`; false if `limit` ps passed first.
  bool run_until(const std::function<bool()> &done, Time limit = 100 * kMillisecond) {
    const Time end = bus.now() + limit;
    while (!done()) {
      if (bus.now() >= end) return false;
      step();
    }
    return true;
  }

  Bus bus;

 private:
  void step() {
    bus.step();
    for (const auto &node : nodes_) node->serve();
  }

  std::vector<std::unique_ptr<DriverNode>> nodes_;
};

}  // namespace vericansim

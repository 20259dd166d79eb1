// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockedRemote: a node without a processor that has a clock, whole in one model, on a bus; and
// ClockBus, with a host that is the master of time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Vcan_remote_clock.h"
#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "model/remote_model.hpp"
#include "node/core_node.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/user_access.hpp"
#include "remote/unit_bus.hpp"
#include "time/tsyn_frames.hpp"
#include "verilated.h"

namespace vericansim {

/// Profile standard with TimeSync, 8 MHz: 8 clocks a bit, pps_o with each millisecond, KI for 100
/// pairs a second. What user logic sees at its pins is remembered. After the constructor it has
/// been reset and its RAM is clear; it joins the bus at start().
class ClockedRemote : public Node {
 public:
  ClockedRemote(unsigned number, const ClockConfig &clock)
      : Node{"clocked" + std::to_string(number), clock} {
    top_.eval();
    top_.node_i = static_cast<std::uint8_t>(number);
    top_.can_rx_i = 1;
    reset();
    for (int i = 0; i < 4200 && top_.usr_ready_o == 0; ++i) rising_edge(top_, top_.clk_i);
    drive(static_cast<Level>(top_.can_tx_o));
  }
  ~ClockedRemote() override {
    Verilated::threadContextp(&context_);
    top_.final();
  }

  /// A hard reset, in no time.
  void reset() {
    top_.rst_ni = 0;
    for (int i = 0; i < 4; ++i) rising_edge(top_, top_.clk_i);
    top_.rst_ni = 1;
    top_.eval();
  }
  void start() { top_.start_i = 1; }
  void clock(Level rx) override {
    const bool high = top_.pps_o != 0;
    const bool taken = access_.has_value() && top_.usr_ready_o != 0;
    show_access(top_, access_ ? &*access_ : nullptr);
    top_.can_rx_i = static_cast<std::uint8_t>(rx);
    rising_edge(top_, top_.clk_i);
    drive(static_cast<Level>(top_.can_tx_o));
    const Time now = bus()->now();
    if (!high && top_.pps_o != 0) pulses.push_back(now);
    if (top_.apply_o) applied.push_back(now);
    top_.time_take_i = 0;
    if (taken) data_ = top_.usr_rdata_o;
    if (taken) access_.reset();
  }
  [[nodiscard]] std::uint64_t trace() const override { return top_.trace_o; }

  /// A read of user logic: it is begun, and the data are there when it is done.
  void read(unsigned word) { access_ = UserAccess{false, 0, word, 0}; }
  [[nodiscard]] bool reading() const { return access_.has_value(); }
  [[nodiscard]] std::uint32_t data() const { return data_; }
  /// time_take_i in the next clock.
  void take_time() { top_.time_take_i = 1; }
  [[nodiscard]] std::uint64_t taken() const { return top_.time_o; }
  [[nodiscard]] unsigned time_state() const { return top_.time_state_o; }
  [[nodiscard]] RemoteState state() const { return static_cast<RemoteState>(top_.state_o); }

  std::vector<Time> pulses;   ///< rising edges of pps_o
  std::vector<Time> applied;  ///< pulses of apply_o

 private:
  SerialContext context_;
  Vcan_remote_clock top_{&context_, "clocked"};
  std::optional<UserAccess> access_;
  std::uint32_t data_ = 0;
};

/// When the frame on the bus began.
class FrameStart : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kLevels; }
  void on_level(Time at, Level level) override {
    if (armed && level == Level::kDominant) start = at;
    armed = armed && level != Level::kDominant;
  }
  bool armed = false;
  Time start = 0;
};

/// Nodes 3, 4, .. and a host that is the master of time: its clock is the simulation's.
class ClockBus {
 public:
  static constexpr Time kBit = UnitBus::kBit;
  static constexpr std::uint64_t kEpoch = 1'700'000'000'000'000'000;  ///< ns, when it begins
  static constexpr unsigned kSyncId = 0x420;

  /// One node for each error of its clock, ppm.
  explicit ClockBus(const std::vector<double> &errors) {
    bus.add(host);
    bus.add(start_);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      ClockConfig clock = UnitBus::clock();
      clock.error_ppm = errors[i];
      clock.phase = static_cast<Time>(41'000 * i);
      nodes.push_back(std::make_unique<ClockedRemote>(3 + static_cast<unsigned>(i), clock));
      bus.add(*nodes.back());
    }
    host.start();
    bus.run_for(20 * kBit);
    for (const auto &node : nodes) node->start();
    bus.run_for(1000 * kBit);  // STATUS of each (BOOT)
    host.received().clear();
  }
  ~ClockBus() { bus.remove(start_); }

  /// The master's time, ns, at `at`.
  [[nodiscard]] static double master(Time at) {
    return static_cast<double>(kEpoch % 1'000'000'000) + static_cast<double>(at) / 1000;
  }

  /// A frame of the host, whole; the time of its first bit.
  Time send(const Frame &frame) {
    start_.armed = true;
    host.request(frame);
    bus.run_for(180 * kBit);
    return start_.start;
  }
  /// SYNC, and FUP behind it; FUP is over 360 bits later.
  void pair() {
    const Frame sync = at_sync_id(pairs_.sync(epoch + bus.now() / 1000));
    const Time began = send(sync);
    const auto reference = static_cast<Time>(reference_bit(encode_unacknowledged(sync).bits));
    (void)send(at_sync_id(pairs_.follow_up(epoch + (began + reference * kBit) / 1000)));
  }
  /// Runs until `until`.
  void run(Time until) { bus.run_until(until); }
  /// What node `number` answers to a READ; empty: nothing.
  std::vector<std::uint8_t> read(unsigned number, unsigned address, std::uint8_t n) {
    host.received().clear();
    Frame frame{.id = number << 7 | 0x78, .dlc = 3};
    frame.data = {static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(address >> 8), n};
    (void)send(frame);
    bus.run_for(180 * kBit);
    for (const Frame &answer : host.received())
      if (answer.id == (0x400 | frame.id))
        return {answer.data.begin() + 2, answer.data.begin() + answer.dlc};
    return {};
  }
  /// A word of the map as user logic of node i reads it.
  std::uint32_t word(std::size_t i, unsigned address) {
    nodes[i]->read(address / 4);
    while (nodes[i]->reading()) bus.run_for(kBit);
    return nodes[i]->data();
  }

  std::uint64_t epoch = kEpoch;  ///< of the master: ns, when the simulation began
  CoreNode host{"host", {.timing = UnitBus::timing()}, UnitBus::clock()};
  std::vector<std::unique_ptr<ClockedRemote>> nodes;
  Bus bus;

 private:
  static Frame at_sync_id(Frame frame) {
    frame.id = kSyncId;
    return frame;
  }
  TsynPairs pairs_;
  FrameStart start_;
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusNodeOf: an RtlNode with any Verilated build of a wrapper, on whatever bus. Include the model's
// header and that of its root before.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "node/bus_pins.hpp"
#include "node/model_context.hpp"
#include "node/model_pins.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {

/// `Model`: the whole core in one model, clocked in every clock; `Pins`: of its bus, bus_pins.hpp.
template <typename Model, typename Pins>
class BusNodeOf final : public RtlNode {
 public:
  using Master = typename Pins::Master;

  BusNodeOf(std::string name, const ClockConfig &clock, unsigned num_mb)
      : RtlNode{std::move(name), clock, num_mb}, bus_{[this] { disturbed(); }} {
    take_master(bus_);
    reset();
  }

  /// The master, with what it has beyond a BusMaster.
  [[nodiscard]] Master &bus_master() { return bus_; }
  /// The pins, for tests of the wrapper itself.
  [[nodiscard]] Model &model() { return top_; }

  void reset() override {
    disturbed();
    bus_.reset();
    Pins::show(top_, bus_.request());
    top_.can_rx_i = 1;
    Pins::reset(top_, true);
    for (int i = 0; i < 4; ++i) edge();
    Pins::reset(top_, false);
    edge();
    drive(static_cast<Level>(top_.can_tx_o));
  }

  void clock(Level rx) override {
    top_.can_rx_i = static_cast<std::uint8_t>(rx);
    if (bus_.active()) {
      Pins::show(top_, bus_.request());
      settle();
      const auto response = Pins::seen(top_);
      rise();
      bus_.clock(response);
      if (!bus_.active()) Pins::show(top_, bus_.request());
    } else {
      edge();
    }
    drive(static_cast<Level>(top_.can_tx_o));
    after_edge();
  }

  [[nodiscard]] std::uint64_t trace() const override { return top_.trace_o; }
  [[nodiscard]] std::uint8_t irq_lines() const override { return model_irq_lines(top_); }

  void request_stop(bool stop) override {
    disturbed();
    top_.stop_req_i = stop;
  }

  /// Only while no transfer is under way; std::logic_error otherwise.
  [[nodiscard]] AhbResult peek(const AhbTransfer &transfer) override {
    if (bus_.active()) throw std::logic_error(name() + ": a transfer is under way");
    using Root = std::remove_reference_t<decltype(*top_.rootp)>;
    auto before = std::make_unique<unsigned char[]>(sizeof(Root));
    std::memcpy(before.get(), static_cast<const void *>(top_.rootp), sizeof(Root));
    Master probe{{}};
    AhbTransfer read = transfer;
    read.write = false;
    const BusMaster::Ticket ticket = probe.submit(read);
    while (!probe.done(ticket)) {
      Pins::show(top_, probe.request());
      settle();
      const auto response = Pins::seen(top_);
      rise();
      probe.clock(response);
    }
    std::memcpy(static_cast<void *>(top_.rootp), before.get(), sizeof(Root));
    return probe.result(ticket);
  }

 private:
  // The falling edge, with the inputs as they are: nothing in the design is clocked by it.
  void settle() {
    Pins::clock(top_) = 0;
    top_.eval();
  }
  void rise() {
    Pins::clock(top_) = 1;
    top_.eval();
  }
  void edge() {
    settle();
    rise();
  }

  SerialContext context_;
  Model top_{&context_, "core"};
  ModelContext model_context_{context_};
  Master bus_;
};

}  // namespace vericansim

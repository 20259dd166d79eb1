// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlNodeOf: an RtlNode with any Verilated build of can_ahb. Include the model's header and that of
// its root before.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "node/model_pins.hpp"
#include "node/quiet_engine.hpp"
#include "node/rtl_node.hpp"
#include "node/split_core.hpp"

namespace vericansim {

/// What runs several times a bit is flattened: as calls, its many small functions cost a tenth of
/// the simulator's speed.
///
/// `HostModel`: can_ahb around a hollow engine, of any parameters; `Ports`, `Engine`: see
/// SplitCore.
template <typename HostModel, typename Ports = AhbPorts, typename Engine = Vcan_core>
class RtlNodeOf final : public RtlNode {
 public:
  RtlNodeOf(std::string name, const ClockConfig &clock, unsigned num_mb)
      : RtlNode{std::move(name), clock, num_mb} {
    reset();
  }

  void reset() override {
    disturbed();
    quiet_.disturbed();
    ahb().reset();
    show_request(core_.host(), ahb().request());
    core_.host().hready = 1;
    core_.engine().can_rx_i = 1;
    core_.reset(true);
    for (int i = 0; i < 4; ++i) core_.edge();
    core_.reset(false);
    core_.settle();
    core_.edge();
    drive(static_cast<Level>(core_.engine().can_tx_o));
  }

  [[gnu::flatten]] void clock(Level rx) override {
    const bool active = ahb().active();
    if (!active && quiet_.crosses_boundary(core_.engine()))
      return count(rx, [&] { quiet_.cross_boundary(core_.engine(), rx); });
    if (!active && quiet_.synchronises(core_.engine()))
      return count(rx, [&] { quiet_.synchronise(core_.engine(), rx); });
    core_.engine().can_rx_i = static_cast<std::uint8_t>(rx);
    if (active) {
      transfer_cycle();
    } else {
      core_.edge();
    }
    quiet_.clocked(core_.engine());
    if (core_.take_engine_disturbed()) quiet_.disturbed();
    drive(static_cast<Level>(core_.engine().can_tx_o));
    after_edge(core_.take_host_moved());
  }

  [[nodiscard, gnu::flatten]] std::uint64_t quiet() const override {
    if (ahb().active() || !core_.resting()) return 0;
    const std::uint64_t edges = std::min(
        std::min(quiet_.edges(core_.engine(), watched()), edges_to_waiter()), core_.rest());
    return edges != 0 && core_.wakes() ? 0 : edges;
  }

  [[gnu::flatten]] void pass(std::uint64_t edges) override {
    quiet_.pass(core_.engine(), edges);
    core_.pass(edges);
    passed(edges);
  }

  [[gnu::flatten]] void clock_lightly(Level rx) override {
    if (ahb().active() || !quiet_.counts(core_.engine())) return clock(rx);
    count(rx, [&] { quiet_.clock_lightly(core_.engine(), rx); });
  }

  // An idle bit is like the one before it, but for TIMER and the time unit.
  [[nodiscard]] std::uint64_t skip_period() const override { return clocks_of_bit(core_.engine()); }

  [[nodiscard]] std::uint64_t skip_most() const override {
    if (ahb().active() || !core_.resting() || core_.wakes()) return 0;
    return std::min({edges_of_time(core_.engine()), edges_to_waiter(), core_.rest()});
  }

  void skipped(std::uint64_t edges) override {
    pass_time(core_.engine(), edges);
    core_.engine().timer_o += static_cast<std::uint16_t>(edges / skip_period());
    core_.pass(edges);
    left_out(edges);
  }

  [[nodiscard]] std::uint64_t trace() const override {
    catch_up();
    return core_.engine().trace_o;
  }

  [[nodiscard]] std::uint8_t irq_lines() const override {
    return model_irq_lines(std::as_const(core_).host());
  }

  [[nodiscard]] bool irq_time() const override {
    if constexpr (kHasTimeUnit<Engine>) {
      catch_up();
      return std::as_const(core_).host().irq_time_o != 0;
    } else {
      return false;
    }
  }

  [[nodiscard]] bool time_out() const override {
    if constexpr (kHasTimeUnit<Engine>) {
      catch_up();
      return time_out_of(core_.engine());
    } else {
      return false;
    }
  }

  [[nodiscard]] std::uint64_t time_of_clock() const override {
    if constexpr (kHasTimeUnit<Engine>) {
      catch_up();
      return core_.engine().time();
    } else {
      return RtlNode::time_of_clock();
    }
  }

  void external(bool level) override {
    if constexpr (kHasTimeUnit<Engine>) {
      disturbed();
      core_.host().ext_i = level;
      core_.touch();
    }
  }

  void request_stop(bool stop) override {
    disturbed();
    core_.host().stop_req_i = stop;
    core_.touch();
  }

  [[nodiscard]] AhbResult peek(const AhbTransfer &transfer) override {
    catch_up();
    const auto before = core_.save();
    AhbMaster probe;
    AhbTransfer read = transfer;
    read.write = false;
    const AhbMaster::Ticket ticket = probe.submit(read);
    while (!probe.done(ticket)) {
      AhbRequest request = probe.request();
      request.hwdata = ahb().request().hwdata;  // of the transfer under way
      probe.clock(cycle(request));
    }
    core_.restore(before);
    return probe.result(ticket);
  }

 private:
  // An edge at which the engine does no more than `of_engine`, unless the host side asks for more.
  template <typename OfEngine>
  void count(Level rx, OfEngine &&of_engine) {
    core_.engine().can_rx_i = static_cast<std::uint8_t>(rx);
    const bool counted = core_.edge(std::forward<OfEngine>(of_engine));
    if (!counted) quiet_.clocked(core_.engine());
    if (core_.take_engine_disturbed()) quiet_.disturbed();
    drive(static_cast<Level>(core_.engine().can_tx_o));
    after_edge(core_.take_host_moved());
  }

  // HREADYOUT, HRESP and HRDATA are read as they have settled with this cycle's request.
  AhbResponse cycle(const AhbRequest &request) {
    HostModel &top = core_.host();
    show_request(top, request);
    top.hready = top.hreadyout;
    core_.settle();
    if (top.hready != top.hreadyout) {
      top.hready = top.hreadyout;
      core_.settle();
    }
    const AhbResponse response{top.hrdata, top.hreadyout != 0, top.hresp != 0};
    core_.busy_edge();
    return response;
  }

  void transfer_cycle() {
    ahb().clock(cycle(ahb().request()));
    if (!ahb().active()) {
      show_request(core_.host(), ahb().request());
      core_.host().hready = 1;
      core_.touch();
    }
  }

  SplitCore<HostModel, Ports, Engine> core_;
  QuietEngine quiet_;
};

}  // namespace vericansim

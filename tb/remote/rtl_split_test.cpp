// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteNode, engine and the rest as two models, is the whole can_remote in every clock.
#include <gtest/gtest.h>

#include "Vcan_remote_whole.h"
#include "Vcan_remote_whole___024root.h"
#include "bus/faults.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "remote/random_host.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

/// A RemoteNode and the whole model on the same pins.
class TwinRemote : public Node {
 public:
  TwinRemote() : Node{"twin", UnitBus::clock()}, split_{rtl_unit(3)} {
    whole_.eval();
    whole_.rootp->can_remote__DOT__serial = 0xCAFE1234;
    whole_.node_i = 3;
    whole_.can_rx_i = 1;
    whole_.rst_ni = 0;
    for (int i = 0; i < 4; ++i) edge();
    whole_.rst_ni = 1;
    whole_.eval();
    for (int i = 0; i < 4200 && whole_.usr_ready_o == 0; ++i) edge();
    split_->on_ms = [this] { ms_ = true; };
  }
  ~TwinRemote() override {
    split_.reset();
    Verilated::threadContextp(&context_);  // as in SplitCore
    whole_.final();
  }

  void start() {
    split_->start();
    whole_.start_i = 1;
  }
  void access(const UserAccess &access) {
    access_ = access;
    split_->access(access);
  }
  void hold(bool on) {
    split_->hold(on);
    whole_.usr_hold_i = on;
  }
  void clock(Level rx) override {
    show_access(whole_, split_->waiting() != 0 ? &access_ : nullptr);
    whole_.can_rx_i = static_cast<std::uint8_t>(rx);
    ms_ = false;
    split_->clock(rx);
    whole_.rootp->can_remote__DOT__u_tick__DOT__ms_v = ms_;
    edge();
    drive(static_cast<Level>(whole_.can_tx_o));
    differing += split_->trace() != whole_.trace_o || split_->tx() != tx() ||
                 split_->ready() != (whole_.usr_ready_o != 0) ||
                 static_cast<unsigned>(split_->state()) != whole_.state_o;
    ++clocks;
  }
  [[nodiscard]] bool busy() const { return split_->waiting() != 0; }
  [[nodiscard]] std::uint64_t trace() const override { return whole_.trace_o; }

  unsigned differing = 0;
  unsigned clocks = 0;

 private:
  void edge() { rising_edge(whole_, whole_.clk_i); }

  SerialContext context_;
  Vcan_remote_whole whole_{&context_, "whole"};
  std::unique_ptr<RemoteNode> split_;
  UserAccess access_;
  bool ms_ = false;
};

// Random commands, noise, accesses and holds of user logic.
TEST(RtlSplit, IsTheWholeInEveryClock) {
  Bus bus;
  CoreNode host{"host", {.timing = UnitBus::timing()}, UnitBus::clock()};
  TwinRemote twin;
  bus.add(host);
  bus.add(twin);
  NoiseConfig noise;
  noise.per_bit = 0.002;
  NoiseFault fault{noise};
  bus.add(fault);
  host.start();
  twin.start();
  bus.run_for(50 * UnitBus::kBit);
  RandomHost dice{1};
  for (unsigned i = 0; i < 1000; ++i) {
    host.request(dice.frame());
    if (!twin.busy())
      twin.access({dice.once_in(2), dice.upto(16), dice.upto(1024), dice.upto(~0U)});
    twin.hold(dice.once_in(8));
    bus.run_for((60 + dice.upto(150)) * UnitBus::kBit);
  }
  EXPECT_EQ(twin.differing, 0U);
  EXPECT_GT(twin.clocks, 1'000'000U);
}

}  // namespace
}  // namespace vericansim

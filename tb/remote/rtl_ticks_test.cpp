// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A host side that does not wake for sample points which it does not mind (TickRest) has, whenever
// somebody looks, the same bits in every member of the model as one that never rests.
#include "node/tick_rest.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "Vcan_core_bytes.h"
#include "Vcan_core_bytes___024root.h"
#include "Vcan_remote_full_3.h"
#include "Vcan_remote_full_3___024root.h"
#include "harness/model_members.hpp"
#include "node/quiet_engine.hpp"
#include "node/split_core.hpp"
#include "node/user_access.hpp"
#include "remote/random_host.hpp"
#include "remote/unit_bus.hpp"

namespace vericansim {
namespace {

using Model = Vcan_remote_full_3;
using Core = SplitCore<Model, RemotePorts, Vcan_core_bytes>;

/// Twice the same node, once with a host side that is clocked each time.
class TwinTicks : public Node {
 public:
  TwinTicks() : Node{"twin", UnitBus::clock()} {
    each([](Core &core) {
      auto &engine = core.engine();
      const BitTiming timing = UnitBus::timing();
      engine.presdiv_i = timing.prescaler - 1;
      engine.propseg_i = timing.prop - 1;
      engine.pseg1_i = timing.ps1 - 1;
      engine.pseg2_i = timing.ps2 - 1;
      engine.rjw_i = timing.sjw - 1;
      engine.can_rx_i = 1;
      core.host().node_i = 3;
      core.host().rootp->can_remote__DOT__serial = 0xCAFE1234;
      core.host().start_i = 1;
      core.reset(true);
      for (int i = 0; i < 4; ++i) core.edge();
      core.reset(false);
      core.settle();
      for (int i = 0; i < 4200; ++i) core.edge();
    });
    members_.emplace(*short_.host().rootp, *full_.host().rootp);
  }

  void clock(Level rx) override {
    disturb();
    const bool ignored = short_.ignores_ticks() && full_.engine().tick_o != 0;
    each([rx](Core &core) { core.engine().can_rx_i = static_cast<std::uint8_t>(rx); });
    full_.touch();
    each([](Core &core) { core.edge(); });
    ticks_ignored += ignored && short_.resting();
    const bool looked = dice_.once_in(16);
    if (looked) look();
    drive(static_cast<Level>(full_.engine().can_tx_o));
    differing += short_.engine().trace_o != full_.engine().trace_o;
  }
  [[nodiscard]] std::uint64_t trace() const override { return full_.engine().trace_o; }

  unsigned differing = 0;
  unsigned ticks_ignored = 0;

 private:
  template <typename Do>
  void each(Do &&act) {
    act(short_);
    act(full_);
  }

  // User logic, events and milliseconds, at any clock.
  void disturb() {
    if (!dice_.once_in(40)) return;
    const UserAccess access{dice_.once_in(2), dice_.upto(16), dice_.upto(1024), dice_.upto(~0U)};
    const bool accesses = dice_.once_in(3), holds = dice_.once_in(4), ms = dice_.once_in(8);
    const unsigned event = dice_.once_in(4) ? 1U << dice_.upto(8) : 0;
    each([&](Core &core) {
      core.touch();
      show_access(core.host(), accesses ? &access : nullptr);
      core.host().usr_hold_i = holds;
      core.host().event_i = static_cast<std::uint8_t>(event);
      core.host().rootp->can_remote__DOT__u_tick__DOT__ms_v = ms;
    });
  }

  // At once, between the two clocks of a pulse, too; then all with the engine's outputs as they
  // are.
  void look() {
    each([](Core &core) { core.touch(); });
    const auto &mine = *short_.host().rootp, &other = *full_.host().rootp;
    differing +=
        mine.can_remote__DOT__u_step__DOT__tick_q != other.can_remote__DOT__u_step__DOT__tick_q;
    each([](Core &core) { core.edge(); });
    differing += !members_->same(*short_.host().rootp, *full_.host().rootp);
  }

  RandomHost dice_{3};
  Core short_, full_;
  std::optional<ModelMembers<Core::Root>> members_;
};

TEST(RtlTicks, AreSeenOrNotMinded) {
  Bus bus;
  CoreNode host{"host", {.timing = UnitBus::timing()}, UnitBus::clock()};
  TwinTicks twin;
  bus.add(host);
  bus.add(twin);
  host.start();
  RandomHost dice{1};
  for (unsigned i = 0; i < 80; ++i) {
    host.request(dice.frame());
    bus.run_for((60 + dice.upto(250)) * UnitBus::kBit);
  }
  EXPECT_EQ(twin.differing, 0U);
  EXPECT_TRUE(kPlainEdges || twin.ticks_ignored > 500U);
}

// A member that a change of the RTL has renamed or removed turns a short cut off, silently.
TEST(RtlTicks, ShortCutsAreInForce) {
  if (kPlainEdges) GTEST_SKIP() << "models without short cuts";
  EXPECT_TRUE((TickRest<Core::Root, RemotePorts>::in_force()));
  EXPECT_TRUE(QuietEngine::in_force<Vcan_core_bytes>());
}

}  // namespace
}  // namespace vericansim

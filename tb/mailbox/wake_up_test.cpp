// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Stop mode and wake-up by the bus (flexcan.md 2.9; FX-2.9.a, MO-14).
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kNotRdy = 1u << 27, kWakMsk = 1u << 26, kSlfWak = 1u << 22;
constexpr std::uint32_t kWakSrc = 1u << 19, kDoze = 1u << 18, kWakInt = 1u << 0;
constexpr unsigned kBit = 8;  // clocks
constexpr Time kClock = 125 * kNanosecond;
constexpr unsigned kFilter = 6;  // default of WakeFilter, docs/integration.md

// Node 0 sleeps, nodes 1 and 2 keep the bus alive.
class WakeUp : public ::testing::Test {
 protected:
  WakeUp() : rig_{3, 16} {
    for (unsigned n = 0; n < 3; ++n) rig_.configure(n);
    for (unsigned n = 0; n < 3; ++n) rig_.go(n);
  }
  std::uint32_t mcr() { return rig_.read(0, reg::kMcr); }
  std::uint32_t modes() { return mcr() & (kNotRdy | reg::kMcrFrzAck | reg::kMcrLpmAck); }
  bool wak_int() { return (rig_.read(0, reg::kEsr) & kWakInt) != 0; }
  void set_mcr(std::uint32_t bits) { rig_.write(0, reg::kMcr, mcr() | bits); }
  // WAK_SRC is written in freeze mode only.
  void use_filter() {
    ASSERT_TRUE(rig_.freeze(0));
    set_mcr(kWakSrc);
    rig_.go(0);
  }
  void stop() {
    rig_.node(0).request_stop(true);
    ASSERT_TRUE(rig_.run_until([&] { return (mcr() & reg::kMcrLpmAck) != 0; }, 2 * kBit + 8));
  }
  // Dominant at node 0 for a number of clocks from now on.
  void pulse(unsigned clocks) {
    const Time now = rig_.bus().now();
    auto &fault = pulses_.emplace_back(std::make_unique<LevelFault>(
        0, Effect::kDominant, Window{now + kClock, now + (clocks + 1) * kClock}));
    rig_.bus().add(*fault);
    rig_.run(clocks + 6);
  }
  MailboxRig rig_;
  std::vector<std::unique_ptr<LevelFault>> pulses_;
};

TEST_F(WakeUp, StopIsALowPowerModeAndEndsWithTheRequest) {  // FX-MCR.LPM_ACK, FX-MCR.NOT_RDY
  stop();
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
  const std::uint32_t timer = rig_.read(0, reg::kTimer);
  rig_.run(20 * kBit);
  EXPECT_EQ(rig_.read(0, reg::kTimer), timer) << "TIMER stands (section 6)";
  rig_.node(0).request_stop(false);
  rig_.run(2);
  EXPECT_EQ(modes(), 0u);
  EXPECT_FALSE(wak_int());
}

TEST_F(WakeUp, StopFromFreezeModeLeadsBackToIt) {
  ASSERT_TRUE(rig_.freeze(0));
  rig_.node(0).request_stop(true);
  rig_.run(2);
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
  rig_.node(0).request_stop(false);
  rig_.run(2);
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrFrzAck);
}

TEST_F(WakeUp, StopLetsTheOwnFrameEndAndDropsAForeignOne) {  // FX-2.1.a
  rig_.put_rx(0, 3, {.id = 0x155}, {});
  rig_.put_tx(0, 8, {.id = 0x155, .dlc = 8});
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(0) == Field::kData; }, 400));
  rig_.node(0).request_stop(true);
  rig_.run(2 * kBit);
  EXPECT_EQ(modes(), 0u);
  EXPECT_TRUE(rig_.run_until([&] { return (mcr() & reg::kMcrLpmAck) != 0; }, 150 * kBit));
  EXPECT_EQ(rig_.flags(0), 1u << 8);
  rig_.node(0).request_stop(false);
  rig_.go(0);
  rig_.put_tx(1, 8, {.id = 0x155, .dlc = 8});
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(0) == Field::kData; }, 400));
  stop();
  EXPECT_TRUE(rig_.wait_flag(1, 8));
  EXPECT_EQ(rig_.flags(0), 1u << 8);
  EXPECT_EQ(rig_.read(1, reg::kEcr), 0u);
}

TEST_F(WakeUp, AnEdgeWakesWithSlfWak) {  // FX-MCR.SLF_WAK, FX-ESR1.WAK_INT
  rig_.put_rx(0, 3, {.id = 0x155});
  set_mcr(kSlfWak);
  stop();
  rig_.run(100);
  EXPECT_FALSE(wak_int()) << "no edge yet";
  rig_.put_tx(1, 8, {.id = 0x155, .dlc = 2, .data = {1, 2}});
  ASSERT_TRUE(rig_.run_until([&] { return rig_.field(1) == Field::kId; }, 400));
  rig_.run(kBit);
  EXPECT_EQ(modes(), 0u) << "though the request is still there";
  EXPECT_TRUE(wak_int());
  ASSERT_TRUE(rig_.wait_flag(1, 8));
  EXPECT_EQ(rig_.flags(0), 0u) << "the waking frame is not received (MO-14)";
  EXPECT_EQ(rig_.read(1, reg::kEcr) | rig_.read(0, reg::kEcr), 0u);
  rig_.run(12 * kBit);
  rig_.put_tx(2, 8, {.id = 0x155, .dlc = 2, .data = {3, 4}});
  ASSERT_TRUE(rig_.wait_flag(0, 3));
  EXPECT_EQ(mb_frame(rig_.get(0, 3)), (Frame{.id = 0x155, .dlc = 2, .data = {3, 4}}));
}

TEST_F(WakeUp, WithoutSlfWakTheBusIsIgnored) {
  set_mcr(kWakMsk);
  stop();
  rig_.put_tx(1, 8, {.id = 0x155});
  EXPECT_TRUE(rig_.wait_flag(1, 8));
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
  EXPECT_FALSE(wak_int());
}

TEST_F(WakeUp, TheRequestCountsAgainAfterItWasAway) {
  set_mcr(kSlfWak);
  stop();
  pulse(1);
  EXPECT_EQ(modes(), 0u);
  rig_.run(50 * kBit);
  EXPECT_EQ(modes(), 0u);
  rig_.node(0).request_stop(false);
  rig_.run(1);
  stop();
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
}

TEST_F(WakeUp, InterruptIsGatedByWakMskAndHeld) {  // FX-5.WAKE, FX-MCR.WAK_MSK
  set_mcr(kSlfWak);
  stop();
  pulse(1);
  EXPECT_TRUE(wak_int());
  EXPECT_EQ(rig_.node(0).irq_lines(), 0);
  set_mcr(kWakMsk);
  rig_.run(2);
  EXPECT_EQ(rig_.node(0).irq_lines(), kIrqAll | kIrqWake);
  rig_.write(0, reg::kEsr, ~kWakInt);
  rig_.run(100);
  EXPECT_EQ(rig_.node(0).irq_lines(), kIrqAll | kIrqWake);
  rig_.write(0, reg::kEsr, kWakInt);
  rig_.run(2);
  EXPECT_FALSE(wak_int());
  EXPECT_EQ(rig_.node(0).irq_lines(), 0);
}

TEST_F(WakeUp, AWriteThatClearsInTheClockOfTheEdgeLosesNothing) {  // section 1.5, for ESR1
  set_mcr(kSlfWak | kWakMsk);
  for (unsigned offset = 0; offset < 16; ++offset) {
    stop();
    rig_.node(0).ahb().submit(
        {.address = reg::kEsr, .write = true, .data = kWakInt, .pause = offset});
    const Time now = rig_.bus().now();
    pulses_.push_back(std::make_unique<LevelFault>(0, Effect::kDominant,
                                                   Window{now + 4 * kClock, now + 5 * kClock}));
    rig_.bus().add(*pulses_.back());
    unsigned high = 0;
    for (unsigned i = 0; i < 30; ++i) {
      rig_.run(1);
      high += (rig_.node(0).irq_lines() & kIrqWake) != 0;
    }
    EXPECT_GT(high, 0u) << offset;
    rig_.write(0, reg::kEsr, kWakInt);
    rig_.node(0).request_stop(false);
    rig_.run(2);
  }
}

TEST_F(WakeUp, TheFilterWantsADominantLevelForSixClocks) {  // FX-MCR.WAK_SRC
  use_filter();
  set_mcr(kSlfWak);
  for (unsigned clocks = 1; clocks <= 2 * kFilter; ++clocks) {
    stop();
    pulse(clocks);
    EXPECT_EQ(wak_int(), clocks >= kFilter) << clocks;
    EXPECT_EQ(modes() == 0, clocks >= kFilter) << clocks;
    rig_.write(0, reg::kEsr, kWakInt);
    rig_.node(0).request_stop(false);
    rig_.run(12 * kBit);
  }
}

TEST_F(WakeUp, AnyFrameWakesThroughTheFilter) {
  use_filter();
  set_mcr(kSlfWak);
  stop();
  rig_.put_tx(1, 8, {.id = 0x555});  // no two dominant bits in a row in the identifier
  EXPECT_TRUE(rig_.wait_flag(1, 8));
  EXPECT_TRUE(wak_int());
}

TEST_F(WakeUp, ABusThatIsDominantWhenStopBeginsIsNoEdge) {
  set_mcr(kSlfWak);
  const Time now = rig_.bus().now();
  LevelFault stuck{0, Effect::kDominant, {now, now + 100 * kBit * kClock}};
  rig_.bus().add(stuck);
  rig_.run(20 * kBit);
  stop();
  rig_.run(20 * kBit);
  EXPECT_FALSE(wak_int());
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
  rig_.run(100 * kBit);
  pulse(1);
  EXPECT_TRUE(wak_int());
}

TEST_F(WakeUp, NotInDisableMode) {
  set_mcr(kSlfWak | reg::kMcrMdis);
  rig_.node(0).request_stop(true);
  rig_.run(4 * kBit);
  pulse(10);
  EXPECT_FALSE(wak_int());
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
  rig_.write(0, reg::kMcr, mcr() & ~reg::kMcrMdis);
  rig_.run(2);
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck) << "now in stop mode";
  pulse(1);
  EXPECT_TRUE(wak_int());
}

TEST_F(WakeUp, DisableModeDuringStop) {
  set_mcr(kSlfWak);
  stop();
  set_mcr(reg::kMcrMdis);
  rig_.node(0).request_stop(false);
  rig_.run(4);
  EXPECT_EQ(modes(), kNotRdy | reg::kMcrLpmAck);
  rig_.write(0, reg::kMcr, mcr() & ~reg::kMcrMdis);
  rig_.run(2);
  EXPECT_EQ(modes(), 0u);
}

TEST_F(WakeUp, SlfWakIsNotWrittenInStopMode) {  // FX-MCR.SLF_WAK
  stop();
  set_mcr(kSlfWak);
  EXPECT_EQ(mcr() & kSlfWak, 0u);
  rig_.node(0).request_stop(false);
  rig_.run(4);
  set_mcr(kSlfWak);
  stop();
  rig_.write(0, reg::kMcr, mcr() & ~kSlfWak);
  EXPECT_EQ(mcr() & kSlfWak, kSlfWak);
}

TEST_F(WakeUp, SoftResetIsNotAcceptedInStopMode) {  // FX-2.3.d
  stop();
  rig_.write(0, reg::kImask1, 0x77);
  set_mcr(reg::kMcrSoftRst);
  rig_.run(10);
  EXPECT_EQ(mcr() & (reg::kMcrSoftRst | reg::kMcrLpmAck), reg::kMcrLpmAck);
  EXPECT_EQ(rig_.read(0, reg::kImask1), 0x77u);
}

TEST_F(WakeUp, ClkSrcIsWrittenInDisableModeOnly) {  // FX-CTRL1.CLK_SRC, FX-9.e2424
  constexpr std::uint32_t kClkSrc = 1u << 13;
  const auto try_it = [&] {
    rig_.write(0, reg::kCtrl, rig_.read(0, reg::kCtrl) ^ kClkSrc);
    return (rig_.read(0, reg::kCtrl) & kClkSrc) != 0;
  };
  EXPECT_FALSE(try_it());
  stop();
  EXPECT_FALSE(try_it());
  rig_.node(0).request_stop(false);
  ASSERT_TRUE(rig_.freeze(0));
  EXPECT_FALSE(try_it());
  set_mcr(reg::kMcrMdis);
  rig_.run(4);
  EXPECT_TRUE(try_it());
  EXPECT_FALSE(try_it());
}

TEST_F(WakeUp, DozeIsStored) {  // FX-MCR.DOZE
  set_mcr(kDoze);
  EXPECT_EQ(mcr() & kDoze, kDoze);
  rig_.run(4 * kBit);
  EXPECT_EQ(modes(), 0u);
}

}  // namespace
}  // namespace vericansim

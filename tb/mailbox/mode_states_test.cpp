// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Every way off the bus from every state that is no frame: each has an exit, in time (flexcan.md
// 2.1 to 2.3, 2.9, 8.2; ERR008341, ERR009595).
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mode_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = ModeRig::kBit;
constexpr unsigned kAccess = 8;
constexpr Time kClock = 125 * kNanosecond;
constexpr unsigned kSubject = ModeRig::kSubject, kPeer = ModeRig::kPeer;
constexpr std::uint32_t kBusOffStatus = 0x20;  // FLT_CONF 1x

// A bus whose level changes with every bit: no six equal bits, no eleven recessive ones.
class RestlessBus : public Fault {
 public:
  RestlessBus(Time from, Time to) : window_{from, to} {}
  Level level(NodeId, Time t, Level level) override {
    if (!window_.contains(t)) return level;
    return ((t - window_.from) / (kBit * kClock)) % 2 == 0 ? Level::kDominant : Level::kRecessive;
  }

 private:
  Window window_;
};

class ModeStates : public ::testing::TestWithParam<Leave> {
 protected:
  const Leave how_ = GetParam();

  static Time now(ModeRig &mode) { return mode.rig().bus().now(); }
  void expect_exit(ModeRig &mode, unsigned bits) {
    mode.ask(how_);
    const unsigned bound = bits * kBit + kAccess;
    ASSERT_LT(mode.left(how_, bound + 1), bound + 1);
    const unsigned before = mode.dominant_clocks();
    mode.run(3 * kBit);
    ASSERT_EQ(mode.dominant_clocks(), before) << "dominant after the acknowledge";
  }
  void expect_return(ModeRig &mode, unsigned data) {
    mode.come_back(how_);
    ASSERT_TRUE(mode.quiet(20000));
    MailboxRig &rig = mode.rig();
    const Frame frame{.id = 0x123, .dlc = 1, .data = {static_cast<std::uint8_t>(data)}};
    for (unsigned n : {kSubject, kPeer}) {
      const unsigned other = n == kSubject ? kPeer : kSubject;
      rig.write(n, reg::kIflag1, ~0u);
      rig.write(other, reg::kIflag1, ~0u);
      rig.put_tx(n, 9, frame);
      ASSERT_TRUE(rig.wait_flag(other, ModeRig::kRxMb));
      ASSERT_EQ(mb_frame(rig.get(other, ModeRig::kRxMb)), frame);
      ASSERT_TRUE(mode.quiet());
    }
  }
  // Brings the subject to bus-off with a bit error at TEC 250.
  void bus_off(ModeRig &mode, bool hold) {
    MailboxRig &rig = mode.rig();
    ASSERT_TRUE(rig.freeze(kSubject));
    rig.write(kSubject, reg::kEcr, 250);
    rig.write(kSubject, reg::kCtrl, kTiming8 | (hold ? reg::kCtrlBoffRec : 0));
    mode.come_back(Leave::kFreeze);
    ASSERT_TRUE(mode.quiet());
    faults_.push_back(std::make_unique<LevelFault>(
        kSubject, Effect::kRecessive, Window{now(mode), now(mode) + 10 * kBit * kClock}));
    rig.bus().add(*faults_.back());
    rig.put_tx(kSubject, 8, {.id = 0x155});
    ASSERT_TRUE(mode.run_until([&] { return rig.field(kSubject) == Field::kBusOff; }, 20 * kBit));
    rig.write(kSubject, reg::mb(8), reg::kCodeTxInactive);
    mode.run(80 * kBit);
    rig.write(kSubject, reg::kEsr, reg::kEsrInterrupts);
  }
  std::vector<std::unique_ptr<Fault>> faults_;
};

TEST_P(ModeStates, Integration) {  // every clock of the eleven bits and the first of idle
  ModeRig mode;
  for (unsigned k = 0; k < 13 * kBit; ++k) {
    SCOPED_TRACE(k);
    ASSERT_TRUE(mode.rig().freeze(kSubject));
    mode.come_back(Leave::kFreeze);
    mode.run(k);
    ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 2));
    mode.come_back(how_);
    mode.run(4);
  }
  expect_return(mode, 1);
}

TEST_P(ModeStates, IntegrationOnABusThatStaysDominant) {  // FX-2.1.e, section 10 item 3
  ModeRig mode;
  ASSERT_TRUE(mode.rig().freeze(kSubject));
  LevelFault stuck{kSubject, Effect::kDominant, {now(mode), now(mode) + 1000 * kBit * kClock}};
  mode.rig().bus().add(stuck);
  mode.come_back(Leave::kFreeze);
  mode.run(20 * kBit);
  ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 2));
  mode.run(1000 * kBit);
  expect_return(mode, 2);
}

// FX-2.1.e: the bus goes dominant for good, before and while a frame is sent or not. An error flag
// is sent whole, what follows it is waiting.
TEST_P(ModeStates, BusStuckDominant) {
  for (const bool transmitter : {false, true}) {
    for (unsigned k = 0; k < 40 * kBit; k += 3) {
      SCOPED_TRACE(std::to_string(k) + (transmitter ? " transmitter" : " receiver"));
      ModeRig mode;
      if (transmitter) mode.rig().put_tx(kSubject, 8, {.id = 0x155, .dlc = 1});
      LevelFault stuck{kAllNodes, Effect::kDominant, {now(mode) + 30 * kClock, kSecond}};
      mode.rig().bus().add(stuck);
      mode.run(k);
      ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 24));
    }
  }
}

// A passive error flag lasts until six equal bits (EF-03), which such a bus never brings.
TEST_P(ModeStates, PassiveOnARestlessBus) {
  for (const bool transmitter : {false, true}) {
    ModeRig mode;
    MailboxRig &rig = mode.rig();
    ASSERT_TRUE(rig.freeze(kSubject));
    rig.write(kSubject, reg::kEcr, transmitter ? 140 : 140 << 8);
    mode.come_back(Leave::kFreeze);
    ASSERT_TRUE(mode.quiet());
    if (transmitter) {
      rig.put_tx(kSubject, 8, {.id = 0x155, .dlc = 8});
      ASSERT_TRUE(mode.run_until([&] { return rig.field(kSubject) == Field::kDlc; }, 40 * kBit));
    }
    RestlessBus restless{now(mode), now(mode) + 500 * kBit * kClock};
    rig.bus().add(restless);
    mode.run(200 * kBit);
    EXPECT_EQ(rig.field(kSubject), Field::kErrFlag) << "the case this test is for";
    ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 4));
  }
}

// FX-9.ERR009595, FX-2.8.a: in every clock of a frame of the others, which goes on undisturbed.
TEST_P(ModeStates, BusOffWhileOthersTalk) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  ASSERT_NO_FATAL_FAILURE(bus_off(mode, true));
  for (unsigned k = 0; k < 64 * kBit; k += how_ == Leave::kSoftReset ? 16 : 1) {
    SCOPED_TRACE(k);
    if (how_ == Leave::kSoftReset && k != 0) {
      ASSERT_NO_FATAL_FAILURE(bus_off(mode, true));
    }
    const std::uint32_t before = rig.read(kPeer, reg::kEcr);
    rig.put_tx(kPeer, 8, {.id = 0x155, .dlc = 1});
    mode.run(k);
    ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 2));
    const std::uint32_t esr = rig.read(kSubject, reg::kEsr);
    EXPECT_EQ(esr & kBusOffStatus, how_ == Leave::kSoftReset ? 0u : kBusOffStatus);
    EXPECT_EQ(esr & reg::kEsrBoffInt, 0u) << "FX-9.e7322";
    mode.come_back(how_);
    ASSERT_TRUE(rig.wait_flag(kPeer, 8));
    EXPECT_EQ(rig.read(kPeer, reg::kEcr), before);
    rig.write(kPeer, reg::kIflag1, ~0u);
    EXPECT_EQ(rig.read(kSubject, reg::kEsr) & reg::kEsrBoffInt, 0u);
    if (HasFailure()) return;
  }
}

// FX-2.3.e: a soft reset ends bus-off; the others leave it as it is.
TEST_P(ModeStates, BusOffIsKeptExceptByASoftReset) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  ASSERT_NO_FATAL_FAILURE(bus_off(mode, true));
  ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 2));
  mode.come_back(how_);
  mode.run(13 * kBit);
  const bool off = how_ != Leave::kSoftReset;
  EXPECT_EQ(rig.read(kSubject, reg::kEsr) & kBusOffStatus, off ? kBusOffStatus : 0u);
  EXPECT_EQ(rig.field(kSubject), off ? Field::kBusOff : Field::kIdle);
  EXPECT_EQ(rig.read(kSubject, reg::kEcr) == 0, !off);
  if (off) {
    rig.write(kSubject, reg::kCtrl, kTiming8);
    ASSERT_TRUE(mode.run_until([&] { return rig.field(kSubject) == Field::kIdle; }, 1500 * kBit));
    EXPECT_EQ(rig.read(kSubject, reg::kEcr), 0u);
  }
}

// FX-2.2.b, FX-2.2.e: a frame that waits for a locked buffer holds nothing up. In freeze mode the
// unlock moves it in at once; a soft reset drops it.
TEST_P(ModeStates, MovePendingToALockedBuffer) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  const Frame first{.id = 0x155, .dlc = 1, .data = {1}}, second{.id = 0x155, .dlc = 1, .data = {2}};
  rig.put_tx(kPeer, 8, first);
  ASSERT_TRUE(rig.wait_flag(kSubject, ModeRig::kRxMb));
  EXPECT_EQ(mb_frame(rig.get(kSubject, ModeRig::kRxMb)), first);  // locks
  rig.clear_flag(kSubject, ModeRig::kRxMb);
  ASSERT_TRUE(mode.quiet());
  rig.put_tx(kPeer, 8, second);
  ASSERT_TRUE(rig.wait_flag(ModeRig::kWitness, ModeRig::kRxMb));
  ASSERT_TRUE(mode.quiet());
  EXPECT_EQ(rig.flags(kSubject), 0u);
  ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 2));
  EXPECT_EQ(rig.flags(kSubject), 0u);
  const bool dropped = how_ == Leave::kSoftReset;
  rig.read(kSubject, reg::kTimer);  // unlocks
  mode.run(20);
  if (how_ == Leave::kDisable || how_ == Leave::kStop) {
    EXPECT_EQ(rig.flags(kSubject), 0u) << "postponed in low power (3.6)";
    mode.come_back(how_);
    mode.run(20);
  }
  EXPECT_EQ(rig.flags(kSubject), dropped ? 0u : 1u << ModeRig::kRxMb);
  EXPECT_EQ(mb_frame(rig.get(kSubject, ModeRig::kRxMb)), dropped ? first : second);
  rig.read(kSubject, reg::kTimer);
  expect_return(mode, 3);
}

// Two or three requests at once, taken back one by one: each leads on to the next.
TEST_P(ModeStates, OnTopOfAnother) {
  for (const Leave first : kAllWays) {
    if (first == how_) continue;
    SCOPED_TRACE("first " + to_string(first));
    ModeRig mode;
    mode.rig().put_tx(kPeer, 8, {.id = 0x155, .dlc = 1});
    mode.run(20 * kBit);
    mode.ask(first);
    mode.run(5);
    mode.ask(how_);
    mode.run(80 * kBit);
    mode.come_back(Leave::kStop);
    mode.run(4);
    mode.come_back(Leave::kFreeze);
    mode.run(4);
    EXPECT_EQ(mode.read(reg::kMcr) & (reg::kMcrFrzAck | reg::kMcrLpmAck), 0u);
    mode.come_back(Leave::kFreeze);  // what a soft reset has changed in MCR
    expect_return(mode, 4);
  }
}

// Loop-back: the pin stays recessive, and a frame in flight is complete or begins anew.
TEST_P(ModeStates, LoopBackInEveryClock) {
  ModeRig mode{kTiming8 | reg::kCtrlLpb};
  MailboxRig &rig = mode.rig();
  for (unsigned k = 0; k < 64 * kBit; ++k) {
    SCOPED_TRACE(k);
    rig.put_tx(kSubject, 8, {.id = 0x155, .dlc = 1});
    mode.run(k);
    ASSERT_NO_FATAL_FAILURE(expect_exit(mode, 66));
    mode.come_back(how_);
    const auto sent = [&] { return rig.read(kSubject, reg::mb(8)) >> 24 == 8; };
    ASSERT_TRUE(mode.run_until(sent, 200 * kBit));
    rig.write(kSubject, reg::kIflag1, ~0u);
    mode.run(4 * kBit);
  }
  EXPECT_EQ(mode.dominant_clocks(), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, ModeStates, ::testing::ValuesIn(kAllWays),
                         [](const auto &each) { return to_string(each.param); });

// ---- Freeze mode: its two bits

// FX-MCR.FRZ, FX-MCR.HALT, FX-MCR.FRZ_ACK: both are needed; either ends it, also cleared one after
// the other.
TEST(FreezeBits, BothAskAndEitherEnds) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  const auto frozen = [&] { return (mode.read(reg::kMcr) & reg::kMcrFrzAck) != 0; };
  const auto write = [&](std::uint32_t bits) {
    rig.write(kSubject, reg::kMcr, ModeRig::kRunMcr | bits);
    mode.run(2 * kBit);
  };
  write(reg::kMcrFrz);
  EXPECT_FALSE(frozen());
  write(reg::kMcrHalt);
  EXPECT_FALSE(frozen());
  for (const std::uint32_t rest : {reg::kMcrFrz, reg::kMcrHalt, 0u}) {
    write(reg::kMcrFrz | reg::kMcrHalt);
    EXPECT_TRUE(frozen());
    rig.write(kSubject, reg::kMcr, ModeRig::kRunMcr | rest);
    EXPECT_FALSE(frozen()) << "FX-2.2.d: at once";
    write(0);
    EXPECT_FALSE(frozen());
  }
}

// FX-MCR.MDIS, FX-2.3.a: MDIS asks for disable mode in any mode, and a soft reset leaves it.
TEST(Disable, MdisSurvivesASoftReset) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  rig.write(kSubject, reg::kMcr, reg::kMcrSoftRst | reg::kMcrMdis);
  mode.run(4 * kBit);
  EXPECT_EQ(mode.read(reg::kMcr), 0xD890000Fu);
  rig.write(kSubject, reg::kMcr, 0x5890000F);
  EXPECT_EQ(mode.read(reg::kMcr), 0x5980000Fu);
  rig.write(kSubject, reg::kMcr, reg::kMcrSoftRst);
  mode.run(4);
  EXPECT_EQ(mode.read(reg::kMcr), 0x5980000Fu);
}

// FX-2.2.c: in freeze mode the receive pin is ignored, TIMER stands, the pin is recessive.
TEST(FreezeBits, TheBusIsIgnored) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  ASSERT_TRUE(rig.freeze(kSubject));
  const std::uint32_t timer = mode.read(reg::kTimer);
  rig.put_tx(kPeer, 8, {.id = 0x155, .dlc = 8});
  rig.put_tx(kSubject, 8, {.id = 0x001});
  ASSERT_TRUE(rig.wait_flag(kPeer, 8));
  EXPECT_EQ(mode.read(reg::kTimer), timer);
  EXPECT_EQ(mode.read(reg::kIflag1), 0u);
  EXPECT_EQ(mode.dominant_clocks(), 0u);
  EXPECT_EQ(mode.read(reg::kEsr) & 0xFC00, 0u);
}

// FX-2.3.f, FX-MCR.SOFT_RST: the bare word, in every clock of idle and with a frame waiting: never
// a moment on the bus between the reset and the freeze mode it ends in.
TEST(SoftResetWord, NoMomentOnTheBus) {
  ModeRig mode;
  MailboxRig &rig = mode.rig();
  for (unsigned k = 0; k < 2 * kBit; ++k) {
    ASSERT_TRUE(rig.freeze(kSubject));
    rig.put_tx(kSubject, 8, {.id = 0x155});
    mode.clear_counts();
    mode.run(k);
    mode.ask(Leave::kSoftReset);
    mode.run(30 * kBit);
    EXPECT_EQ(mode.dominant_clocks(), 0u);
    EXPECT_EQ(mode.read(reg::kMcr), 0x5980000Fu);
    EXPECT_EQ(mode.read(reg::mb(8)) >> 24, 0xCu);
    mode.come_back(Leave::kSoftReset);
    ASSERT_TRUE(rig.wait_flag(kSubject, 8)) << "sent after the bus has been joined again";
    rig.write(kSubject, reg::kIflag1, ~0u);
  }
}

}  // namespace
}  // namespace vericansim

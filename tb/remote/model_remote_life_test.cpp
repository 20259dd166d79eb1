// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Start, watchdog, bus-off and automatic rate, on the model: RN-60, RN-62, RN-70 to RN-73.
#include <array>

#include "remote/model_test.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RemoteModelLife : public RemoteModelTest {};

// RN-70: off the bus nothing is heard and nothing said.
TEST_F(RemoteModelLife, InitIsOffTheBus) {
  ModelNode off{full()};
  EXPECT_EQ(off.model.state(), RemoteState::kInit);
  EXPECT_TRUE(off.model.safe());
  EXPECT_THAT(off.send("1A0#5A"), IsEmpty());
  EXPECT_THAT(off.send("002#0000000000000000"), IsEmpty());
  EXPECT_THAT(off.wait(200), IsEmpty());
  EXPECT_EQ(off.bytes(0x20, 1)[0], 0);
  EXPECT_EQ(off.model.status().row(), (std::array<std::uint8_t, 8>{}));
}

// RN-60, RN-62: what user logic loaded before the start counts.
TEST_F(RemoteModelLife, UserLogicSetsUpBeforeTheStart) {
  ModelNode set{full()};
  set.user_write(0xF00, {7, 0x0C});  // number 7, BOOT and AUTO_OP
  set.model.start();
  EXPECT_THAT(set.drain(), ElementsAre("7FE#0300000000000000"));
  EXPECT_EQ(set.model.number(), 7U);
  EXPECT_THAT(set.bytes(0xF04, 4), ElementsAre(0x0A, 0x0A, 0x32, 0x08));
}

// RN-70, RN-71: the watchdog ends OPERATE after WDT ms without a request that was not refused.
TEST_F(RemoteModelLife, Watchdog) {
  node.user_write(0xF02, {50, 0});
  (void)node.wait(200);
  EXPECT_FALSE(node.model.status().watchdog);  // SAFE: nothing to watch
  (void)node.send("000#01");
  for (const char *fed :
       {"1A0#5A", "1A0#R1", "0A0#5A", "001#01", "002#0000000000000000", "000#01"}) {
    (void)node.wait(48);
    (void)node.send(fed);
    EXPECT_EQ(state(), kOperate) << fed;
  }
  for (const char *not_fed : {"1A0#", "220#5A", "5A0#00", "000#0104", "001#0000", "06800000#00"}) {
    (void)node.send("1A0#5A");
    (void)node.wait(48);
    (void)node.send(not_fed);
    EXPECT_EQ(state(), kOperate) << not_fed;
    (void)node.wait(3);
    EXPECT_EQ(state(), kSafe) << not_fed;
    EXPECT_TRUE(node.model.status().watchdog);
    (void)node.send("000#01");
    EXPECT_EQ(state(), kOperate);
  }
  (void)node.send("1FC#04");
  EXPECT_FALSE(node.model.status().watchdog);
}

// RN-71: 16 bits of ms; 0 is off.
TEST_F(RemoteModelLife, WatchdogRange) {
  (void)node.send("000#01");
  (void)node.wait(70'000);
  EXPECT_EQ(state(), kOperate);
  node.user_write(0xF02, {0xFF, 0xFF});
  (void)node.send("1A0#R1");
  (void)node.wait(65'533);
  EXPECT_EQ(state(), kOperate);
  (void)node.wait(3);
  EXPECT_EQ(state(), kSafe);
}

// RN-70: AUTO_OP after the start, RESTART and recovery; not after watchdog or STATE 02.
TEST_F(RemoteModelLife, AutoOperate) {
  ModelNode self{full()};
  self.user_write(0xF01, {9, 20, 0});  // ERRS and AUTO_OP; WDT 20 ms
  self.model.start();
  EXPECT_EQ(self.model.state(), RemoteState::kOperate);
  (void)self.wait(30);
  EXPECT_EQ(self.model.state(), RemoteState::kSafe);
  (void)self.wait(100);
  EXPECT_EQ(self.model.state(), RemoteState::kSafe);
  self.model.went_bus_off();
  self.model.recovered();
  EXPECT_EQ(self.model.state(), RemoteState::kSafe);
  (void)self.send("000#01");
  self.model.went_bus_off();
  EXPECT_EQ(self.model.state(), RemoteState::kSafe);
  self.model.recovered();
  EXPECT_EQ(self.model.state(), RemoteState::kOperate);
  (void)self.send("000#02");
  (void)self.wait(5);
  EXPECT_EQ(self.model.state(), RemoteState::kSafe);
  (void)self.send("000#81");
  self.model.stopped();
  EXPECT_EQ(self.model.state(), RemoteState::kOperate);
}

// RN-72: bus-off empties the queue, leads to SAFE, is told after the recovery.
TEST_F(RemoteModelLife, BusOff) {
  (void)node.send("000#01");
  node.hear("1A0#R1");
  node.model.went_bus_off();
  EXPECT_EQ(state(), kSafe);
  EXPECT_FALSE(node.model.wants());
  (void)node.wait(500);
  EXPECT_THAT(node.drain(), IsEmpty());
  node.model.recovered();
  EXPECT_THAT(node.drain(), ElementsAre("5FE#8200000000010000"));
  EXPECT_EQ(node.bytes(0xFED, 1)[0], 1);
  (void)node.send("1FC#04");
  EXPECT_THAT(node.send("1FE#R1"), ElementsAre("5FE#02"));
}

// RN-72: BOFF x 2^k ms, k = 0 to 7; 0 again 10 s after the last recovery.
TEST_F(RemoteModelLife, BackOffDoubles) {
  const auto wait_for_end = [&] {
    unsigned ms = 0;
    for (; !node.model.may_recover(); ++ms) node.model.tick();
    return ms;
  };
  for (const unsigned wanted : {10U, 20U, 40U, 80U, 160U, 320U, 640U, 1280U, 1280U, 1280U}) {
    node.model.went_bus_off();
    const unsigned ms = wait_for_end();
    EXPECT_GE(ms, wanted);
    EXPECT_LE(ms, wanted + 1);
    node.model.recovered();
    (void)node.wait(100);
  }
  (void)node.wait(9'800);
  node.model.went_bus_off();
  EXPECT_GE(wait_for_end(), 1280U);
  node.model.recovered();
  (void)node.wait(10'001);
  node.model.went_bus_off();
  EXPECT_LE(wait_for_end(), 11U);
  node.model.recovered();
  node.user_write(0xF04, {0});
  node.model.went_bus_off();
  EXPECT_TRUE(node.model.may_recover());
}

// RN-73: two errors without a frame lead on, two frames decide; the table begins again.
TEST_F(RemoteModelLife, AutomaticRate) {
  ModelNode ear{full()};
  ear.model.start(true);
  EXPECT_EQ(static_cast<unsigned>(ear.model.state()), kListen);
  EXPECT_THAT(ear.drain(), IsEmpty());
  for (unsigned row = 0; row < 17; ++row) {
    EXPECT_EQ(ear.model.rate_row(), row % 8);
    ear.model.rate_error();
    EXPECT_EQ(ear.model.rate_row(), row % 8);
    ear.model.rate_error();
  }
  EXPECT_THAT(ear.send("1A0#5A"), IsEmpty());
  ear.model.rate_error();
  EXPECT_EQ(static_cast<unsigned>(ear.model.state()), kListen);
  EXPECT_EQ(ear.model.rate_row(), 1U);
  ear.model.rate_error();
  EXPECT_EQ(ear.model.rate_row(), 2U);
  EXPECT_THAT(ear.send("06800000#00"), IsEmpty());
  EXPECT_THAT(ear.send("1A0#5A"), ElementsAre("5FE#0200000000000000"));
  EXPECT_EQ(static_cast<unsigned>(ear.model.state()), kSafe);
  EXPECT_EQ(ear.bytes(0x20, 1)[0], 0);  // not obeyed
  ear.model.rate_error();
  ear.model.rate_error();
  EXPECT_EQ(ear.model.rate_row(), 2U);
}

// RN-73: without the option there is nothing to search.
TEST_F(RemoteModelLife, NoAutomaticRateWithoutTheOption) {
  ModelNode ear{RemoteConfig::profile("standard")};
  ear.model.start(true);
  EXPECT_EQ(static_cast<unsigned>(ear.model.state()), kSafe);
}

}  // namespace
}  // namespace vericansim

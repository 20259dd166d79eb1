// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ApbChecker, AxilChecker, WbChecker: what master and slave must not do has a name; what they may
// do has none.
#include <gmock/gmock.h>

#include "node/apb_checker.hpp"
#include "node/axil_checker.hpp"
#include "node/wb_checker.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr ApbRequest kSetup{.psel = true, .paddr = 4, .pwrite = true, .pstrb = 15, .pwdata = 9};
constexpr ApbRequest access_of(ApbRequest setup) {
  setup.penable = true;
  return setup;
}

TEST(ApbChecker, CountsTransfersWaitsAndErrors) {
  ApbChecker checker;
  checker.clock({}, {});
  checker.clock(kSetup, {});
  checker.clock(access_of(kSetup), {.pready = false});
  checker.clock(access_of(kSetup), {});
  checker.clock(kSetup, {});  // back to back
  checker.clock(access_of(kSetup), {.pslverr = true});
  EXPECT_THAT(checker.report().violations, IsEmpty());
  EXPECT_EQ(checker.report().transfers, 2u);
  EXPECT_EQ(checker.report().errors, 1u);
  EXPECT_EQ(checker.report().max_waits, 1u);
}

TEST(ApbChecker, NamesWhatMasterAndSlaveMustNotDo) {
  ApbChecker checker;
  checker.clock(access_of(kSetup), {});
  checker.clock(kSetup, {.pslverr = true});
  ApbRequest other = access_of(kSetup);
  other.paddr = 8;
  checker.clock(other, {});
  checker.clock(kSetup, {});
  checker.clock({}, {});
  checker.clock({.psel = true, .pstrb = 1}, {});
  EXPECT_THAT(checker.report().violations,
              ElementsAre(HasSubstr("PENABLE without a setup phase"),
                          HasSubstr("PSLVERR without PSEL"), HasSubstr("changed before PREADY"),
                          HasSubstr("no access phase"), HasSubstr("PSTRB of a read")));
}

TEST(WbChecker, CountsTransfersWaitsAndErrors) {
  WbChecker checker;
  const WbRequest strobe{.cyc = true, .stb = true, .adr = 1, .sel = 15};
  checker.clock(strobe, {.stall = true});
  checker.clock(strobe, {.stall = true});
  checker.clock(strobe, {.ack = true});
  checker.clock(strobe, {.stall = true});
  checker.clock(strobe, {.err = true});
  checker.clock(strobe, {.stall = true});
  checker.clock({}, {});  // dropped
  EXPECT_THAT(checker.report().violations, IsEmpty());
  EXPECT_EQ(checker.report().transfers, 2u);
  EXPECT_EQ(checker.report().errors, 1u);
  EXPECT_EQ(checker.report().max_waits, 1u);
}

TEST(WbChecker, APipelinedMasterMayStrobeInEachClock) {
  WbChecker checker{true};
  WbRequest strobe{.cyc = true, .stb = true, .adr = 1, .sel = 15};
  checker.clock(strobe, {});
  strobe.adr = 2;
  checker.clock(strobe, {.ack = true});
  strobe.stb = false;
  checker.clock(strobe, {.ack = true});
  EXPECT_THAT(checker.report().violations, IsEmpty());
  EXPECT_EQ(checker.report().transfers, 2u);
}

TEST(WbChecker, NamesWhatMasterAndSlaveMustNotDo) {
  WbChecker checker;
  WbRequest strobe{.cyc = true, .stb = true, .adr = 1, .sel = 15};
  checker.clock({.stb = true}, {});
  checker.clock({}, {.ack = true});
  checker.clock({.cyc = true}, {.ack = true});
  checker.clock(strobe, {.ack = true, .err = true});
  checker.clock(strobe, {});
  strobe.adr = 2;
  checker.clock(strobe, {.ack = true});
  EXPECT_THAT(checker.report().violations,
              ElementsAre(HasSubstr("STB without CYC"), HasSubstr("answer without CYC"),
                          HasSubstr("answer without a transfer"), HasSubstr("ACK and ERR"),
                          HasSubstr("in the clock of its strobe"),
                          HasSubstr("changed before it was taken")));
}

constexpr AxilRequest kRead{.arvalid = true, .araddr = 4};
constexpr AxilRequest kWrite{.awvalid = true, .awaddr = 4, .wvalid = true, .wdata = 9, .wstrb = 15};

TEST(AxilChecker, CountsTransfersWaitsAndErrors) {
  AxilChecker checker;
  checker.clock(kRead, {});
  checker.clock(kRead, {});
  checker.clock(kRead, {.arready = true});
  checker.clock(kWrite, {.rvalid = true});
  checker.clock(kWrite, {});
  checker.clock(kWrite, {.awready = true, .wready = true});
  checker.clock({}, {.bvalid = true, .bresp = 2});
  EXPECT_THAT(checker.report().violations, IsEmpty());
  EXPECT_EQ(checker.report().transfers, 2u);
  EXPECT_EQ(checker.report().errors, 1u);
  EXPECT_EQ(checker.report().max_waits, 1u);
}

TEST(AxilChecker, NamesWhatTheMasterMustNotDo) {
  AxilChecker checker;
  AxilRequest both = kRead;
  both.awvalid = both.wvalid = true;
  checker.clock(both, {});
  both.araddr = both.awaddr = both.wdata = 1;
  checker.clock(both, {});
  EXPECT_THAT(
      checker.report().violations,
      ElementsAre(HasSubstr("AR changed"), HasSubstr("AW changed"), HasSubstr("W changed")));
}

TEST(AxilChecker, NamesWhatTheSlaveMustNotDo) {
  AxilChecker checker;
  checker.clock({.bready = false, .rready = false}, {.bvalid = true, .rvalid = true});
  checker.clock({}, {.bvalid = true, .bresp = 1, .rvalid = true, .rresp = 3});
  EXPECT_THAT(checker.report().violations,
              ElementsAre(HasSubstr("RVALID without a read"), HasSubstr("BVALID without a write"),
                          HasSubstr("R changed"), HasSubstr("B changed"),
                          HasSubstr("RVALID without a read"), HasSubstr("BVALID without a write"),
                          HasSubstr("RRESP is neither"), HasSubstr("BRESP is neither")));
}

TEST(AxilChecker, NamesLateAnswers) {
  AxilChecker checker;
  for (int clock = 0; clock < 8; ++clock) checker.clock(kRead, {});
  EXPECT_THAT(checker.report().violations, ElementsAre(HasSubstr("ARREADY is late")));
  checker.reset();
  for (int clock = 0; clock < 9; ++clock) checker.clock(kWrite, {});
  EXPECT_THAT(checker.report().violations,
              ElementsAre(HasSubstr("ARREADY is late"), HasSubstr("AWREADY is late")));
}

}  // namespace
}  // namespace vericansim

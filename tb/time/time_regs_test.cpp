// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers of the time unit through AHB: TM-02, TM-03, TM-11 to TM-16, TM-29 to TM-32.
#include <gtest/gtest.h>

#include <cstdint>

#include "bus/faults.hpp"
#include "time/time_rig.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

class TimeRegs : public testing::Test {
 protected:
  TimeRegs() { rig_.run(400); }
  std::uint32_t read(std::uint32_t address) { return rig_.read(0, address); }
  void write(std::uint32_t address, std::uint32_t data) { rig_.write(0, address, data); }
  /// Half a word, as a driver must not.
  void write_half(std::uint32_t address, std::uint32_t data) {
    rig_.access(0, {.address = address, .write = true, .size = AhbSize::kHalf, .data = data});
  }
  void rate(std::uint32_t ns, std::uint32_t fraction) {
    write(kTincn, ns);
    write(kTincf, fraction);
  }
  std::uint64_t time() { return time_.time(0); }
  /// TIME less what an unsteered clock would show, and a constant: what steering has added.
  std::uint64_t steered() {
    const std::uint64_t now = time();
    return now - time_.node(0).edges() * kTimeStep;
  }

  TimeRig time_{1};
  MailboxRig &rig_ = time_.rig;
};

// TM-02: XCONFIG tells of it; reset values of section 6.
TEST_F(TimeRegs, ResetValues) {
  EXPECT_EQ((read(0x1008) >> 12) & 3, 1u);
  EXPECT_EQ(read(kTcap), 0x00020003u);
  EXPECT_EQ(read(kTctrl), 0x31u);
  EXPECT_EQ(read(kTstat), 0u);
  for (const std::uint32_t address :
       {kTincn,  kTincf,  kTshlo,  kTshhi,   kTslew,    kTcmp,         kTcmph,  kTtx,
        kTtxmb,  kTextlo, kTexthi, stamp(0), stamp(63), stamp(63) + 4, 0x110Cu, 0x1138u,
        0x113Cu, 0x1148u, 0x117Cu, 0x1180u,  0x1600u,   0x17FCu})
    EXPECT_EQ(read(address), 0u) << std::hex << address;
}

// TM-03: in every mode the clock runs, and its registers are read and written.
TEST_F(TimeRegs, EveryMode) {
  const auto check = [this](const char *mode) {
    SCOPED_TRACE(mode);
    const std::uint64_t before = steered(), edges = time_.node(0).edges();
    rig_.run(100);
    EXPECT_EQ(steered(), before);
    EXPECT_GT(time_.node(0).edges(), edges + 99);
    for (const std::uint32_t value : {0x001F3336u, 0x00000031u}) {
      write(kTctrl, value);
      EXPECT_EQ(read(kTctrl), value);
    }
    write(kTtxmb, 0x2A);
    EXPECT_EQ(read(kTtxmb), 0x2Au);
    for (const AhbResult &result : rig_.burst(0, {{.address = kTctrl, .write = true, .data = 0x31},
                                                  {.address = kTctrl},
                                                  {.address = kTtxmb, .write = true, .data = 0x2A},
                                                  {.address = kTtxmb},
                                                  {.address = kTincn}}))
      EXPECT_EQ(result.waits, 0u);
  };
  check("disable");
  rig_.configure(0);
  check("freeze");
  rig_.go(0);
  check("normal");
  rig_.node(0).request_stop(true);
  ASSERT_TRUE(rig_.run_until([this] { return (read(reg::kMcr) & reg::kMcrLpmAck) != 0; }, 1000));
  check("stop");
  rig_.node(0).request_stop(false);
  ASSERT_TRUE(rig_.freeze(0));
  write(reg::kEcr, 250);
  rig_.go(0);
  LevelFault fault{0, Effect::kRecessive, {rig_.bus().now(), kSecond}};
  rig_.bus().add(fault);
  rig_.put_tx(0, 8, {.id = 0x155});
  ASSERT_TRUE(rig_.run_until([this] { return rig_.field(0) == Field::kBusOff; }, 1000));
  check("bus-off");
}

// TM-03: a soft reset leaves clock and registers.
TEST_F(TimeRegs, SoftResetKeeps) {
  rig_.configure(0);
  write(kTctrl, 0x00110330);
  write(kTtxmb, 0x15);
  rate(100, 0x40000000);
  const std::uint64_t before = time(), edges = time_.node(0).edges();
  write(reg::kMcr, read(reg::kMcr) | reg::kMcrSoftRst);
  rig_.run(1000);
  EXPECT_EQ(read(kTctrl), 0x00110330u);
  EXPECT_EQ(read(kTtxmb), 0x15u);
  const std::uint64_t passed = time_.node(0).edges();
  const std::uint64_t gone = time() - before;
  // A quarter ns more a clock; reading takes a constant number of clocks.
  EXPECT_NEAR(static_cast<double>(gone), static_cast<double>(passed - edges) * 100.25, 500);
}

// TM-03: a hard reset brings back clock, increment and registers, also amid a slew and an event.
TEST_F(TimeRegs, HardReset) {
  const std::uint64_t fresh = steered();
  for (unsigned again = 0; again < 2; ++again) {
    write(kTctrl, 0x001F3331);
    write(kTcmph, 4000);
    write(kTcmp, static_cast<std::uint32_t>(time()) + 1000);
    write(kTtx, 0x7FFFFFF0);
    write(kTtxmb, 0x8000003F);
    rate(200, 0xFFFFFFFF);
    write(kTimelo, 0x12345678);
    write(kTimehi, 0x9ABCDEF0);
    write(kTslew, 1000);
    time_.node(0).external(true);
    rig_.run(100 + again);
    time_.node(0).external(false);
    rig_.run(10);
    ASSERT_EQ(read(kTstat) & 7, 7u);
    rig_.node(0).reset();
    rig_.run(400);
    EXPECT_EQ(read(kTctrl), 0x31u);
    for (const std::uint32_t address : {kTstat, kTslew, kTtxmb, kTextlo, kTexthi})
      EXPECT_EQ(read(address), 0u) << std::hex << address;
    EXPECT_EQ(steered(), fresh);
    EXPECT_FALSE(time_.node(0).irq_time());
  }
}

// TM-12, TM-16: a set acts a constant number of clocks after its write, whatever was read before.
TEST_F(TimeRegs, Set) {
  for (const std::uint64_t value : {0x123456789ABCDEF0ULL, 0xFFFFFFFFULL, 0ULL}) {
    write(kTimelo, static_cast<std::uint32_t>(value));
    write(kTimehi, static_cast<std::uint32_t>(value >> 32));
    const std::uint64_t edges = time_.node(0).edges();
    rig_.run(50);
    const std::uint64_t now = time();
    // Read in the clock after that of the address: two accesses later, four clocks of the command.
    const std::uint64_t clocks = (now - value) / kTimeStep;
    EXPECT_EQ((now - value) % kTimeStep, 0u);
    EXPECT_LT(clocks, time_.node(0).edges() - edges);
    EXPECT_GE(clocks + 12, time_.node(0).edges() - edges);
  }
}

// TM-13 to TM-15: shift, rate, slew; halves of words are not written.
TEST_F(TimeRegs, ShiftRateSlew) {
  const std::uint64_t start = steered();
  write(kTshlo, 0xFFFFFFFB);  // -5
  write(kTshhi, 0xFFFFFFFF);
  rig_.run(20);
  EXPECT_EQ(steered() - start, static_cast<std::uint64_t>(-5));
  write(kTshlo, 5);
  write(kTshhi, 1);
  rig_.run(20);
  EXPECT_EQ(steered() - start, 0x100000000ULL);
  write_half(kTshhi, 0xFFFF);
  write_half(kTincf, 0x1234);
  rig_.run(20);
  EXPECT_EQ(steered() - start, 0x100000000ULL);
  write(kTslew, 3);
  rig_.run(4);  // it acts four clocks after the write
  EXPECT_LE(3u - read(kTslew), 1u);
  EXPECT_NE(read(kTstat) & (1u << 16), 0u);
  rig_.run(60);  // a step each 1,024 ns: nine clocks
  EXPECT_EQ(read(kTslew), 0u);
  EXPECT_EQ(steered() - start, 0x100000003ULL);
  EXPECT_EQ(read(kTstat), 1u << 3);
  write(kTstat, 1u << 3);
  EXPECT_EQ(read(kTstat), 0u);
}

// TM-16: parts of a word are not written, and reading changes nothing.
TEST_F(TimeRegs, PartsOfAWord) {
  constexpr std::uint32_t kHeld = 1 << 17;
  write(kTctrl, 0x00002031);  // CMPEN
  const std::uint64_t launch = time() + 2000 * kTimeStep;
  write(kTtx, static_cast<std::uint32_t>(launch));
  write(kTtxmb, 0x80000005);
  const std::uint64_t before = steered();
  for (std::uint32_t address = kTimelo; address < 0x1148; address += 4) {
    write_half(address, 0x12340000 | address);
    write(0x1170, 0x3456);  // nothing is there
    read(address);
  }
  EXPECT_EQ(steered(), before);
  EXPECT_EQ(read(kTslew), 0u);
  EXPECT_EQ(read(kTtxmb), 0x80000005u);
  EXPECT_EQ(read(kTstat), kHeld);
  while ((read(kTstat) & kHeld) != 0) rig_.run(1);
  EXPECT_GE(time(), launch);
  EXPECT_LT(time(), launch + 20 * kTimeStep);
}

// TM-30, TM-31: events at their times, output and interrupt.
TEST_F(TimeRegs, CompareAndOutput) {
  write(kTctrl, 0x00023031);  // CMPIE, CMPEN, OUTEN
  write(kTcmph, 2000);        // 16 clocks
  const auto first =
      static_cast<std::uint32_t>(time_.node(0).edges() * kTimeStep + 100 * kTimeStep);
  write(kTcmp, first);
  EXPECT_EQ(read(kTstat) & (1u << 19), 1u << 19);
  EXPECT_FALSE(time_.node(0).irq_time());
  rig_.run(300);
  EXPECT_TRUE(time_.node(0).irq_time());
  const auto &pulses = time_.node(0).pulses();
  ASSERT_GE(pulses.size(), 3u);
  for (unsigned i = 0; i < 3; ++i)  // the clock after the first in which TIME has reached it
    EXPECT_EQ((pulses[i] - 1) * kTimeStep, first + i * 2000u) << i;
  // Armed anew while the output is 1: 0, until that time comes.
  while ((read(kTstat) & (1u << 18)) == 0) rig_.run(1);
  write(kTcmp, first + 1000000);
  rig_.run(50);
  EXPECT_EQ(read(kTstat) & (1u << 18), 0u);
  write(kTctrl, 0x31);
  EXPECT_FALSE(time_.node(0).irq_time());
  EXPECT_EQ(read(kTstat) & (1u << 19), 0u);
}

// TM-32: the external event: time of the clock in which the second flip-flop has changed.
TEST_F(TimeRegs, External) {
  write(kTctrl, 0x00010131);  // EXTIE, EXTR
  const std::uint64_t fresh = steered();
  write(kTimelo, 0x12345678);
  write(kTimehi, 0x9ABCDEF0);
  rig_.run(10);
  const auto raise = [this, base = steered() - fresh] {
    time_.node(0).external(true);
    const std::uint64_t at = base + (time_.node(0).edges() + 2) * kTimeStep;
    rig_.run(10);
    time_.node(0).external(false);
    rig_.run(10);
    return at;
  };
  const auto captured = [this] { return read(kTextlo) | (std::uint64_t{read(kTexthi)} << 32); };
  const std::uint64_t first = raise();
  EXPECT_EQ(captured(), first);
  EXPECT_EQ(read(kTstat), 1u);
  EXPECT_TRUE(time_.node(0).irq_time());
  raise();
  EXPECT_EQ(captured(), first);
  EXPECT_EQ(read(kTstat), 3u);
  write(kTstat, 1);
  EXPECT_EQ(read(kTstat), 2u);
  write(kTstat, 2);
  EXPECT_FALSE(time_.node(0).irq_time());
  const std::uint64_t third = raise();
  EXPECT_EQ(captured(), third);
  EXPECT_EQ(read(kTstat), 1u);
}

// TM-40: TTXMB and TSTAT tell of a hold, and of its end, from the clock behind the write on:
// software that reads TTXMB back at once must not take a buffer that has just been held for
// released.
TEST_F(TimeRegs, HoldReadsAsWrittenAtOnce) {  // TM-03, TM-40
  constexpr std::uint32_t kHold = 1u << 31, kHeld = 1u << 17;
  const auto both = [&](std::uint32_t data, std::uint32_t address) {
    return rig_.burst(0, {{.address = kTtxmb, .write = true, .data = data}, {.address = address}})
        .back()
        .data;
  };
  write(kTtx, static_cast<std::uint32_t>(time() + 1000000));
  EXPECT_EQ(both(kHold | 5, kTtxmb), kHold | 5);
  EXPECT_EQ(both(6, kTtxmb), 6u);
  EXPECT_EQ(both(kHold | 7, kTstat) & kHeld, kHeld);
  EXPECT_EQ(both(kHold | 8, kTtxmb), kHold | 8);
  EXPECT_EQ(both(8, kTstat) & kHeld, 0u);
  EXPECT_EQ(read(kTtxmb), 8u);
}

// TM-15: SLEWING is told from the write of TSLEW to SLEWD: software that waits for the end of a
// slew must not find it over at once. One that is stopped ends so, too.
TEST_F(TimeRegs, SlewingIsToldAtOnce) {  // TM-03, TM-15
  constexpr std::uint32_t kSlewing = 1u << 16, kSlewd = 8;
  const auto told = [&](std::uint32_t data) {
    std::vector<AhbTransfer> accesses{{.address = kTslew, .write = true, .data = data}};
    for (unsigned i = 0; i < 6; ++i) accesses.push_back({.address = kTstat});
    std::vector<std::uint32_t> flags;
    for (const AhbResult &result : rig_.burst(0, accesses))
      flags.push_back(result.data & (kSlewing | kSlewd));
    return std::vector<std::uint32_t>{flags.begin() + 1, flags.end()};
  };
  EXPECT_EQ(told(1000), std::vector<std::uint32_t>(6, kSlewing));
  const auto ends = told(0);
  for (const std::uint32_t flags : ends) EXPECT_TRUE(flags == kSlewing || flags == kSlewd);
  EXPECT_EQ(ends.back(), kSlewd);
}

// TM-30: TSTAT tells of arming and disarming, and that OUT has been lowered, at once.
TEST_F(TimeRegs, ArmingIsToldAtOnce) {  // TM-03, TM-30
  constexpr std::uint32_t kCmpen = 1u << 13, kOut = 1u << 18, kCmpon = 1u << 19;
  const auto told = [&](std::uint32_t address, std::uint32_t data) {
    const AhbTransfer write{.address = address, .write = true, .data = data};
    return rig_.burst(0, {write, {.address = kTstat}}).back().data & (kOut | kCmpon);
  };
  EXPECT_EQ(told(kTcmp, 0), 0u);  // not enabled
  write(kTctrl, kCmpen);
  EXPECT_EQ(told(kTcmp, static_cast<std::uint32_t>(time() + 1000000)), kCmpon);
  EXPECT_EQ(told(kTctrl, 0), 0u);
  write(kTctrl, kCmpen);
  write(kTcmp, static_cast<std::uint32_t>(time()));
  rig_.run(10);
  EXPECT_EQ(read(kTstat) & (kOut | kCmpon), kOut);
  EXPECT_EQ(told(kTcmp, static_cast<std::uint32_t>(time() + 1000000)), kCmpon);
}

// TM-29: software does not write stamps, nor TIMER with them, which stands still in these modes.
TEST_F(TimeRegs, StampsAreReadOnly) {
  const auto check = [this](const char *mode) {
    SCOPED_TRACE(mode);
    write(reg::kTimer, 0x1234);
    write(stamp(3), 0xFFFFFFFF);
    write(stamp(3) + 4, 0xFFFFFFFF);
    EXPECT_EQ(time_.stamp(0, 3), 0u);
    EXPECT_EQ(read(reg::kTimer), 0x1234u);
  };
  check("disable");
  rig_.configure(0);
  check("freeze");
}

}  // namespace
}  // namespace vericansim

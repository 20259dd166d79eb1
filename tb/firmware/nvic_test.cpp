// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nvic, SysTick and SystemControl on their own, against the ARMv7-M Architecture Reference Manual
// (B1.5.4, B3.2 to B3.4).
#include "firmware/nvic.hpp"

#include <gtest/gtest.h>

#include "firmware/system_control.hpp"
#include "firmware/systick.hpp"

namespace {

using namespace vericansim::firmware;

TEST(Nvic, OrderOfPendingExceptions) {
  Nvic nvic;
  for (const unsigned irq : {3U, 7U, 100U, 150U}) {
    nvic.enable(kIrq0 + irq, true);
    nvic.set_priority(kIrq0 + irq, 0x40);
    nvic.pend(kIrq0 + irq);
  }
  EXPECT_EQ(nvic.first_pending(), kIrq0 + 3);  // equal: the smaller number
  nvic.set_priority(kIrq0 + 150, 0x38);
  EXPECT_EQ(nvic.first_pending(), kIrq0 + 150);
  nvic.set_priority(kSysTick, 0x30);
  nvic.pend(kSysTick);
  EXPECT_EQ(nvic.first_pending(), static_cast<unsigned>(kSysTick));
  nvic.pend(kNmi);
  EXPECT_EQ(nvic.first_pending(), static_cast<unsigned>(kNmi));
}

// AIRCR.PRIGROUP: the lower part decides the order among pending ones, but does not preempt.
TEST(Nvic, SubPrioritiesDoNotPreempt) {
  Nvic nvic;
  nvic.prigroup = 6;  // bit 7 preempts
  for (const unsigned irq : {1U, 2U}) nvic.enable(kIrq0 + irq, true);
  nvic.set_priority(kIrq0 + 1, 0x70);
  nvic.set_priority(kIrq0 + 2, 0x10);
  nvic.enter(kIrq0 + 1);
  nvic.pend(kIrq0 + 2);
  EXPECT_FALSE(nvic.preempting());
  nvic.prigroup = 2;
  EXPECT_EQ(nvic.preempting(), kIrq0 + 2);
}

TEST(Nvic, FiveBitsOfPriority) {
  Nvic nvic;
  nvic.set_priority(kIrq0, 0xFF);
  EXPECT_EQ(nvic.priority_byte(kIrq0), 0xF8);
}

TEST(Nvic, ExecutionPriority) {
  Nvic nvic;
  EXPECT_EQ(nvic.execution_priority(), 256);
  nvic.basepri = 0x60;
  EXPECT_EQ(nvic.execution_priority(), 0x60);
  nvic.primask = true;
  EXPECT_EQ(nvic.execution_priority(), 0);
  EXPECT_EQ(nvic.wake_priority(), 0x60);
  nvic.enter(kHardFault);
  EXPECT_EQ(nvic.execution_priority(), -1);
  nvic.enter(kNmi);
  EXPECT_EQ(nvic.execution_priority(), -2);
}

TEST(Nvic, RegistersSetAndClear) {
  Nvic nvic;
  nvic.write(0xE000'E104, 0x3);  // IRQ 32, 33
  EXPECT_TRUE(nvic.enabled(kIrq0 + 32));
  EXPECT_TRUE(nvic.enabled(kIrq0 + 33));
  EXPECT_EQ(nvic.read(0xE000'E104), 0x3U);
  EXPECT_EQ(nvic.read(0xE000'E184), 0x3U);
  nvic.write(0xE000'E184, 0x1);
  EXPECT_EQ(nvic.read(0xE000'E104), 0x2U);
  nvic.write(0xE000'E200, 1U << 31);
  EXPECT_TRUE(nvic.pending(kIrq0 + 31));
  EXPECT_EQ(nvic.read(0xE000'E280), 1U << 31);
  nvic.write(0xE000'E280, 1U << 31);
  EXPECT_FALSE(nvic.pending(kIrq0 + 31));
  nvic.enter(kIrq0 + 31);
  EXPECT_EQ(nvic.read(0xE000'E300), 1U << 31);
  nvic.write(0xE000'E400 + 28, 0xFF00'0000);
  EXPECT_EQ(nvic.read(0xE000'E400 + 28), 0xF800'0000U);
  // Lines that do not exist: 151 to 159.
  nvic.write(0xE000'E110, ~0U);
  EXPECT_EQ(nvic.read(0xE000'E110), 0x007F'FFFFU);
}

TEST(Nvic, LineThatRisesInItsHandlerPendsAgain) {
  Nvic nvic;
  nvic.enable(kIrq0 + 31, true);
  nvic.line(31, true);
  nvic.enter(kIrq0 + 31);
  nvic.line(31, true);
  EXPECT_FALSE(nvic.pending(kIrq0 + 31));
  nvic.line(31, false);
  nvic.line(31, true);
  EXPECT_TRUE(nvic.pending(kIrq0 + 31));
}

TEST(Nvic, Names) {
  EXPECT_EQ(exception_name(0), "none");
  EXPECT_EQ(exception_name(15), "SysTick");
  EXPECT_EQ(exception_name(47), "IRQ 31");
  EXPECT_EQ(exception_name(7), "reserved exception 7");
}

// ---- SysTick (B3.3)

TEST(SysTick, CountsDownAndReloads) {
  SysTick timer;
  timer.write(4, 3);
  timer.write(8, 55);
  EXPECT_EQ(timer.read(8), 0U);  // any write clears it
  timer.write(0, 7);
  std::vector<unsigned> at;
  for (unsigned clock = 1; clock <= 12; ++clock)
    if (timer.clock()) at.push_back(clock);
  EXPECT_EQ(at, (std::vector<unsigned>{4, 8, 12}));
  EXPECT_EQ(timer.read(0), 7U | 1U << 16);
  EXPECT_EQ(timer.read(0), 7U);  // COUNTFLAG is cleared by reading
}

TEST(SysTick, ReferenceClockAndNoInterrupt) {
  SysTick timer;
  timer.write(4, 1);
  timer.write(0, 1);  // enabled, reference clock, no exception
  for (unsigned clock = 0; clock < 2 * SysTick::kReference - 1; ++clock)
    EXPECT_FALSE(timer.clock());
  EXPECT_EQ(timer.read(0) >> 16, 0U);
  EXPECT_FALSE(timer.clock());
  EXPECT_EQ(timer.read(0) >> 16, 1U);
}

TEST(SysTick, ReloadOfZeroStops) {
  SysTick timer;
  timer.write(0, 7);
  for (unsigned clock = 0; clock < 100; ++clock) EXPECT_FALSE(timer.clock());
}

// ---- System control block

TEST(SystemControl, IdentificationAndKeys) {
  Nvic nvic;
  SystemControl system{nvic};
  EXPECT_EQ(system.read(0xE000'ED00, 4, 0), 0x411F'C231U);
  EXPECT_EQ(system.read(0xE000'E004, 4, 0), 4U);  // 160 lines at most
  EXPECT_TRUE(system.write(0xE000'ED0C, 4, 0x1234'0004));
  EXPECT_FALSE(system.take_reset_request());  // wrong key
  EXPECT_TRUE(system.write(0xE000'ED0C, 4, 0x05FA'0304));
  EXPECT_TRUE(system.take_reset_request());
  EXPECT_FALSE(system.take_reset_request());
  EXPECT_EQ(system.read(0xE000'ED0C, 4, 0), 0xFA05'0300U);
}

TEST(SystemControl, IcsrShowsAndPends) {
  Nvic nvic;
  SystemControl system{nvic};
  nvic.enable(kIrq0 + 31, true);
  nvic.pend(kIrq0 + 31);
  EXPECT_EQ(system.read(0xE000'ED04, 4, 12), 12U | 1U << 11 | 47U << 12 | 1U << 22);
  EXPECT_TRUE(system.write(0xE000'ED04, 4, 1U << 26 | 1U << 28));
  EXPECT_TRUE(nvic.pending(kSysTick));
  EXPECT_TRUE(nvic.pending(kPendSv));
  EXPECT_TRUE(system.write(0xE000'ED04, 4, 1U << 25 | 1U << 27));
  EXPECT_FALSE(nvic.pending(kSysTick));
  EXPECT_FALSE(nvic.pending(kPendSv));
}

// VECTPENDING has the effect of BASEPRI and FAULTMASK, not that of PRIMASK or of what is active
// (Cortex-M3 Devices Generic User Guide, ICSR).
TEST(SystemControl, IcsrLeavesOutWhatIsMasked) {
  Nvic nvic;
  SystemControl system{nvic};
  const auto pending = [&] { return *system.read(0xE000'ED04, 4, 0) >> 12 & 0x1FF; };
  nvic.enable(kIrq0 + 31, true);
  nvic.set_priority(kIrq0 + 31, 0x80);
  nvic.pend(kIrq0 + 31);
  nvic.primask = true;
  nvic.enter(kSvCall);
  EXPECT_EQ(pending(), 47U);
  nvic.basepri = 0x80;
  EXPECT_EQ(pending(), 0U);
  nvic.basepri = 0x88;
  EXPECT_EQ(pending(), 47U);
  nvic.faultmask = true;
  EXPECT_EQ(pending(), 0U);
  nvic.pend(kNmi);
  EXPECT_EQ(pending(), 2U);
}

TEST(SystemControl, SystemPrioritiesByByteAndStatusBits) {
  Nvic nvic;
  SystemControl system{nvic};
  EXPECT_TRUE(system.write(0xE000'ED23, 1, 0x88));  // SysTick
  EXPECT_EQ(nvic.priority_byte(kSysTick), 0x88);
  EXPECT_TRUE(system.write(0xE000'ED22, 1, 0x10));  // PendSV; the neighbour stays
  EXPECT_EQ(system.read(0xE000'ED20, 4, 0), 0x8810'0000U);
  system.record({FaultKind::kUndefined});
  system.record({FaultKind::kUnaligned});
  EXPECT_TRUE(system.write(0xE000'ED2A, 2, 1U << 0));  // UFSR.UNDEFINSTR
  EXPECT_EQ(system.cfsr(), 1U << 24);
  EXPECT_FALSE(system.write(0xE000'ED08, 2, 0));  // VTOR: words only
  EXPECT_TRUE(system.write(0xE000'ED08, 4, 0x2000'00FF));
  EXPECT_EQ(system.vector_table(), 0x2000'0080U);
}

}  // namespace

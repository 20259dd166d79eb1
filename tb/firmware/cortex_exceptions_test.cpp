// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Exceptions of the CPU model against the ARMv7-M Architecture Reference Manual (section numbers in
// the comments) and the timing that docs/firmware.md promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/cortex_rig.hpp"

namespace {

using namespace vericansim::firmware;
using ::testing::ElementsAre;
using State = CortexM3::State;

constexpr unsigned kIrq31 = kIrq0 + 31, kIrq32 = kIrq0 + 32;

/// R0-R12 with values of their own.
Registers marked(const tb::CortexRig &rig) {
  Registers registers = rig.cpu.engine().registers();
  for (unsigned i = 0; i <= 12; ++i) registers.r[i] = 0x1111'1111 * (i + 1);
  registers.r[kLr] = 0xAAAA'5555;
  registers.flags = 0xA800'0000;
  return registers;
}

// B1.5.5: reset loads SP and PC.
TEST(CortexReset, TakesStackPointerAndVectorFromAddressZero) {
  tb::CortexRig rig;
  EXPECT_EQ(rig.reg(kSp), 0x2000'8000U);
  EXPECT_EQ(rig.reg(kPc), rig.address("idle"));
  EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFFFU);
  EXPECT_EQ(rig.cpu.ipsr(), 0U);
}

// B1.5.6: eight words in this order; LR gets EXC_RETURN for Thread mode with the main stack.
TEST(CortexEntry, StacksEightWords) {
  tb::CortexRig rig;
  const Registers before = marked(rig);
  rig.cpu.engine().set_registers(before);
  rig.handler(kIrq31, "spoil_handler");
  rig.enable(31);
  rig.cpu.nvic().pend(kIrq31);
  rig.clock();
  EXPECT_EQ(rig.cpu.ipsr(), kIrq31);
  const std::uint32_t sp = before.r[kSp] - 32;
  ASSERT_EQ(rig.reg(kSp), sp);
  for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(rig.word(sp + 4 * i), before.r[i]);
  EXPECT_EQ(rig.word(sp + 16), before.r[12]);
  EXPECT_EQ(rig.word(sp + 20), before.r[kLr]);
  EXPECT_EQ(rig.word(sp + 24), before.r[kPc]);
  EXPECT_EQ(rig.word(sp + 28), 0xA900'0000U);  // flags, T, no exception
  EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFF9U);
  EXPECT_EQ(rig.reg(kPc), rig.address("spoil_handler"));
}

// B1.5.8: everything is as before, although the handler has spoilt it.
TEST(CortexReturn, RestoresRegistersFlagsAndStack) {
  tb::CortexRig rig;
  const Registers before = marked(rig);
  rig.cpu.engine().set_registers(before);
  rig.handler(kIrq31, "spoil_handler");
  rig.enable(31);
  rig.cpu.nvic().pend(kIrq31);
  rig.clock();
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == 0; }));
  const Registers after = rig.cpu.engine().registers();
  EXPECT_EQ(after.r, before.r);
  EXPECT_EQ(after.flags, before.flags);
  EXPECT_FALSE(rig.cpu.nvic().active(kIrq31));
}

// B1.5.7: with CCR.STKALIGN the frame is on eight bytes, and bit 9 of xPSR remembers it.
TEST(CortexEntry, AlignsTheFrameIfAskedTo) {
  for (const bool align : {false, true}) {
    tb::CortexRig rig;
    ASSERT_TRUE(rig.cpu.system().write(0xE000'ED14, 4, align ? 0x200 : 0));
    rig.cpu.engine().set_reg(kSp, 0x2000'3004);
    rig.enable(32);
    rig.cpu.nvic().pend(kIrq32);
    rig.clock();
    const std::uint32_t sp = align ? 0x2000'2FE0 : 0x2000'2FE4;
    EXPECT_EQ(rig.reg(kSp), sp);
    EXPECT_EQ(rig.word(sp + 28) >> 9 & 1, align ? 1U : 0U);
    ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == 0; }));
    EXPECT_EQ(rig.reg(kSp), 0x2000'3004U);
  }
}

// B1.4.1, B1.5.8: a thread on the process stack is stacked there; the handler uses the main stack.
TEST(CortexEntry, ProcessStack) {
  tb::CortexRig rig;
  rig.go("special_registers");
  ASSERT_TRUE(rig.run_until([&] { return rig.reg(11) == 0xA800'0000; }));
  EXPECT_EQ(rig.cpu.psp(), 0x2000'4000U);
  EXPECT_EQ(rig.cpu.msp(), 0x2000'8000U);
  rig.enable(32);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == kIrq32; }));
  EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFFDU);
  EXPECT_EQ(rig.reg(kSp), 0x2000'8000U);
  EXPECT_EQ(rig.cpu.psp(), 0x2000'3FE0U);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == 0; }));
  EXPECT_EQ(rig.reg(kSp), 0x2000'4000U);
  EXPECT_EQ(rig.cpu.msp(), 0x2000'8000U);
}

// The model's own figures: 2 clocks an instruction, 12 to enter, 10 to return.
TEST(CortexTiming, InstructionsEntryAndReturn) {
  tb::CortexRig rig;
  rig.go("ten_nops");
  rig.clock(20);
  EXPECT_EQ(rig.cpu.instructions(), 10U);
  tb::CortexRig slow{{.clocks_per_instruction = 5}};
  slow.go("ten_nops");
  slow.clock(20);
  EXPECT_EQ(slow.cpu.instructions(), 4U);

  tb::CortexRig entry;
  entry.handler(kIrq31, "spoil_handler");  // six instructions
  entry.enable(31);
  entry.cpu.nvic().pend(kIrq31);
  entry.clock(12);
  EXPECT_EQ(entry.cpu.instructions(), 0U);
  entry.clock(12);
  EXPECT_EQ(entry.cpu.instructions(), 6U);
  entry.clock(10);
  EXPECT_EQ(entry.cpu.instructions(), 6U);
  entry.clock(1);
  EXPECT_EQ(entry.cpu.instructions(), 7U);
}

// ---- Priorities (B1.5.4)

TEST(CortexPriority, MoreUrgentInterruptsNest) {
  tb::CortexRig rig;
  rig.enable(31, 0x80);
  rig.enable(32, 0x40);
  rig.cpu.nvic().pend(kIrq31);
  ASSERT_TRUE(rig.run_until([&] { return rig.logged().size() == 3 && rig.cpu.ipsr() == 0; }));
  EXPECT_THAT(rig.logged(), ElementsAre(47, 48, 47 + 0x100));
}

TEST(CortexPriority, EquallyUrgentOnesWaitAndAreTailChained) {
  tb::CortexRig rig;
  rig.enable(31, 0x40);
  rig.enable(32, 0x40);
  rig.cpu.nvic().pend(kIrq31);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == kIrq32; }));
  EXPECT_THAT(rig.logged(), ElementsAre(47, 47 + 0x100));
  EXPECT_EQ(rig.reg(kSp), 0x2000'8000U - 32);  // the one frame is still there
  EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFF9U);
  const std::uint64_t instructions = rig.cpu.instructions();
  rig.clock(CortexM3::kTailChainClocks - 1);
  EXPECT_EQ(rig.cpu.instructions(), instructions);
  rig.clock();
  EXPECT_EQ(rig.cpu.instructions(), instructions + 1);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == 0; }));
  EXPECT_THAT(rig.logged(), ElementsAre(47, 47 + 0x100, 48));
  EXPECT_EQ(rig.reg(kSp), 0x2000'8000U);
}

TEST(CortexPriority, MasksHoldInterruptsBack) {
  const auto taken = [](const auto &mask) {
    tb::CortexRig rig;
    rig.enable(32, 0x40);
    mask(rig.cpu.nvic());
    rig.cpu.nvic().pend(kIrq32);
    rig.clock(100);
    return !rig.logged().empty();
  };
  EXPECT_TRUE(taken([](Nvic &) {}));
  EXPECT_FALSE(taken([](Nvic &n) { n.primask = true; }));
  EXPECT_FALSE(taken([](Nvic &n) { n.faultmask = true; }));
  EXPECT_FALSE(taken([](Nvic &n) { n.basepri = 0x40; }));
  EXPECT_TRUE(taken([](Nvic &n) { n.basepri = 0x48; }));
  EXPECT_FALSE(taken([](Nvic &n) { n.enable(kIrq32, false); }));
}

TEST(CortexPriority, NmiIgnoresPrimask) {
  tb::CortexRig rig;
  rig.cpu.nvic().primask = true;
  rig.cpu.nvic().pend(kNmi);
  rig.clock(100);
  EXPECT_THAT(rig.logged(), ElementsAre(2));
}

// ---- Lines (B3.4.1)

TEST(CortexLine, HighLinePendsAgainAfterTheHandler) {
  tb::CortexRig rig;
  rig.enable(32);
  for (int i = 0; i < 300 && rig.logged().size() < 2; ++i) {
    rig.cpu.nvic().line(32, true);
    rig.clock();
  }
  EXPECT_THAT(rig.logged(), ElementsAre(48, 48));
}

TEST(CortexLine, ShortPulseStaysPending) {
  tb::CortexRig rig;
  rig.cpu.nvic().line(32, true);
  rig.cpu.nvic().line(32, false);
  rig.clock(50);
  EXPECT_TRUE(rig.logged().empty());
  rig.enable(32);
  rig.clock(100);
  EXPECT_THAT(rig.logged(), ElementsAre(48));
}

// ---- WFI, WFE, SEV (B1.5.18, B1.5.19)

TEST(CortexSleep, WfiUntilAnInterrupt) {
  tb::CortexRig rig;
  rig.go("wait_for_interrupt");
  rig.clock(500);
  EXPECT_EQ(rig.cpu.state(), State::kSleeping);
  EXPECT_EQ(rig.cpu.instructions(), 1U);
  rig.cpu.nvic().pend(kIrq32);  // not enabled: no reason to wake up
  rig.clock(100);
  EXPECT_EQ(rig.cpu.state(), State::kSleeping);
  rig.enable(32);
  ASSERT_TRUE(rig.finish());
  EXPECT_THAT(rig.logged(), ElementsAre(48));
}

TEST(CortexSleep, WfiWithPrimaskGoesOnWithoutTheHandler) {
  tb::CortexRig rig;
  rig.cpu.nvic().primask = true;
  rig.enable(32);
  rig.go("wait_for_interrupt");
  rig.clock(100);
  EXPECT_NE(rig.reg(7), 1U);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.finish());
  EXPECT_TRUE(rig.logged().empty());
}

TEST(CortexSleep, WfeEndsWithAnEventOrAHandler) {
  tb::CortexRig rig;
  rig.go("send_event");
  EXPECT_TRUE(rig.finish());  // SEV before: no sleep
  tb::CortexRig other;
  other.enable(32);
  other.go("wait_for_event");
  other.clock(100);
  EXPECT_EQ(other.cpu.state(), State::kSleeping);
  other.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(other.finish(1));
}

// B1.5.18: with SCR.SEVONPEND what becomes pending is an event, be it enabled or not, and it is
// kept for the next WFE. What has been pending before is none.
TEST(CortexSleep, WfeEndsWithWhatBecomesPending) {
  tb::CortexRig rig;
  rig.go("wait_for_event");
  rig.clock(100);
  rig.cpu.nvic().pend(kIrq32);  // not enabled, and SEVONPEND is 0
  rig.clock(100);
  ASSERT_EQ(rig.cpu.state(), State::kSleeping);
  ASSERT_TRUE(rig.cpu.system().write(0xE000'ED10, 4, 1U << 4));
  rig.clock(100);
  EXPECT_EQ(rig.cpu.state(), State::kSleeping);
  rig.cpu.nvic().line(31, true);
  ASSERT_TRUE(rig.finish(1));
  rig.clock(100);
  EXPECT_EQ(rig.cpu.state(), State::kSleeping);
  EXPECT_EQ(rig.reg(7), 1U);
  EXPECT_TRUE(rig.logged().empty());

  tb::CortexRig before;
  ASSERT_TRUE(before.cpu.system().write(0xE000'ED10, 4, 1U << 4));
  before.cpu.nvic().pend(kIrq32);
  before.go("wait_for_event");
  EXPECT_TRUE(before.finish(1));
}

TEST(CortexSleep, SleepOnExit) {
  tb::CortexRig rig;
  ASSERT_TRUE(rig.cpu.system().write(0xE000'ED10, 4, 2));
  rig.enable(32);
  rig.go("idle");
  rig.cpu.nvic().pend(kIrq32);
  rig.clock(200);
  EXPECT_THAT(rig.logged(), ElementsAre(48));
  EXPECT_EQ(rig.cpu.state(), State::kSleeping);
}

// ---- System exceptions

TEST(CortexSvc, IsTakenAtOnceAndReturnsBehindIt) {
  tb::CortexRig rig;
  rig.go("supervisor_call");
  ASSERT_TRUE(rig.finish());
  EXPECT_THAT(rig.logged(), ElementsAre(11));
}

TEST(CortexSvc, MaskedSvcIsAFault) {
  tb::CortexRig rig;
  rig.cpu.nvic().primask = true;
  rig.go("supervisor_call");
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted(); }));
  EXPECT_EQ(rig.cpu.fault()->kind, FaultKind::kSvc);
}

TEST(CortexPendSv, ByIcsr) {
  tb::CortexRig rig;
  ASSERT_TRUE(rig.cpu.system().write(0xE000'ED04, 4, 1U << 28));
  rig.clock(100);
  EXPECT_THAT(rig.logged(), ElementsAre(14));
}

// B3.3: a period is the reload value plus one.
TEST(CortexSysTick, PeriodInClocks) {
  tb::CortexRig rig;
  ASSERT_TRUE(rig.cpu.system().write(0xE000'E014, 4, 499));
  ASSERT_TRUE(rig.cpu.system().write(0xE000'E018, 4, 0));
  ASSERT_TRUE(rig.cpu.system().write(0xE000'E010, 4, 7));
  ASSERT_TRUE(rig.run_until([&] { return rig.logged().size() == 1; }));
  const std::uint64_t first = rig.cpu.cycles();
  ASSERT_TRUE(rig.run_until([&] { return rig.logged().size() == 101; }, 60'000));
  // A handler begins at the end of an instruction, so that one clock more or less is possible.
  EXPECT_NEAR(static_cast<double>(rig.cpu.cycles() - first), 100 * 500.0, 1.0);
  EXPECT_EQ(rig.logged().front(), 15U);
}

// B1.5.8: EXC_RETURN that does not exist, and one to Thread mode from a nested handler.
TEST(CortexReturn, InvalidReturnIsAFault) {
  tb::CortexRig rig;
  rig.handler(kIrq32, "bad_return_handler");
  rig.enable(32);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted(); }));
  EXPECT_EQ(rig.cpu.fault()->kind, FaultKind::kInvalidReturn);
  EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 18);  // INVPC
}

/// The stacked xPSR of the handler of IRQ 32, which has just been entered.
constexpr std::uint32_t kStackedXpsr = 0x2000'8000 - 4;

/// Enters the handler of IRQ 32.
void enter_irq32(tb::CortexRig &rig) {
  rig.enable(32);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == kIrq32; }));
}

// B1.5.8, B1.4.2: EPSR.T comes from the stacked xPSR, and no instruction can be executed without
// it.
TEST(CortexReturn, StackedXpsrWithoutThumbIsAFault) {
  tb::CortexRig rig;
  enter_irq32(rig);
  rig.cpu.engine().write(kStackedXpsr, 4, 0);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted(); }));
  EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 17);  // INVSTATE
  EXPECT_EQ(rig.cpu.fault()->pc, rig.address("idle"));
  EXPECT_EQ(rig.cpu.ipsr(), 0U);
  EXPECT_EQ(rig.cpu.xpsr(), 0U);
}

// The handler sees in the frame that T was 0, and mends it.
TEST(CortexReturn, UsageFaultHandlerMendsThumb) {
  tb::CortexRig rig;
  ASSERT_TRUE(rig.cpu.system().write(0xE000'ED24, 4, 7U << 16));
  enter_irq32(rig);
  rig.cpu.engine().write(kStackedXpsr, 4, 0);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == kUsageFault; }));
  EXPECT_EQ(rig.word(kStackedXpsr), 0U);
  EXPECT_EQ(rig.word(kStackedXpsr - 4), rig.address("idle"));
  rig.handler(kUsageFault, "log_handler");
  rig.cpu.engine().write(kStackedXpsr, 4, 1U << 24);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == 0; }));
  rig.clock(100);
  EXPECT_FALSE(rig.cpu.halted());
}

// B1.5.8: the stacked exception number must fit the mode that EXC_RETURN asks for.
TEST(CortexReturn, StackedExceptionNumberMustFitTheMode) {
  tb::CortexRig rig;
  enter_irq32(rig);
  rig.cpu.engine().write(kStackedXpsr, 4, 1U << 24 | kIrq31);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted(); }));
  EXPECT_EQ(rig.cpu.fault()->kind, FaultKind::kInvalidReturn);
  EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 18);  // INVPC
}

// ---- Vectors (B1.5.6, B1.5.14)

// Bit 0 of a vector becomes EPSR.T: the fault is that of the handler's first instruction.
TEST(CortexVector, EvenOneIsAUsageFaultInTheHandler) {
  tb::CortexRig rig;
  rig.cpu.engine().write(0x2000'6000 + 4 * kIrq32, 4, rig.address("log_handler"));
  enter_irq32(rig);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted(); }));
  EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 17);  // INVSTATE
  EXPECT_EQ(rig.cpu.system().hfsr(), 1U << 30);  // FORCED
  EXPECT_EQ(rig.cpu.ipsr(), kIrq32);

  tb::CortexRig served;
  served.cpu.engine().write(0x2000'6000 + 4 * kIrq32, 4, served.address("log_handler"));
  ASSERT_TRUE(served.cpu.system().write(0xE000'ED24, 4, 7U << 16));
  served.handler(kUsageFault, "log_handler");
  served.enable(32, 0x40);
  served.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(served.run_until([&] { return !served.logged().empty(); }));
  EXPECT_EQ(served.logged().front(), 6U);
}

// A vector that cannot be read: the HardFault handler takes over the frame, the exception stays
// pending.
TEST(CortexVector, UnreadableOneIsAHardFault) {
  for (const bool caught : {true, false}) {
    tb::CortexRig rig{{.catch_hard_fault = caught}};
    // The vector of HardFault is the last but 28 word of SRAM, that of IRQ 32 is behind its end.
    rig.cpu.engine().write(0x2000'FF80 + 4 * kHardFault, 4, rig.address("log_handler") | 1);
    ASSERT_TRUE(rig.cpu.system().write(0xE000'ED08, 4, 0x2000'FF80));
    rig.enable(32);
    rig.cpu.nvic().pend(kIrq32);
    rig.clock(20);
    EXPECT_EQ(rig.cpu.system().hfsr() & 2, 2U);  // VECTTBL
    EXPECT_TRUE(rig.cpu.nvic().pending(kIrq32));
    EXPECT_EQ(rig.cpu.halted(), caught);
    if (caught) {
      EXPECT_EQ(rig.cpu.fault()->kind, FaultKind::kVector);
      continue;
    }
    EXPECT_EQ(rig.cpu.ipsr(), static_cast<unsigned>(kHardFault));
    EXPECT_EQ(rig.reg(kSp), 0x2000'8000U - 32);
    EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFF9U);
  }
}

// ---- Faults of stacking and unstacking (B1.5.11): the handler gets no frame of its own

/// Goes on in Thread mode on a process stack where there is no memory for a frame.
void run_on_lost_process_stack(tb::CortexRig &rig) {
  rig.go("special_registers");
  ASSERT_TRUE(rig.run_until([&] { return rig.reg(11) == 0xA800'0000; }));
  rig.cpu.engine().set_reg(kSp, 0x2000'0010);
}

TEST(CortexEntry, EnabledBusFaultHandlerServesALostProcessStack) {
  tb::CortexRig rig;
  run_on_lost_process_stack(rig);
  ASSERT_TRUE(rig.cpu.system().write(0xE000'ED24, 4, 1U << 17));
  rig.handler(kBusFault, "spoil_handler");
  rig.enable(32);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == kBusFault; }));
  EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 12);  // STKERR
  EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFFDU);
  EXPECT_EQ(rig.cpu.psp(), 0x2000'0010U - 32);
  EXPECT_EQ(rig.reg(kSp), 0x2000'8000U);
  EXPECT_TRUE(rig.cpu.nvic().pending(kIrq32));
}

TEST(CortexEntry, HardFaultHandlerServesALostProcessStack) {
  tb::CortexRig rig{{.catch_hard_fault = false}};
  run_on_lost_process_stack(rig);
  rig.handler(kHardFault, "spoil_handler");
  rig.enable(32);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.ipsr() == kHardFault; }));
  EXPECT_EQ(rig.cpu.system().hfsr(), 1U << 30);  // FORCED
  EXPECT_EQ(rig.reg(kSp), 0x2000'8000U);
}

TEST(CortexReturn, LostProcessStack) {
  for (const bool enabled : {false, true}) {
    tb::CortexRig rig;
    rig.go("special_registers");
    ASSERT_TRUE(rig.run_until([&] { return rig.reg(11) == 0xA800'0000; }));
    ASSERT_TRUE(rig.cpu.system().write(0xE000'ED24, 4, enabled ? 1U << 17 : 0));
    rig.handler(kBusFault, "spoil_handler");
    rig.handler(kIrq32, "lose_process_stack_handler");
    enter_irq32(rig);
    ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted() || rig.cpu.ipsr() == kBusFault; }));
    EXPECT_EQ(rig.cpu.halted(), !enabled);
    EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 11);  // UNSTKERR
    EXPECT_EQ(rig.cpu.msp(), 0x2000'8000U);
    EXPECT_EQ(rig.cpu.psp(), 0x2000'FFF0U);
    if (enabled) EXPECT_EQ(rig.reg(kLr), 0xFFFF'FFFDU);
  }
}

TEST(CortexEntry, NoStackIsAFault) {
  tb::CortexRig rig;
  rig.go("empty_stack");
  rig.clock(20);
  rig.enable(32);
  rig.cpu.nvic().pend(kIrq32);
  ASSERT_TRUE(rig.run_until([&] { return rig.cpu.halted(); }));
  EXPECT_EQ(rig.cpu.fault()->kind, FaultKind::kStacking);
  EXPECT_EQ(rig.cpu.system().cfsr() & 1U << 12, 1U << 12);  // STKERR
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Accesses, system instructions and faults of the CPU model (ARMv7-M Architecture Reference Manual,
// section numbers in the comments).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/cortex_rig.hpp"

namespace {

using namespace vericansim::firmware;
using ::testing::ElementsAre;
using State = CortexM3::State;

constexpr std::uint32_t kCore = 0x4005'0000;

/// Runs a function until the CPU halts, and gives the fault.
Fault fault_of(const std::string &function, tb::CortexRig &rig) {
  rig.go(function);
  EXPECT_TRUE(rig.run_until([&] { return rig.cpu.halted(); })) << function;
  return rig.cpu.fault().value_or(Fault{});
}

// ---- Devices

TEST(CortexAccess, SizesAndDataReachTheDevice) {
  tb::CortexRig rig;
  rig.go("sizes");
  ASSERT_TRUE(rig.finish());
  struct Want {
    std::uint32_t address;
    unsigned size;
    bool write;
    std::uint32_t data;
  };
  const std::vector<Want> wanted = {
      {kCore + 0x80, 4, true, 0x89AB'CDEF}, {kCore + 0x86, 2, true, 0xCDEF},
      {kCore + 0x8B, 1, true, 0xEF},        {kCore + 0x80, 4, false, 0},
      {kCore + 0x86, 2, false, 0},          {kCore + 0x8B, 1, false, 0}};
  ASSERT_EQ(rig.bus.log.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(rig.bus.log[i].address, wanted[i].address) << i;
    EXPECT_EQ(rig.bus.log[i].size, wanted[i].size) << i;
    EXPECT_EQ(rig.bus.log[i].write, wanted[i].write) << i;
    if (wanted[i].write) {
      EXPECT_EQ(rig.bus.log[i].data, wanted[i].data) << i;
    }
  }
  EXPECT_EQ(rig.reg(2), 0x89AB'CDEFU);
  EXPECT_EQ(rig.reg(3), 0xCDEFU);
  EXPECT_EQ(rig.reg(4), 0xFFFF'FFEFU);  // sign-extended
}

// However long the device takes, each access of an instruction happens once and in order.
TEST(CortexAccess, SeveralAccessesOfOneInstruction) {
  for (const unsigned wait : {0U, 1U, 7U}) {
    tb::CortexRig rig;
    rig.bus.wait = wait;
    for (std::uint32_t i = 0; i < 32; ++i)
      rig.bus.bytes[kCore + i] = static_cast<std::uint8_t>(i + 1);
    rig.go("several_accesses");
    ASSERT_TRUE(rig.finish());
    std::vector<std::uint32_t> addresses;
    for (const DeviceAccess &access : rig.bus.log) addresses.push_back(access.address - kCore);
    EXPECT_THAT(addresses, ElementsAre(0, 4, 8, 0x10, 0x14)) << wait;
    EXPECT_EQ(rig.reg(1), 0x0403'0201U);
    EXPECT_EQ(rig.reg(3), 0x0C0B'0A09U);
    EXPECT_EQ(rig.reg(5), 0x1817'1615U);
  }
}

// A block with a store to SRAM before the device access is not executed twice.
TEST(CortexAccess, WaitingDoesNotRepeatStores) {
  tb::CortexRig rig;
  rig.cpu.engine().set_reg(0, 0x2000'1000);
  rig.cpu.engine().write(0x2000'1000, 4, 41);
  rig.go("it_block");
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.word(0x2000'1000), 42U);
  EXPECT_EQ(rig.bus.log.size(), 1U);
}

TEST(CortexAccess, WaitTakesTime) {
  std::vector<std::uint64_t> clocks;
  for (const unsigned wait : {0U, 10U}) {
    tb::CortexRig rig;
    rig.bus.wait = wait;
    rig.go("several_accesses");
    ASSERT_TRUE(rig.finish());
    clocks.push_back(rig.cpu.cycles());
  }
  EXPECT_EQ(clocks[1] - clocks[0], 5 * 10U);
}

TEST(CortexAccess, UnprivilegedCodeShowsOnTheBus) {
  tb::CortexRig rig;
  rig.go("sizes");
  ASSERT_TRUE(rig.finish());
  EXPECT_TRUE(rig.bus.privileged_log.front());
  tb::CortexRig user;
  user.go("unprivileged");
  ASSERT_TRUE(user.finish());
  EXPECT_FALSE(user.bus.privileged_log.front());
  EXPECT_EQ(user.cpu.control(), 1U);
}

TEST(CortexAccess, DeviceErrorIsABusFault) {
  tb::CortexRig rig;
  rig.bus.error = true;
  const Fault fault = fault_of("sizes", rig);
  EXPECT_EQ(fault.kind, FaultKind::kDeviceError);
  EXPECT_EQ(fault.address, kCore + 0x80);
  EXPECT_EQ(rig.cpu.system().cfsr(), 1U << 9 | 1U << 15);  // PRECISERR, BFARVALID
  EXPECT_EQ(rig.cpu.system().bfar(), kCore + 0x80);
  EXPECT_EQ(rig.cpu.system().hfsr(), 1U << 30);  // FORCED
}

// ---- Memory

TEST(CortexMemory, UnalignedAccessToRamWorks) {
  tb::CortexRig rig;
  rig.go("unaligned_ram");
  rig.clock(20);
  EXPECT_EQ(rig.reg(2), 0x0102'0304U);
}

TEST(CortexMemory, CodeRunsInRam) {
  tb::CortexRig rig;
  rig.go("run_in_ram");
  EXPECT_TRUE(rig.finish(9));
}

TEST(CortexMemory, FlashHasAMirror) {
  tb::CortexRig rig;
  EXPECT_EQ(rig.cpu.engine().read(0x6000'0000, 4), 0x2000'8000U);
  rig.cpu.engine().set_reg(kPc, 0x6000'0000 + rig.address("ten_nops"));
  rig.clock(20);
  EXPECT_EQ(rig.cpu.instructions(), 10U);
}

// ---- System control space

TEST(CortexSystemSpace, PrioritiesTakeBytesAndHaveFiveBits) {
  tb::CortexRig rig;
  rig.go("system_bytes");
  rig.clock(20);
  EXPECT_EQ(rig.reg(2), 0x5000'0000U);  // 0x55 with its lower three bits gone
}

TEST(CortexSystemSpace, OthersTakeWordsOnly) {
  tb::CortexRig rig;
  const Fault fault = fault_of("system_byte_refused", rig);
  EXPECT_EQ(fault.kind, FaultKind::kSystemSize);
  EXPECT_EQ(fault.address, 0xE000'E100U);
}

TEST(CortexSystemSpace, ResetRequest) {
  tb::CortexRig rig;
  int requests = 0;
  rig.cpu.on_reset_request = [&] { ++requests; };
  rig.go("request_reset");
  rig.clock(50);
  EXPECT_EQ(requests, 1);
}

// ---- System instructions (B5.2)

TEST(CortexInstructions, SpecialRegisters) {
  tb::CortexRig rig;
  rig.go("special_registers");
  ASSERT_TRUE(rig.run_until([&] { return rig.reg(11) == 0xA800'0000; }));
  EXPECT_EQ(rig.reg(4), 0xF8U);
  EXPECT_EQ(rig.reg(5), 0x20U);
  EXPECT_EQ(rig.reg(6), 0x20U);
  EXPECT_EQ(rig.reg(7), 1U);
  EXPECT_EQ(rig.reg(8), 1U);
  EXPECT_EQ(rig.reg(9), 2U);
  EXPECT_EQ(rig.reg(10), 0x2000'4000U);
  EXPECT_FALSE(rig.cpu.nvic().primask);
  EXPECT_FALSE(rig.cpu.nvic().faultmask);
}

TEST(CortexInstructions, ConditionalSystemInstructionIsRefused) {
  tb::CortexRig rig;
  EXPECT_EQ(fault_of("conditional_system", rig).kind, FaultKind::kSystemInIt);
}

// It is a limit of the simulation: no handler of the firmware's may take it for its own fault.
TEST(CortexInstructions, RefusalIsNotTheFirmwaresBusiness) {
  tb::CortexRig rig{{.catch_hard_fault = false}};
  ASSERT_TRUE(rig.cpu.system().write(0xE000'ED24, 4, 7U << 16));
  EXPECT_EQ(fault_of("conditional_system", rig).kind, FaultKind::kSystemInIt);
  EXPECT_EQ(rig.cpu.state(), State::kStopped);
  EXPECT_THAT(rig.logged(), ElementsAre());
}

// ---- Faults (B1.5.14): what, where, and which status bit

TEST(CortexFaults, KindAddressAndStatus) {
  struct Want {
    const char *function;
    FaultKind kind;
    std::uint32_t address;
    unsigned size;
    bool write;
    std::uint32_t cfsr;
  };
  constexpr std::uint32_t kPrecise = 1U << 9 | 1U << 15;
  const std::vector<Want> wanted = {
      {"read_nowhere", FaultKind::kAccess, 0x4006'0000, 4, false, kPrecise},
      {"write_nowhere", FaultKind::kAccess, 0x2001'0000, 1, true, kPrecise},
      {"write_flash", FaultKind::kReadOnly, 64, 4, true, kPrecise},
      {"unaligned_device", FaultKind::kUnaligned, kCore + 2, 4, false, 1U << 24},
      {"jump_nowhere", FaultKind::kFetch, 0x1000'0000, 2, false, 1U << 8},
      {"jump_to_device", FaultKind::kNotExecutable, kCore, 2, false, 1U << 0},
  };
  for (const Want &want : wanted) {
    tb::CortexRig rig;
    const Fault fault = fault_of(want.function, rig);
    EXPECT_EQ(fault.kind, want.kind) << want.function;
    EXPECT_EQ(fault.address, want.address) << want.function;
    EXPECT_EQ(fault.size, want.size) << want.function;
    EXPECT_EQ(fault.write, want.write) << want.function;
    EXPECT_EQ(rig.cpu.system().cfsr(), want.cfsr) << want.function;
    EXPECT_EQ(rig.cpu.state(), State::kStopped) << want.function;
    EXPECT_TRUE(rig.bus.log.empty()) << want.function;
  }
}

TEST(CortexFaults, BadInstructions) {
  tb::CortexRig undefined;
  const Fault fault = fault_of("undefined", undefined);
  EXPECT_EQ(fault.kind, FaultKind::kUndefined);
  EXPECT_EQ(fault.pc, undefined.address("undefined"));
  EXPECT_EQ(undefined.cpu.system().cfsr(), 1U << 16);
  tb::CortexRig arm;
  EXPECT_EQ(fault_of("jump_to_arm", arm).kind, FaultKind::kInvalidState);
  EXPECT_EQ(arm.cpu.system().cfsr(), 1U << 17);
  tb::CortexRig fpu;
  EXPECT_EQ(fault_of("floating_point", fpu).kind, FaultKind::kNoCoprocessor);
  EXPECT_EQ(fpu.cpu.system().cfsr(), 1U << 19);
  tb::CortexRig breakpoint;
  EXPECT_EQ(fault_of("breakpoint", breakpoint).kind, FaultKind::kBreakpoint);
  EXPECT_EQ(breakpoint.cpu.system().hfsr(), 1U << 31);  // DEBUGEVT
}

// SHCSR enables the handlers; the firmware deals with the fault and goes on behind it.
TEST(CortexFaults, EnabledHandlersAreEntered) {
  struct Want {
    const char *function;
    std::uint32_t exception;
  };
  for (const auto &[function, exception] :
       {Want{"read_nowhere", 5}, Want{"unaligned_device", 6}, Want{"undefined", 6}}) {
    tb::CortexRig rig;
    ASSERT_TRUE(rig.cpu.system().write(0xE000'ED24, 4, 7U << 16));
    rig.go(function);
    ASSERT_TRUE(rig.finish()) << function;
    EXPECT_THAT(rig.logged(), ElementsAre(exception)) << function;
  }
}

// B1.5.13: a fault that cannot be taken becomes a HardFault; within one the CPU locks up.
TEST(CortexFaults, HardFaultHandlerAndLockUp) {
  tb::CortexRig rig{{.catch_hard_fault = false}};
  rig.handler(kHardFault, "skip_handler");
  rig.go("read_nowhere");
  ASSERT_TRUE(rig.finish());
  EXPECT_THAT(rig.logged(), ElementsAre(3));
  tb::CortexRig locked{{.catch_hard_fault = false}};
  locked.handler(kHardFault, "read_nowhere");
  const Fault fault = fault_of("undefined", locked);
  EXPECT_EQ(locked.cpu.state(), State::kLockUp);
  EXPECT_EQ(fault.kind, FaultKind::kAccess);
}

}  // namespace

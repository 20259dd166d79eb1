// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: the CPU's loads and stores on the pins of Verilated cores, judged by the AHB checker.
#include "firmware/board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/bus.hpp"
#include "firmware/tool_run.hpp"

namespace {

using namespace vericansim;
using namespace vericansim::firmware;
using ::testing::HasSubstr;

constexpr std::uint32_t kVectorsInRam = 0x2000'6000;

/// One or two cores on a bus of their own, and the CPU in step with them.
struct Rig {
  explicit Rig(const std::string &program, unsigned count = 1)
      : nodes{make_nodes(count)}, board{"board", read_elf(tb::test_elf(program)), pointers()} {
    for (const auto &node : nodes) bus.add(*node);
    // After a reset the core first clears its buffers; the CPU of this rig is let loose afterwards.
    for (int i = 0; i < 2000; ++i) bus.step();
  }
  static std::vector<std::unique_ptr<RtlNode>> make_nodes(unsigned count) {
    std::vector<std::unique_ptr<RtlNode>> result;
    for (unsigned i = 0; i < count; ++i) result.push_back(RtlNode::create("core"));
    return result;
  }
  std::vector<RtlNode *> pointers() const {
    std::vector<RtlNode *> result;
    for (const auto &node : nodes) result.push_back(node.get());
    return result;
  }
  void go(const std::string &function) {
    for (const ElfSymbol &symbol : board.image().functions)
      if (symbol.name == function) board.cpu().engine().set_reg(kPc, symbol.address);
  }
  bool finish(unsigned limit = 3000) {
    for (unsigned i = 0; i < limit && board.cpu().engine().reg(7) != 1 && !board.ended(); ++i) {
      bus.step();
      board.clock();
    }
    return board.cpu().engine().reg(7) == 1;
  }

  std::vector<std::unique_ptr<RtlNode>> nodes;
  Board board;
  Bus bus;
};

// Buffer RAM takes all sizes (flexcan.md 0: byte lanes).
TEST(Board, SizesReachTheCore) {
  Rig rig{"cpu"};
  rig.go("sizes");
  ASSERT_TRUE(rig.finish());
  const BusReport &ahb = rig.nodes[0]->ahb().report();
  EXPECT_EQ(ahb.transfers, 6U);
  EXPECT_EQ(ahb.errors, 0U);
  EXPECT_THAT(ahb.violations, ::testing::IsEmpty());
  const Engine &cpu = rig.board.cpu().engine();
  // C/S keeps CODE, SRR..DLC and the time stamp of 0x89ABCDEF.
  EXPECT_EQ(cpu.reg(2), 0x89AB'CDEFU & 0x0F7F'FFFFU);
  EXPECT_EQ(cpu.reg(3), 0xCDEFU);
  EXPECT_EQ(cpu.reg(4), 0xFFFF'FFEFU);
  // In the core's own view: upper half of the ID word, top byte of the first data word.
  EXPECT_EQ(rig.nodes[0]->read32(0x84) >> 16, 0xCDEFU);
  EXPECT_EQ(rig.nodes[0]->read32(0x88) >> 24, 0xEFU);
}

TEST(Board, BackToBackAccessesOfOneInstruction) {
  Rig rig{"cpu"};
  rig.go("several_accesses");
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.nodes[0]->ahb().report().transfers, 5U);
  EXPECT_EQ(rig.board.cpu().engine().reg(1), 0xD890'000FU);  // MCR after reset (flexcan.md 1)
}

// An access takes its address and its data cycle; the CPU goes on when the answer is there.
TEST(Board, AccessTakesTwoClocksMore) {
  Rig rig{"cpu"};
  rig.go("several_accesses");
  ASSERT_TRUE(rig.finish());
  // Four instructions, two clocks each (one clock for the last one to take effect), five accesses.
  EXPECT_EQ(rig.board.cpu().cycles(),
            3 * 2 + 5 * 2 + 1U + rig.nodes[0]->ahb().report().wait_states);
}

TEST(Board, SecondCoreHasAWindowOfItsOwn) {
  Rig rig{"second_core", 2};
  while (!rig.board.ended()) {
    rig.bus.step();
    rig.board.clock();
  }
  EXPECT_EQ(rig.board.exit_code(), 0);
  EXPECT_EQ(rig.nodes[0]->ahb().report().transfers, 2U);
  EXPECT_EQ(rig.nodes[1]->ahb().report().transfers, 2U);
}

TEST(Board, WithoutSecondCoreItsWindowIsEmpty) {
  Rig rig{"second_core"};
  for (int i = 0; i < 200 && !rig.board.ended(); ++i) {
    rig.bus.step();
    rig.board.clock();
  }
  ASSERT_TRUE(rig.board.cpu().halted());
  EXPECT_EQ(rig.board.cpu().fault()->address, 0x4005'2080U);
  EXPECT_THAT(rig.board.report(), HasSubstr("write of 4 bytes to 0x40052080: nothing is there"));
}

// The core's interrupt line is IRQ 31, the second one's IRQ 32.
TEST(Board, InterruptLines) {
  for (const unsigned core : {0U, 1U}) {
    Rig rig{"cpu", 2};
    CortexM3 &cpu = rig.board.cpu();
    cpu.engine().write(0x2000'0000, 4, 0x2000'0004);
    // IRQ 31's handler of the program does more than log: both get the one that logs.
    for (unsigned i = 0; i < kIrq0 + 33; ++i)
      cpu.engine().write(kVectorsInRam + 4 * i, 4, *cpu.engine().read(4 * (kIrq0 + 32), 4));
    ASSERT_TRUE(cpu.system().write(0xE000'ED08, 4, kVectorsInRam));
    for (const unsigned irq : {31U, 32U}) cpu.nvic().enable(kIrq0 + irq, true);
    // A frame in loop-back would do; a wake-up needs less: WAK_INT comes from the flags, so take
    // MB0's flag by a loop-back transmission.
    RtlNode &node = *rig.nodes[core];
    node.write32(0x000, 0x5000'000F);   // freeze
    node.write32(0x004, 0x00DB'1006);   // 25 quanta, loop-back
    node.write32(0x028, 1);             // IMASK1
    node.write32(0x084, 0x123U << 18);  // ID
    node.write32(0x080, 0x0C00'0000);   // send
    node.write32(0x000, 0x0000'000F);   // go
    for (int i = 0; i < 20000 && cpu.engine().read(0x2000'0000, 4) == 0x2000'0004U; ++i) {
      rig.bus.step();
      rig.board.clock();
    }
    EXPECT_EQ(cpu.engine().read(0x2000'0004, 4), kIrq0 + 31 + core);
  }
}

TEST(Board, OutputAndExitCode) {
  Rig rig{"semihosting"};
  std::string printed;
  rig.board.set_output([&](std::string_view text) { printed += text; });
  while (!rig.board.ended()) {
    rig.bus.step();
    rig.board.clock();
  }
  EXPECT_EQ(printed, "hello\n");
  EXPECT_EQ(rig.board.exit_code(), 3);
}

TEST(Board, ResetRequestStartsOver) {
  Rig rig{"cpu"};
  rig.nodes[0]->write32(0x004, 0x00DB'0006);  // CTRL: only a hard reset clears it
  rig.go("request_reset");
  for (int i = 0; i < 40; ++i) {
    rig.bus.step();
    rig.board.clock();
  }
  EXPECT_EQ(rig.nodes[0]->read32(0x004), 0U);
  EXPECT_FALSE(rig.board.ended());
}

}  // namespace

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_port alone: who comes first at the read port and at the write port, and what the CPU reads
// of a word that is written in that clock.
#include <gtest/gtest.h>

#include <utility>

#include "Vcan_mb_port.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class MbPort : public ::testing::Test {
 protected:
  MbPort() {
    port_->cmd_be_i = 0xF;
    port_.reset();
    for (unsigned i = 0; i < 300; ++i) port_.clock();  // every row is cleared
    port_.settle();
    EXPECT_FALSE(port_->scrub_o);
  }
  void clock() {
    port_.clock();
    port_.settle();
  }
  /// A read of the CPU in its command phase, in every clock from now on; or none.
  void reads(bool on) {
    port_->cmd_slot_i = port_->cmd_rd_i = on;
    port_.settle();
  }
  /// The same for writes.
  void writes(bool on) {
    port_->cmd_wr_i = on;
    port_.settle();
  }
  void engine(bool on) {
    port_->eng_req_i = on;
    port_.settle();
  }
  LeafModel<Vcan_mb_port> port_;
};

TEST_F(MbPort, CpuReadsBeforeAnEngineThatWasNotRefused) {
  engine(true);
  for (unsigned i = 0; i < 3; ++i, clock()) EXPECT_TRUE(port_->eng_slot_o);
  reads(true);
  EXPECT_FALSE(port_->eng_slot_o);
  clock();
  EXPECT_TRUE(port_->ready_o) << "no wait state";
}

TEST_F(MbPort, EngineThatWasRefusedReadsBeforeTheCpu) {
  engine(true);
  reads(true);
  unsigned grants = 0;
  for (unsigned i = 0; i < 30; ++i, clock()) {
    grants += port_->eng_slot_o;
    reads(port_->ready_o != 0);  // a command only where it is taken
  }
  EXPECT_GE(grants, 10u) << "one slot in three at the least";
  for (unsigned waits = 0; port_->ready_o == 0; ++waits, clock()) ASSERT_LE(waits, 1u);
}

TEST_F(MbPort, EngineRefusedByAnInsertionReadsBeforeTheCpu) {
  engine(true);
  port_->ins_req_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->ins_gnt_o);
  EXPECT_FALSE(port_->eng_slot_o);
  clock();
  port_->ins_req_i = 0;
  reads(true);
  EXPECT_TRUE(port_->eng_slot_o);
  clock();
  EXPECT_FALSE(port_->ready_o) << "the CPU waits for one clock";
  clock();
  EXPECT_TRUE(port_->ready_o);
}

// A serviced mark goes first once; a CPU that writes in every clock does not keep it out.
TEST_F(MbPort, ServicedMarkComesBeforeAWriteThatHasNotWaited) {  // FX-3.6.g
  writes(true);
  clock();
  port_->serviced_req_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->serviced_gnt_o);
  EXPECT_FALSE(port_->ready_o);
  clock();
  EXPECT_FALSE(port_->serviced_gnt_o) << "another one";
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, SecondHalfOfACopyComesBeforeAWriteThatHasNotWaited) {
  writes(true);
  clock();
  port_->copy_i = 1;
  port_.settle();
  EXPECT_FALSE(port_->hold_o);
  EXPECT_FALSE(port_->ready_o);
  clock();
  EXPECT_TRUE(port_->hold_o) << "another one";
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, NobodyWaitsInReset) {
  engine(true);
  reads(true);
  clock();
  clock();
  EXPECT_FALSE(port_->ready_o);
  port_->rst_ni = 0;
  port_.settle();
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, EngineWriteThatWasRefusedComesBeforeTheCpu) {
  writes(true);
  clock();
  port_->rx_wr_req_i = 1;
  port_.settle();
  EXPECT_FALSE(port_->rx_wr_gnt_o);
  EXPECT_TRUE(port_->ready_o);
  clock();
  EXPECT_TRUE(port_->rx_wr_gnt_o);
  EXPECT_FALSE(port_->ready_o);
}

TEST_F(MbPort, WriteThatLooksAtItsCsWordWaitsForOneClock) {  // FX-3.3.j
  for (const bool look : {true, false, true}) {
    port_->cmd_look_i = 1;
    port_->look_i = !look;  // AEN is written in the clock of the command
    writes(true);
    clock();
    port_->look_i = look;
    writes(false);  // a command only where it is taken
    EXPECT_EQ(port_->ready_o && port_->wr_done_o, !look);
    if (!look) continue;
    clock();
    EXPECT_TRUE(port_->ready_o && port_->wr_done_o);
  }
}

// A block RAM answers nothing certain to a read of a word that is being written; the CPU reads it
// again, but for the word that a copy shows.
class MbPortCollision : public MbPort {
 protected:
  static constexpr unsigned Cs = 0, Msg = 1, Mask = 2;
  /// The CPU writes `value` to buffer 5's word of `kind`.
  void fill(unsigned mem_sel, unsigned word, unsigned value) {
    command(mem_sel, word, 5);
    writes(true);
    clock();
    writes(false);
    port_->wdata_i = value;
    clock();
  }
  /// Puts the CPU's read of a word into this clock.
  void read(unsigned mem_sel, unsigned word, unsigned idx = 5) {
    command(mem_sel, word, idx);
    reads(true);
  }
  /// What that read gives, one clock later; or another one, if it is read again.
  unsigned answer(bool again = false) {
    clock();
    nothing_is_written();
    EXPECT_EQ(port_->ready_o && port_->rd_done_o, !again);
    if (again) clock();
    EXPECT_TRUE(port_->ready_o && port_->rd_done_o);
    return port_->rdata_o;
  }
  void nothing_is_written() {
    reads(false);
    port_->rx_wr_req_i = port_->serviced_req_i = port_->copy_i = 0;
    port_.settle();
  }
  /// A write of the engine in this clock, of the bytes `we`.
  void engine_writes(unsigned mem_sel, unsigned row, unsigned we, unsigned value) {
    port_->rx_wr_req_i = 1;
    port_->rx_wr_cs_i = mem_sel == Cs;
    port_->rx_wr_be_i = we;
    port_->rx_wr_row_i = row;
    port_->rx_wr_data_i = value;
    port_.settle();
    EXPECT_TRUE(port_->rx_wr_gnt_o);
  }
  /// A copy of the word on the RAM outputs in this clock, of the bytes `we`.
  void copies(unsigned mem_sel, unsigned row, unsigned we, unsigned value) {
    port_->copy_i = 1;
    port_->copy_cs_i = mem_sel == Cs;
    port_->copy_be_i = we;
    port_->copy_row_i = row;
    port_->copy_data_i = value;
    port_.settle();
  }
  void command(unsigned mem_sel, unsigned word, unsigned idx) {
    port_->cmd_mem_sel_i = mem_sel;
    port_->cmd_word_i = word;
    port_->cmd_idx_i = idx;
  }
};

TEST_F(MbPortCollision, ReadMeetsACopyOfTheControlWord) {
  fill(Cs, 3, 0x01234567);
  read(Cs, 3);
  copies(Cs, 5, 0b1011, 0x89ABCDEF);
  EXPECT_EQ(answer(true), 0x8923CDEFu);
}

TEST_F(MbPortCollision, ReadMeetsACopyOfEachDataWord) {
  for (unsigned word = 0; word < 3; ++word) {
    fill(Msg, word, 0x01234567);
    read(Msg, word);
    copies(Msg, word * 64 + 5, 0b1111, 0x89ABCDEF);
    EXPECT_EQ(answer(true), 0x89ABCDEFu) << "word " << word;
  }
}

TEST_F(MbPortCollision, ReadOfAnotherRowDoesNotWait) {
  fill(Cs, 3, 0x01234567);
  fill(Msg, 1, 0x76543210);
  const auto written = [](unsigned row) { return row % 2 != 0 ? 0xFFFFFFFF : 0x00000000; };
  for (const bool copy : {false, true}) {
    const auto write = [&](unsigned mem_sel, unsigned row) {
      if (copy)
        copies(mem_sel, row, 0b1111, written(row));
      else
        engine_writes(mem_sel, row, 0b1111, written(row));
    };
    for (unsigned row = 0; row < 128; ++row) {  // the hidden ones behind the buffers', too
      if (row == 5) continue;
      SCOPED_TRACE(row);
      read(Cs, 3);
      write(Cs, row);
      ASSERT_EQ(answer(), 0x01234567u);
    }
    for (unsigned row = 0; row < 256; ++row) {
      if (row == 64 + 5) continue;
      SCOPED_TRACE(row);
      read(Msg, 1);
      write(Msg, row);
      ASSERT_EQ(answer(), 0x76543210u);
    }
    read(Msg, 1);
    write(Cs, 5);  // the same buffer in the other RAM
    EXPECT_EQ(answer(), 0x76543210u);
    fill(Cs, 3, 0x01234567);
  }
}

TEST_F(MbPortCollision, ReadMeetsTheServicedMark) {  // FX-3.6.g
  fill(Cs, 3, 0x01234567);
  read(Cs, 3);
  port_->serviced_req_i = 1;
  port_->serviced_idx_i = 5;
  port_->serviced_ovr_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->serviced_gnt_o);
  EXPECT_EQ(answer(true), 0x86234567u);
}

// In the second clock of a read its word is not marked; another one is.
TEST_F(MbPortCollision, ServicedMarkWaitsForAReadThatHasWaited) {  // FX-3.6.g
  for (const unsigned marked : {4u, 5u}) {
    fill(Cs, 3, 0x01234567);
    port_->ins_req_i = 1;
    read(Cs, 3);
    clock();
    port_->ins_req_i = 0;
    reads(false);
    port_->serviced_req_i = 1;
    port_->serviced_idx_i = marked;
    port_.settle();
    EXPECT_EQ(port_->serviced_gnt_o != 0, marked != 5);
    clock();
    EXPECT_TRUE(port_->serviced_gnt_o) << "now at the latest";
    EXPECT_EQ(port_->rdata_o, 0x01234567u);
    clock();
    nothing_is_written();
  }
}

// What a copy writes stands on the RAM outputs: a read that has waited gets it from there.
TEST_F(MbPortCollision, ReadThatHasWaitedMeetsTheSecondHalfOfACopy) {
  fill(Cs, 3, 0x01234567);
  fill(Msg, 2, 0x00112233);
  command(Msg, 2, 5);
  fill(Msg, 0, 0x44556677);
  for (const bool same : {false, true}) {
    port_->eng_req_i = port_->ins_req_i = 0;
    port_->ins_req_i = 1;  // reads the row that is copied
    port_->ins_idx_i = 5;
    read(Msg, 2);
    clock();
    port_->ins_req_i = 0;
    reads(false);
    EXPECT_EQ(port_->msg_o, 0x44556677u);
    EXPECT_FALSE(port_->ready_o);
    copies(Msg, (same ? 128 : 64) + 5, 0b1111, 0x44556677);
    clock();
    nothing_is_written();
    EXPECT_TRUE(port_->ready_o && port_->rd_done_o);
    EXPECT_EQ(port_->rdata_o, same ? 0x44556677u : 0x00112233u);
    clock();
  }
  read(Msg, 2);
  EXPECT_EQ(answer(), 0x44556677u) << "and it is there";
}

TEST_F(MbPortCollision, ReadMeetsAWriteOfTheCpu) {
  for (unsigned mem_sel : {Cs, Msg, Mask}) {
    fill(mem_sel, 1, 0x01234567);
    writes(true);
    clock();
    writes(false);
    port_->wdata_i = 0x89ABCDEF;
    read(mem_sel, 1);
    EXPECT_EQ(answer(true), 0x89ABCDEFu) << "mem_sel " << mem_sel;
    clock();
    EXPECT_EQ((read(mem_sel, 1), answer()), 0x89ABCDEFu) << "mem_sel " << mem_sel;
  }
}

TEST_F(MbPortCollision, EngineIsToldThatAWordWasBeingWritten) {
  const auto read = [this](unsigned mem_sel, unsigned row, unsigned written, unsigned we) {
    port_->eng_req_i = 1;
    port_->eng_cs_row_i = port_->eng_msg_row_i = row;
    engine_writes(mem_sel, written, we, 0);
    EXPECT_TRUE(port_->eng_slot_o);
    clock();
    const std::pair told{port_->stale_o != 0, port_->id_stale_o != 0};
    port_->rx_wr_req_i = 0;
    clock();
    EXPECT_FALSE(port_->stale_o || port_->id_stale_o) << "one clock later";
    return told;
  };
  EXPECT_EQ(read(Cs, 5, 5, 0b1000), (std::pair{true, false}));
  EXPECT_EQ(read(Cs, 5, 5, 0b0111), (std::pair{false, false})) << "the code stays";
  EXPECT_EQ(read(Cs, 5, 6, 0b1111), (std::pair{false, false}));
  for (unsigned we = 1; we < 16; we <<= 1)
    EXPECT_EQ(read(Msg, 5, 5, we), (std::pair{false, true})) << we;
  EXPECT_EQ(read(Msg, 5, 64 + 5, 0b1111), (std::pair{false, false})) << "another word";
  EXPECT_EQ(read(Msg, 5, 4, 0b1111), (std::pair{false, false}));
  EXPECT_EQ(read(Msg, 5, 5, 0), (std::pair{false, false}));
}

TEST_F(MbPortCollision, WriteThatIsRefusedIsNotRead) {
  fill(Msg, 1, 0x01234567);
  writes(true);
  clock();
  writes(false);
  port_->wdata_i = 0x89ABCDEF;
  port_->block_i = 1;
  read(Msg, 1);
  EXPECT_EQ(answer(true), 0x01234567u);
}

// A write's look at the C/S word: what the RAM holds, with the outputs kept if a copy writes it.
TEST_F(MbPortCollision, WriteLooksAtItsCsWord) {  // FX-3.3.j
  fill(Cs, 3, 0x41234567);
  for (const unsigned mem_sel : {Cs, Msg}) {
    command(mem_sel, 1, 5);
    port_->cmd_look_i = port_->look_i = port_->block_i = 1;
    writes(true);
    clock();
    writes(false);
    clock();
    EXPECT_EQ(port_->cs_o, 0x41234567u) << mem_sel;
    clock();
  }
}

}  // namespace
}  // namespace vericansim

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
  static constexpr unsigned Cs = 0, Msg = 1, Mask = 2, Timer = 3;
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
  void command(unsigned mem_sel, unsigned word, unsigned idx) {
    port_->cmd_mem_sel_i = mem_sel;
    port_->cmd_word_i = word;
    port_->cmd_idx_i = port_->row_idx_i = idx;
  }
  /// A read of the CPU in its command phase, in every clock from now on; or none.
  void reads(bool on) {
    port_->cmd_rd_i = on;
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
  /// The first clock of one access.
  void begin_read() {
    reads(true);
    clock();
    reads(false);
  }
  void begin_write() {
    writes(true);
    clock();
    writes(false);
  }
  LeafModel<Vcan_mb_port> port_;
};

// Whatever the engine wants, an access has two clocks.
TEST_F(MbPort, EachAccessWaitsForOneClock) {
  port_->eng_req_i = port_->ins_req_i = port_->serviced_req_i = port_->rx_wr_req_i = 1;
  for (const bool copy : {false, true}) {
    port_->copy_i = copy;
    for (const unsigned mem_sel : {Cs, Msg, Mask, Timer}) {
      command(mem_sel, 0, 5);
      begin_read();
      EXPECT_FALSE(port_->ready_o || port_->rd_done_o);
      clock();
      EXPECT_TRUE(port_->ready_o && port_->rd_done_o);
      clock();
      EXPECT_TRUE(port_->ready_o) << "none is under way";
      begin_write();
      EXPECT_FALSE(port_->ready_o || port_->wr_done_o);
      EXPECT_TRUE(port_->wr_o);
      clock();
      EXPECT_TRUE(port_->ready_o && port_->wr_done_o);
      clock();
      EXPECT_FALSE(port_->rd_done_o || port_->wr_o);
    }
  }
}

// The first clock is the CPU's: a write looks at its buffer's C/S word.
TEST_F(MbPort, CpuReadsInItsFirstClock) {  // FX-3.3.j
  engine(true);
  EXPECT_TRUE(port_->eng_slot_o);
  for (const bool write : {false, true}) {
    write ? begin_write() : begin_read();
    EXPECT_FALSE(port_->eng_slot_o);
    clock();
    EXPECT_TRUE(port_->eng_slot_o);
    clock();
  }
}

TEST_F(MbPort, InsertionComesBeforeTheEngine) {
  engine(true);
  port_->ins_req_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->ins_gnt_o);
  EXPECT_FALSE(port_->eng_slot_o);
  begin_read();
  EXPECT_FALSE(port_->ins_gnt_o) << "not before the CPU";
}

// A CPU that asks for an insertion with each access leaves the engine five slots of six at least.
TEST_F(MbPort, InsertionsInARowMakeRoomForTheEngine) {
  engine(true);
  port_->ins_req_i = 1;
  for (const bool busy : {false, true}) {
    unsigned grants = 0, slots = 0;
    for (unsigned i = 0; i < 240; ++i, clock()) {
      writes(busy);
      grants += port_->ins_gnt_o;
      slots += port_->eng_slot_o;
      EXPECT_FALSE(port_->ins_gnt_o && port_->eng_slot_o);
    }
    EXPECT_EQ(grants + slots, busy ? 120u : 240u) << "no slot is lost";
    EXPECT_LE(grants, busy ? 20u : 40u);
    EXPECT_GE(grants, busy ? 16u : 33u);
  }
}

// A pass asks for no slot in the clock behind one, and has its turns all the same.
TEST_F(MbPort, InsertionsDoNotShutOutAPass) {
  for (const bool busy : {false, true}) {
    bool gap = false;
    unsigned grants = 0, reads = 0;
    for (unsigned i = 0; i < 240; ++i, clock()) {
      writes(busy);
      port_->eng_pass_i = 1;
      port_->eng_req_i = port_->ins_req_i = !gap;
      port_.settle();
      const bool read = port_->eng_req_i != 0 && port_->eng_slot_o != 0;
      grants += port_->ins_gnt_o;
      reads += read;
      gap = read || port_->ins_gnt_o != 0;
    }
    EXPECT_GE(grants, 15u);
    EXPECT_GE(reads, 80u) << busy;
  }
}

TEST_F(MbPort, InsertionsInARowHaveWhatIsWantedForEsr2Alone) {
  port_->ins_req_i = port_->eng_req_i = port_->eng_lazy_i = 1;
  port_.settle();
  for (unsigned i = 0; i < 20; ++i, clock()) EXPECT_TRUE(port_->ins_gnt_o);
}

TEST_F(MbPort, ServicedMarkWaitsForACopyAndForAWrite) {  // FX-3.6.g
  port_->serviced_req_i = 1;
  port_->copy_i = 1;
  port_.settle();
  EXPECT_FALSE(port_->serviced_gnt_o);
  port_->copy_i = 0;
  port_.settle();
  EXPECT_TRUE(port_->serviced_gnt_o);
  command(Cs, 3, 7);
  begin_write();
  EXPECT_TRUE(port_->serviced_gnt_o);
  clock();
  EXPECT_FALSE(port_->serviced_gnt_o);
  clock();
  EXPECT_TRUE(port_->serviced_gnt_o);
}

// Writes of one buffer's words in a row: its mark gets in with the first look at the C/S word, and
// the frame being received with the others.
TEST_F(MbPort, WritesInARowShutOutNeitherTheMarkNorTheFrameBeingReceived) {  // FX-3.6.g
  command(Msg, 1, 5);
  begin_write();
  port_->serviced_idx_i = 5;
  port_->serviced_req_i = port_->rx_wr_req_i = 1;
  unsigned marks = 0, words = 0;
  for (unsigned i = 0; i < 40; ++i, clock()) {
    writes(true);
    words += port_->rx_wr_gnt_o;
    if (port_->serviced_gnt_o == 0) continue;
    EXPECT_EQ(i, 0u);
    ++marks;
    clock();
    port_->serviced_req_i = 0;
    port_.settle();
  }
  EXPECT_EQ(marks, 1u);
  EXPECT_GE(words, 19u);
}

TEST_F(MbPort, NobodyWaitsInReset) {
  engine(true);
  begin_read();
  EXPECT_FALSE(port_->ready_o);
  port_->rst_ni = 0;
  port_.settle();
  EXPECT_TRUE(port_->ready_o);
}

TEST_F(MbPort, EngineWritesWhenNobodyElseDoes) {
  port_->rx_wr_req_i = 1;
  port_.settle();
  EXPECT_TRUE(port_->rx_wr_gnt_o);
  for (auto *other : {&port_->copy_i, &port_->serviced_req_i}) {
    *other = 1;
    port_.settle();
    EXPECT_FALSE(port_->rx_wr_gnt_o);
    clock();
    *other = 0;
    port_.settle();
    EXPECT_TRUE(port_->rx_wr_gnt_o);
    clock();
  }
  command(Msg, 0, 7);
  begin_write();
  EXPECT_TRUE(port_->rx_wr_gnt_o);
  clock();
  EXPECT_FALSE(port_->rx_wr_gnt_o);
  clock();
  EXPECT_TRUE(port_->rx_wr_gnt_o);
}

// A block RAM answers nothing certain to a read of a word that is being written. While the CPU
// reads nobody writes its word but a copy, which shows it.
class MbPortCollision : public MbPort {
 protected:
  /// The CPU writes `value` to buffer 5's word of `mem_sel`.
  void fill(unsigned mem_sel, unsigned word, unsigned value) {
    command(mem_sel, word, 5);
    begin_write();
    port_->wdata_i = value;
    clock();
    clock();
  }
  /// The first clock of the CPU's read of a word.
  void read(unsigned mem_sel, unsigned word, unsigned idx = 5) {
    command(mem_sel, word, idx);
    begin_read();
  }
  /// What that read gives, one clock later.
  unsigned answer() {
    clock();
    nothing_is_written();
    EXPECT_TRUE(port_->ready_o && port_->rd_done_o);
    return rdata();
  }
  unsigned rdata() { return port_->rd_word_o != 0 ? port_->word_o : port_->rdata_o; }
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
};

TEST_F(MbPortCollision, ReadOfAnotherRowSeesNothingOfAWrite) {
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

// In the first clock of a read no word is marked: it might be its own.
TEST_F(MbPortCollision, ServicedMarkWaitsForARead) {  // FX-3.6.g
  for (const unsigned marked : {4u, 5u}) {
    fill(Cs, 3, 0x01234567);
    read(Cs, 3);
    port_->serviced_req_i = 1;
    port_->serviced_idx_i = marked;
    port_->serviced_ovr_i = 1;
    port_.settle();
    EXPECT_FALSE(port_->serviced_gnt_o);
    clock();
    EXPECT_TRUE(port_->serviced_gnt_o) << "now at the latest";
    EXPECT_EQ(rdata(), 0x01234567u);
    clock();
    nothing_is_written();
    read(Cs, 3);
    EXPECT_EQ(answer(), marked == 5 ? 0x86234567u : 0x01234567u);
    clock();
  }
}

// What a copy writes stands on the RAM outputs: a read of that word gets it from there, unless the
// copy has been withdrawn.
TEST_F(MbPortCollision, ReadMeetsTheSecondHalfOfACopy) {
  for (const bool same : {false, true}) {
    for (const bool off : {false, true}) {
      fill(Msg, 2, 0x00112233);
      fill(Msg, 0, 0x44556677);
      command(Msg, 2, 5);
      reads(true);
      port_->ins_req_i = 1;  // reads the row that is copied
      port_->ins_idx_i = 5;
      clock();
      port_->ins_req_i = 0;
      reads(false);
      EXPECT_EQ(port_->msg_o, 0x44556677u);
      copies(Msg, (same ? 128 : 64) + 5, 0b1111, 0x44556677);
      port_->copy_off_i = off;
      EXPECT_EQ(answer(), same && !off ? 0x44556677u : 0x00112233u);
      clock();
      read(Msg, 2);
      EXPECT_EQ(answer(), same && !off ? 0x44556677u : 0x00112233u) << "and it is there";
      clock();
    }
  }
}

// Of a frame that has been sent the outputs show the word as it was, so another block knows of the
// code.
TEST_F(MbPortCollision, ReadMeetsTheEndOfAFrameSent) {
  for (const bool end : {false, true}) {
    for (const unsigned idx : {5u, 6u}) {
      read(Cs, 3);
      copies(Cs, idx, 0b1011, 0x08001234);
      port_->copy_end_i = end;
      clock();
      nothing_is_written();
      EXPECT_EQ(port_->rd_end_o != 0, end && idx == 5);
      clock();
      EXPECT_FALSE(port_->rd_end_o);
    }
  }
}

TEST_F(MbPortCollision, ReadRightBehindAWriteOfTheCpu) {
  for (unsigned mem_sel : {Cs, Msg, Mask}) {
    fill(mem_sel, 1, 0x01234567);
    begin_write();
    port_->wdata_i = 0x89ABCDEF;
    clock();
    read(mem_sel, 1);
    EXPECT_EQ(answer(), 0x89ABCDEFu) << "mem_sel " << mem_sel;
    clock();
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

// Because it goes to the memory of the Rx FIFO, or by AEN: whatever the look at the C/S word
// brings, or if that says that a transmission has ended.
TEST_F(MbPortCollision, WriteThatIsRefusedLeavesTheWord) {  // FX-3.3.j, FX-4.a
  enum { kNo, kRing, kBlock, kIfEnded };
  for (const bool ended : {false, true}) {
    for (const auto why : {kNo, kRing, kBlock, kIfEnded}) {
      fill(Cs, 3, ended ? 0x40000000 : 0);
      fill(Msg, 1, 0x01234567);
      begin_write();
      port_->wdata_i = 0x89ABCDEF;
      port_->ring_i = why == kRing;
      clock();
      port_->block_i = why == kBlock;
      port_->if_ended_i = why == kIfEnded;
      port_->ring_i = 0;
      read(Msg, 1);
      port_->block_i = port_->if_ended_i = 0;
      const bool written = why == kNo || (why == kIfEnded && !ended);
      EXPECT_EQ(answer(), written ? 0x89ABCDEFu : 0x01234567u) << why << " " << ended;
      clock();
    }
  }
}

// A write's look at the C/S word is there in the clock in which it writes.
TEST_F(MbPortCollision, WriteLooksAtItsCsWord) {  // FX-3.3.j
  fill(Cs, 3, 0x41234567);
  for (const unsigned mem_sel : {Cs, Msg}) {
    command(mem_sel, 1, 5);
    port_->block_i = 1;
    begin_write();
    clock();
    EXPECT_EQ(port_->cs_o, 0x41234567u) << mem_sel;
    clock();
  }
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_cpu alone: what the buffers' blocks are told of a C/S word that the CPU has written.
#include <gtest/gtest.h>

#include "Vcan_mb_cpu.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

class MbCpu : public ::testing::Test {
 protected:
  MbCpu() { cpu_.reset(); }
  /// The first clock of an access, in which its place is looked up.
  void begin(unsigned mem_sel, unsigned idx) {
    cpu_->mem_sel_i = mem_sel;
    cpu_->idx_i = idx;
    cpu_.settle();
  }
  void write(unsigned idx, unsigned lanes, unsigned code) {
    begin(0, idx);
    cpu_.clock();
    cpu_->wr_done_i = 1;
    cpu_->be3_i = lanes >> 3;
    cpu_->wdata_i = code << 24;
    cpu_.settle();
    cpu_.clock();
    cpu_->wr_done_i = 0;
    cpu_.settle();
  }
  LeafModel<Vcan_mb_cpu> cpu_;
};

// Without the top byte the code may be any: never less than a code that may be sent.
TEST_F(MbCpu, PartsOfAWordAreNotTakenForMore) {  // FX-3.4.g
  for (unsigned lanes = 1; lanes < 16; ++lanes) {
    for (unsigned code = 0; code < 16; ++code) {
      write(lanes, lanes, code);
      EXPECT_TRUE(cpu_->cs_written_o);
      EXPECT_EQ(cpu_->cs_written_idx_o, lanes);
      EXPECT_EQ(cpu_->cs_written_act_o != 0, (lanes & 8) == 0 || code == 0xC || code == 0xE)
          << lanes << " " << code;
      cpu_.clock();
      cpu_.settle();
      EXPECT_FALSE(cpu_->cs_written_o);
    }
  }
}

// Words of the filter table are no C/S words, whatever they hold.
TEST_F(MbCpu, FilterWordsAreNoCsWords) {  // FX-4.a, FX-ESR2.VPS
  cpu_->fen_i = 1;
  cpu_->first_i = 10;
  for (unsigned idx = 6; idx < 14; ++idx) {
    write(idx, 15, 0xC);
    EXPECT_EQ(cpu_->cs_written_o != 0, idx >= 10) << idx;
    cpu_.clock();
  }
}

// A frame that ends while its C/S word is read: the code that it has then, to the reader and to
// the lock.
TEST_F(MbCpu, CodeOfAFrameThatHasJustBeenSent) {               // FX-3.4.c, FX-3.6.a
  for (const unsigned end : {0x0u, 0x4u, 0x8u, 0x9u, 0xAu}) {  // 0: none
    begin(0, 5);
    cpu_.clock();
    cpu_->rd_done_i = 1;
    cpu_->rd_word_i = 1;
    cpu_->word_i = 0x0C081234;
    cpu_->ram_code_i = 0xC;
    cpu_->end_i = end != 0;
    cpu_->end_code_i = end;
    cpu_.settle();
    const unsigned code = end != 0 ? end : 0xCu;
    EXPECT_EQ(cpu_->rdata_o, code << 24 | 0x00081234u);
    EXPECT_TRUE(cpu_->cs_rd_o);
    EXPECT_EQ(cpu_->cs_rd_code_o, code);
  }
}

/// The word 0xFFFFFFFF with another code as it is kept.
class MbCpuKeeps : public MbCpu {
 protected:
  unsigned kept(unsigned mem_sel, unsigned code) {
    cpu_->mem_sel_i = mem_sel;
    cpu_->wdata_i = 0xF0FFFFFF | code << 24;
    cpu_.settle();
    return cpu_->wdata_o;
  }
};

// Bit 28 is one-shot (XCTRL.OSMB), bit 30 the mark of an end, which an abort is; the other bits
// that read as zero are zero.
TEST_F(MbCpuKeeps, OfAMailboxesCsWordWhatCanBeSeenAndTwoMarks) {  // FX-3.3.j, FX-3.4.a
  cpu_->running_i = 1;
  begin(0, 9);
  cpu_.clock();
  for (unsigned code = 0; code < 16; ++code) {
    for (const bool aen : {false, true}) {
      for (const bool osmb : {false, true}) {
        cpu_->aen_i = aen;
        cpu_->osmb_i = osmb;
        const unsigned marks =
            (aen && code == 9 ? 1u << 30 : 0) | (osmb && code == 12 ? 1u << 28 : 0);
        EXPECT_EQ(kept(0, code), marks | code << 24 | 0x7FFFFF) << code;
        EXPECT_EQ(kept(1, code), 0xF0FFFFFF | code << 24) << code;
        EXPECT_EQ(kept(2, code), 0xF0FFFFFF | code << 24) << code;
      }
    }
  }
}

TEST_F(MbCpuKeeps, AWordOfTheFilterTableWhole) {  // FX-4.a
  cpu_->fen_i = 1;
  cpu_->first_i = 10;
  begin(0, 7);
  cpu_.clock();
  for (unsigned code = 0; code < 16; ++code)
    EXPECT_EQ(kept(0, code), 0xF0FFFFFF | code << 24) << code;
}

// NXP's driver writes the table in freeze mode, and FEN then. With AEN bit 30 is a mark, and the
// rows of buffers 0 to 5 are never of the table.
TEST_F(MbCpuKeeps, AWordThatMayBecomeOneOfTheFilterTableWhole) {  // FX-4.a
  for (unsigned n = 0; n < 64; ++n) {
    const bool running = (n & 1) != 0, aen = (n & 2) != 0;
    const unsigned idx = n >> 2;
    cpu_->running_i = running;
    cpu_->aen_i = aen;
    begin(0, idx);
    cpu_.clock();
    const bool whole = !running && !aen && idx >= 6;
    EXPECT_EQ(kept(0, 3), whole ? 0xF3FFFFFFu : 0x037FFFFFu) << n;
    cpu_->rd_word_i = 1;
    cpu_->word_i = 0xFFFFFFFF;
    cpu_.settle();
    EXPECT_EQ(cpu_->rdata_o, 0x0F7FFFFFu) << "what is seen of it";
    cpu_->rd_word_i = 0;
  }
}

// Of buffers alone, and of RXFIR, which has the selection of a C/S word.
TEST_F(MbCpu, WhatBelongsToTheRxFifo) {  // FX-4.a, FX-4.b
  cpu_->first_i = 10;
  for (unsigned mem_sel = 0; mem_sel < 4; ++mem_sel) {
    for (const bool fifo : {false, true}) {
      for (unsigned idx = 0; idx < 64; ++idx) {
        cpu_->fen_i = fifo;
        begin(mem_sel, idx);
        EXPECT_EQ(cpu_->area_o != 0, mem_sel < 2 && fifo && idx < 10) << mem_sel << " " << idx;
        EXPECT_EQ(cpu_->ring_o != 0, mem_sel < 2 && fifo && idx < 6) << mem_sel << " " << idx;
      }
    }
  }
}

// What is read as buffer 0 is the row at the output of the FIFO.
TEST_F(MbCpu, RowAtTheOutputOfTheRxFifo) {  // FX-4.b
  for (unsigned mem_sel = 0; mem_sel < 4; ++mem_sel) {
    for (const bool fifo : {false, true}) {
      for (const unsigned idx : {0u, 1u, 4u}) {
        cpu_->fen_i = fifo;
        cpu_->head_i = 4;
        begin(mem_sel, idx);
        EXPECT_EQ(cpu_->row_idx_o, fifo && mem_sel < 2 && idx == 0 ? 4u : idx) << mem_sel;
      }
    }
  }
}

}  // namespace
}  // namespace vericansim

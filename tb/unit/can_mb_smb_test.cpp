// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_smb alone (flexcan.md 3.1): what of its hidden row a frame has written when it is moved.
#include <gtest/gtest.h>

#include <cstdint>

#include "Vcan_mb_smb.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBuffers = 64, kRowReceived = kBuffers + 2;

// Bits 31:23 are no part of a frame, but a read of the buffer in the clock of the move gets the
// row's word: they are 0 whatever the RAM held, which nobody may have cleared (ClearRam = 0).
TEST(MbSmb, WordOfTheHiddenRowIsWrittenWhole) {  // FX-3.1.a
  LeafModel<Vcan_mb_smb> smb;
  smb.reset();
  for (const unsigned row : {0u, 1u}) {
    unsigned lanes = 0;
    std::uint32_t word = ~0u;
    smb->smb_i = row;
    smb->gnt_i = 1;
    smb->rx_ide_i = smb->rx_srr_i = 1;
    smb->rx_dlc_i = 5;
    smb->timer_i = 0x1234;
    for (unsigned i = 0; i < 40; ++i) {
      smb->start_i = smb->stamp_i = i == 2;
      smb->rx_hdr_i = i == 10;
      smb->rx_valid_i = i == 30;
      smb.settle();
      if (smb->req_o != 0 && smb->cs_o != 0 && smb->row_o == kRowReceived + row) {
        lanes |= smb->be_o;
        for (unsigned lane = 0; lane < 4; ++lane) {
          if (((smb->be_o >> lane) & 1) == 0) continue;
          const std::uint32_t bits = 0xFFu << (8 * lane);
          word = (word & ~bits) | (smb->data_o & bits);
        }
      }
      smb.clock();
      smb.settle();
    }
    EXPECT_EQ(lanes, 0xFu);
    EXPECT_EQ(word, 0x00651234u);
    EXPECT_FALSE(smb->flags_busy_o);
  }
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Codes of the message buffers: every transition of flexcan.md 3.2 from every code.
#include <gtest/gtest.h>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

TEST(BufferCodes, Smoke) {
  BufferRig rig;
  rig.put_rx(3, {.id = 0x123});
  rig.go();
  const std::uint64_t t0 = rig.clocks();
  rig.receive({.id = 0x123, .dlc = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
  printf("start %lu end %lu\n", rig.start_clock() - t0, rig.end_clock() - t0);
  rig.compare();
  rig.put_tx(5, {.id = 0x456, .extended = true, .dlc = 3, .data = {9, 8, 7}});
  rig.quiet();
  rig.compare();
  EXPECT_EQ(rig.model.possibilities(), 1u);
  EXPECT_EQ(rig.sent().size(), 1u);
  EXPECT_EQ(rig.model.state().flags(), 0x28u);
}

}  // namespace
}  // namespace vericansim

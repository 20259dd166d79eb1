// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_mb_ram alone: bytes go where they should, and what was read stays until the next read.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "Vcan_mb_ram.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "verilated.h"

namespace vericansim {
namespace {

TEST(MbRam, KeepsWhatWasReadUntilTheNextRead) {
  SerialContext context;
  Vcan_mb_ram ram{&context};
  ram.eval();
  std::array<std::uint32_t, 128> memory{};
  std::mt19937 rng{6};
  for (ram.waddr_i = 0, ram.we_i = 0xF, ram.wdata_i = 0; ram.waddr_i < 127; ++ram.waddr_i)
    rising_edge(ram, ram.clk_i);
  rising_edge(ram, ram.clk_i);
  std::uint32_t read = 0;
  bool known = false;
  for (unsigned i = 0; i < 20000; ++i) {
    ram.re_i = rng() % 3 == 0;
    ram.raddr_i = rng() % 128;
    ram.we_i = rng() % 16;
    ram.waddr_i = rng() % 128;
    ram.wdata_i = rng();
    if (ram.re_i != 0) {
      read = memory[ram.raddr_i];
      known = ram.we_i == 0 || ram.waddr_i != ram.raddr_i;  // nobody relies on it
    }
    for (unsigned b = 0; b < 4; ++b) {
      const std::uint32_t mask = 0xFFu << (8 * b);
      std::uint32_t &word = memory[ram.waddr_i];
      if (((ram.we_i >> b) & 1) != 0) word = (word & ~mask) | (ram.wdata_i & mask);
    }
    rising_edge(ram, ram.clk_i);
    if (known) {
      ASSERT_EQ(ram.rdata_o, read) << i;
    }
  }
}

}  // namespace
}  // namespace vericansim

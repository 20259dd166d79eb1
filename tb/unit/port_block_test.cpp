// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Ports of two models that are compared and copied many at a time.
#include "node/port_block.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace vericansim {
namespace {

using Ports = std::array<std::uint8_t, 16>;
constexpr PortBlock<2> kSecondAndTenth{{0x000000000000FF00, 0x000000000000FF00}};

Ports counted() {
  Ports ports{};
  for (std::uint8_t i = 0; i < ports.size(); ++i) ports[i] = i;
  return ports;
}

TEST(PortBlockTest, LooksAtItsPortsAlone) {
  for (std::size_t i = 0; i < 16; ++i) {
    Ports one = counted(), other = one;
    EXPECT_FALSE(kSecondAndTenth.differ(one.data(), other.data()));
    other[i] ^= 0x80;
    EXPECT_EQ(kSecondAndTenth.differ(one.data(), other.data()), i == 1 || i == 9) << i;
  }
}

TEST(PortBlockTest, CopiesItsPortsAlone) {
  Ports to{};
  const Ports from = counted();
  kSecondAndTenth.copy(to.data(), from.data());
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(to[i], i == 1 || i == 9 ? i : 0u) << i;
}

TEST(PortBlockTest, IsOfOneBytePortsInOneOrder) {
  struct {
    std::uint8_t a = 0, b = 0, c = 0;
    std::uint16_t wide = 0;
  } one;
  struct {
    std::uint8_t a = 0, c = 0, b = 0;
    std::uint16_t wide = 0;
  } other;
  using Block = PortBlock<1>;
  EXPECT_TRUE(Block::aligned(0, one.a, one.a, other.a, other.a));
  EXPECT_TRUE(Block::aligned(1, one.a, one.b, other.a, other.c));
  EXPECT_FALSE(Block::aligned(2, one.a, one.b, other.a, other.c));
  EXPECT_FALSE(Block::aligned(1, one.a, one.b, other.a, other.b));
  EXPECT_FALSE(Block::aligned(0, one.wide, one.wide, other.wide, other.wide));
}

}  // namespace
}  // namespace vericansim

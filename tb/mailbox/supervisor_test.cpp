// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MCR.SUPV and the privilege of an access (flexcan.md 1.1 bit 23; FX-MCR.SUPV): in a core built
// with CheckHprot = 1, and in one without.
#include <gtest/gtest.h>

#include "Vcan_ahb_user.h"
#include "Vcan_ahb_user___024root.h"
#include "model/registers.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {
namespace {

constexpr std::uint8_t kUser = 0b0001, kPrivileged = 0b0011;
constexpr std::uint32_t kFrozen = reg::kMcrFrz | reg::kMcrHalt;

// can_ahb with CheckHprot = 1 and 16 buffers, one transfer at a time or two back to back.
class Supervisor : public ::testing::Test {
 protected:
  Supervisor() {
    top_.can_rx_i = 1;
    top_.hready = 1;
    top_.hresetn = 0;
    idle(2);
    top_.hresetn = 1;
    idle(300);  // the buffers are cleared
    write(reg::kMcr, kFrozen | reg::kMcrSupv | 15, kPrivileged);
    idle(4);
  }
  ~Supervisor() override { top_.final(); }

  void clock() {
    top_.eval();
    top_.hready = top_.hreadyout;
    top_.eval();
    error_ |= top_.hresp;
    rising_edge(top_, top_.hclk);
    top_.eval();
  }
  void idle(unsigned clocks) {
    top_.hsel = 0;
    top_.htrans = 0;
    for (unsigned i = 0; i < clocks; ++i) clock();
  }
  void address(std::uint32_t address, bool write, std::uint8_t hprot) {
    top_.hsel = 1;
    top_.htrans = 2;
    top_.haddr = address;
    top_.hwrite = write;
    top_.hsize = 2;
    top_.hprot = hprot;
  }
  // The data phase of the transfer whose address phase is over; the next address is set.
  std::uint32_t data_phase() {
    top_.eval();
    while (!top_.hreadyout) clock();
    top_.eval();
    const std::uint32_t data = top_.hrdata;
    clock();
    return data;
  }
  std::uint32_t read(std::uint32_t at, std::uint8_t hprot) {
    address(at, false, hprot);
    clock();
    top_.hsel = top_.htrans = 0;
    return data_phase();
  }
  void write(std::uint32_t at, std::uint32_t data, std::uint8_t hprot) {
    address(at, true, hprot);
    clock();
    top_.hsel = top_.htrans = 0;
    top_.hwdata = data;
    data_phase();
  }

  SerialContext context_;
  Vcan_ahb_user top_{&context_, "user"};
  bool error_ = false;
};

// FX-MCR.SUPV
TEST_F(Supervisor, ResetClosesTheRegistersToUsers) {
  EXPECT_EQ(read(reg::kMcr, kPrivileged) & reg::kMcrSupv, reg::kMcrSupv);
  write(reg::kImask1, 0x1234, kPrivileged);
  write(reg::mb(3, 2), 0x55AA55AA, kPrivileged);
  for (const std::uint32_t at :
       {reg::kMcr, reg::kImask1, reg::kRxgmask, reg::mb(3, 2), reg::rximr(0), 0x1000u}) {
    EXPECT_EQ(read(at, kUser), 0u) << std::hex << at;
    const std::uint32_t before = read(at, kPrivileged);
    EXPECT_NE(before | (at == reg::rximr(0)), 0u) << std::hex << at;
    write(at, ~before, kUser);
    EXPECT_EQ(read(at, kPrivileged), before) << std::hex << at;
  }
  EXPECT_FALSE(error_) << "OKAY, as unimplemented space";
}

// HPROT[1] is the privilege; the other bits say nothing about it.
TEST_F(Supervisor, OnlyThePrivilegeBitOfHprotCounts) {  // FX-MCR.SUPV
  write(reg::kImask1, 0x1234, kPrivileged);
  for (unsigned hprot = 16; hprot-- > 0;) {
    const auto bits = static_cast<std::uint8_t>(hprot);
    EXPECT_EQ(read(reg::kImask1, bits), (hprot & 2) != 0 ? 0x1234u : 0u) << hprot;
  }
}

TEST_F(Supervisor, WithoutSupvUsersMay) {
  write(reg::kMcr, kFrozen | 15, kPrivileged);
  EXPECT_EQ(read(reg::kMcr, kUser) & reg::kMcrSupv, 0u);
  write(reg::kImask1, 0x77, kUser);
  EXPECT_EQ(read(reg::kImask1, kUser), 0x77u);
  write(reg::kMcr, kFrozen | reg::kMcrSupv | 15, kUser);
  EXPECT_EQ(read(reg::kMcr, kUser), 0u) << "closed by a user, for users";
}

// FX-MCR.SUPV
TEST_F(Supervisor, OnlyFreezeModeWritesSupv) {
  write(reg::kMcr, 15, kPrivileged);  // SUPV = 0 along with leaving freeze mode: still counts
  EXPECT_EQ(read(reg::kMcr, kPrivileged) & reg::kMcrSupv, 0u);
  idle(4);
  write(reg::kMcr, reg::kMcrSupv | 15, kPrivileged);
  EXPECT_EQ(read(reg::kMcr, kPrivileged) & reg::kMcrSupv, 0u);
}

// What a user reads is not what is there, nor changed by it.
TEST_F(Supervisor, ADeniedReadTouchesNothing) {
  write(reg::kTimer, 0x4321, kPrivileged);
  EXPECT_EQ(read(reg::kTimer, kUser), 0u);
  EXPECT_EQ(read(reg::kTimer, kPrivileged), 0x4321u);
}

// The word that was read last by right is BUSY for some clocks; a user does not see that either.
TEST_F(Supervisor, ADeniedReadIsZeroWhileABufferIsMoved) {
  write(reg::kMcr, kFrozen | reg::kMcrSupv | reg::kMcrBcc | 15, kPrivileged);
  write(reg::kCtrl, (2u << 19) | (1u << 16) | 1u | reg::kCtrlLpb, kPrivileged);
  write(reg::mb(8, 1), 0x123u << 18, kPrivileged);
  write(reg::mb(8), 0x0C000000, kPrivileged);
  write(reg::mb(5, 1), 0x123u << 18, kPrivileged);
  write(reg::mb(5), 0x04000000, kPrivileged);
  EXPECT_EQ(read(reg::mb(5), kPrivileged), 0x04000000u);
  write(reg::kMcr, reg::kMcrSupv | reg::kMcrBcc | 15, kPrivileged);
  for (unsigned i = 0; i < 1000; ++i) ASSERT_EQ(read(reg::mb(5), kUser), 0u) << i;
  EXPECT_EQ(read(reg::kIflag1, kPrivileged), (1u << 5) | (1u << 8));
}

// Back to back, in every order: each access by its own privilege. A word of a buffer stays at the
// output of the RAM.
TEST_F(Supervisor, PrivilegeBelongsToTheTransfer) {
  write(reg::kImask1, 0x0F0F, kPrivileged);
  write(reg::mb(3, 2), 0x0F0F, kPrivileged);
  for (const std::uint32_t at : {reg::kImask1, reg::mb(3, 2)}) {
    for (const std::uint8_t first : {kUser, kPrivileged}) {
      for (const std::uint8_t second : {kUser, kPrivileged}) {
        address(at, false, first);
        clock();
        address(at, false, second);
        EXPECT_EQ(data_phase(), first == kUser ? 0u : 0x0F0Fu);
        top_.hsel = top_.htrans = 0;
        EXPECT_EQ(data_phase(), second == kUser ? 0u : 0x0F0Fu);
      }
    }
  }
}

// FX-MCR.SUPV: by default it is stored, and nothing else.
TEST(SupervisorDefault, SupvIsStoredOnly) {
  const auto node = RtlNode::create("node", {}, 16);
  for (int i = 0; i < 300; ++i) node->advance();
  const auto access = [&](std::uint32_t at, bool write, std::uint32_t data = 0) {
    return node->access({.address = at, .write = write, .data = data, .hprot = kUser}).data;
  };
  access(reg::kMcr, true, kFrozen | reg::kMcrSupv | 15);
  EXPECT_EQ(access(reg::kMcr, false) & reg::kMcrSupv, reg::kMcrSupv);
  access(reg::kImask1, true, 0x99);
  EXPECT_EQ(access(reg::kImask1, false), 0x99u);
}

}  // namespace
}  // namespace vericansim

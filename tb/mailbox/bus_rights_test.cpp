// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Privilege on APB and AXI4-Lite (PK-16): with CheckProt = 1 and MCR.SUPV = 1 an access with
// PPROT[0] or AxPROT[0] = 0 reads 0, writes nothing, gets OKAY, and does not wait. On AHB:
// supervisor_test.
#include <gtest/gtest.h>

#include "Vcan_apb_user.h"
#include "Vcan_apb_user___024root.h"
#include "Vcan_axil_user.h"
#include "Vcan_axil_user___024root.h"
#include "model/registers.hpp"
#include "node/bus_node_of.hpp"

namespace vericansim {
namespace {

constexpr std::uint8_t kUser = 0b0001, kPrivileged = 0b0011;
constexpr std::uint32_t kFrozen = reg::kMcrFrz | reg::kMcrHalt;

template <typename Node>
class BusRights : public ::testing::Test {
 protected:
  BusRights() {
    for (int i = 0; i < 300; ++i) node_.advance();  // until the buffer RAM is cleared
    write(reg::kMcr, kFrozen | reg::kMcrSupv | 15, kPrivileged);
    for (int i = 0; i < 4; ++i) node_.advance();
  }
  ~BusRights() override {
    EXPECT_EQ(node_.master().report().violations, std::vector<std::string>{});
  }

  AhbResult access(const AhbTransfer &transfer) {
    const AhbResult result = node_.access(transfer);
    EXPECT_FALSE(result.error) << "OKAY, as reserved offsets";
    return result;
  }
  std::uint32_t read(std::uint32_t at, std::uint8_t rights) {
    return access({.address = at, .hprot = rights}).data;
  }
  void write(std::uint32_t at, std::uint32_t data, std::uint8_t rights) {
    access({.address = at, .write = true, .data = data, .hprot = rights});
  }

  Node node_{"node", {}, 16};
};

using Nodes =
    ::testing::Types<BusNodeOf<Vcan_apb_user, ApbPins>, BusNodeOf<Vcan_axil_user, AxilPins>>;
TYPED_TEST_SUITE(BusRights, Nodes);

TYPED_TEST(BusRights, UsersFindUnimplementedSpace) {
  this->write(reg::kImask1, 0x1234, kPrivileged);
  this->write(reg::mb(3, 2), 0x55AA55AA, kPrivileged);
  for (const std::uint32_t at : {reg::kMcr, reg::kImask1, reg::kRxgmask, reg::mb(3, 2)}) {
    EXPECT_EQ(this->read(at, kUser), 0u) << std::hex << at;
    const std::uint32_t before = this->read(at, kPrivileged);
    EXPECT_NE(before, 0u) << std::hex << at;
    this->write(at, ~before, kUser);
    EXPECT_EQ(this->read(at, kPrivileged), before) << std::hex << at;
  }
}

TYPED_TEST(BusRights, WithoutSupvUsersMay) {
  this->write(reg::kMcr, kFrozen | 15, kPrivileged);
  this->write(reg::kImask1, 0x77, kUser);
  EXPECT_EQ(this->read(reg::kImask1, kUser), 0x77u);
}

// With MCR.AEN each write of a buffer waits for a clock, but for one that is denied.
TYPED_TEST(BusRights, ADeniedAccessDoesNotWait) {
  this->write(reg::kMcr, kFrozen | reg::kMcrSupv | 1u << 12 | 15, kPrivileged);
  for (const std::uint8_t rights : {kUser, kPrivileged}) {
    const AhbTransfer transfer{.address = reg::mb(3), .write = true, .hprot = rights};
    EXPECT_EQ(this->access(transfer).waits, rights == kUser ? 0u : 1u);
  }
}

// Back to back: each by its own privilege; a write's does not count for a read.
TYPED_TEST(BusRights, PrivilegeBelongsToTheTransfer) {
  std::uint32_t last = 0;
  for (unsigned order = 0; order < 64; ++order) {
    std::vector<std::pair<BusMaster::Ticket, std::uint32_t>> reads;
    for (unsigned bit = 0; bit < 6; ++bit) {
      const std::uint8_t rights = (order >> bit & 1) != 0 ? kPrivileged : kUser;
      const bool writing = bit % 2 == 0;
      const std::uint32_t data = 0x100 * order + bit + 1;
      const auto ticket = this->node_.master().submit(
          {.address = reg::mb(3, 2), .write = writing, .data = data, .hprot = rights});
      if (writing && rights == kPrivileged) last = data;
      if (!writing) reads.emplace_back(ticket, rights == kUser ? 0 : last);
    }
    while (!this->node_.master().done(reads.back().first)) this->node_.advance();
    for (const auto &[ticket, wanted] : reads)
      EXPECT_EQ(this->node_.master().result(ticket).data, wanted) << order;
  }
}

}  // namespace
}  // namespace vericansim

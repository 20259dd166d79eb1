// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Registers: reset values, who may write what and when (flexcan.md section 1).
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kFreezeRequest = reg::kMcrFrz | reg::kMcrHalt;

/// One register: value after reset and the bits that a write of ones or zeros changes, per mode.
struct Row {
  const char *name;
  std::uint32_t offset;
  std::uint32_t reset;
  std::uint32_t in_disable;
  std::uint32_t in_freeze;
  std::uint32_t in_normal;
};

// CTRL1: 15, 14, 6 at any time; 11, 10 too, with WRN_EN; 13 in disable mode only (1.2).
const Row kRows[] = {
    {"CTRL1", reg::kCtrl, 0, 0x0000E040, 0xFFFFDCFF, 0x0000CC40},
    {"TIMER", reg::kTimer, 0, 0xFFFF, 0xFFFF, 0},  // counts in normal mode
    {"TCR", 0x00C, 0, 0, 0, 0},
    {"RXGMASK", reg::kRxgmask, 0xFFFFFFFF, 0, 0xFFFFFFFF, 0},
    {"RX14MASK", reg::kRx14mask, 0xFFFFFFFF, 0, 0xFFFFFFFF, 0},
    {"RX15MASK", reg::kRx15mask, 0xFFFFFFFF, 0, 0xFFFFFFFF, 0},
    {"ECR", reg::kEcr, 0, 0, 0xFFFF, 0},
    {"IMASK2", reg::kImask2, 0, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF},
    {"IMASK1", reg::kImask1, 0, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF},
    {"IFLAG2", reg::kIflag2, 0, 0, 0, 0},
    {"IFLAG1", reg::kIflag1, 0, 0, 0, 0},
    {"CTRL2", reg::kCtrl2, 0x00B00000, 0, 0x1FFF0000, 0},
    {"ESR2", 0x038, 0, 0, 0, 0},
    {"CRCR", 0x044, 0, 0, 0, 0},
    {"RXFGMASK", 0x048, 0xFFFFFFFF, 0, 0xFFFFFFFF, 0},
    {"RXFIR", 0x04C, 0, 0, 0, 0},
    {"hole at 0x07C", 0x07C, 0, 0, 0, 0},
    {"MB0 C/S", reg::mb(0), 0, 0x0F7FFFFF, 0x0F7FFFFF, 0x0F7FFFFF},
    {"MB0 ID", reg::mb(0, 1), 0, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF},
    {"MB63 DATA1", reg::mb(63, 3), 0, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF},
    {"after MB63", reg::mb(64), 0, 0, 0, 0},
    {"before RXIMR0", 0x87C, 0, 0, 0, 0},
    {"RXIMR0", reg::rximr(0), 0, 0, 0xFFFFFFFF, 0},
    {"RXIMR63", reg::rximr(63), 0, 0, 0xFFFFFFFF, 0},
    {"after RXIMR63", reg::rximr(64), 0, 0, 0, 0},
    {"GFWR", 0x9E0, 0, 0, 0, 0},
    {"extension ID", 0x1000, 0x5643414E, 0, 0, 0},
    {"extension VERSION", 0x1004, 0x00010003, 0, 0, 0},
    {"extension CONFIG", 0x1008, 0x03F00F40, 0, 0, 0},
    {"extension XCTRL", reg::kExtControl, 0, 0x6, 0x7, 0x6},
    {"end of the window", 0x1FFC, 0, 0, 0, 0},
};

class Registers : public ::testing::TestWithParam<Row> {
 protected:
  Registers() : rig_{1} { rig_.run(300); }  // until the buffer RAM is cleared

  // Bits that follow both a write of ones and one of zeros.
  std::uint32_t writable() {
    const std::uint32_t offset = GetParam().offset;
    rig_.write(0, offset, 0xFFFFFFFF);
    const std::uint32_t ones = rig_.read(0, offset);
    rig_.write(0, offset, 0);
    return ones & ~rig_.read(0, offset);
  }

  MailboxRig rig_;
};

TEST_P(Registers, ResetValue) { EXPECT_EQ(rig_.read(0, GetParam().offset), GetParam().reset); }

TEST_P(Registers, WritableBitsInDisableMode) { EXPECT_EQ(writable(), GetParam().in_disable); }

TEST_P(Registers, WritableBitsInFreezeMode) {
  rig_.configure(0);
  EXPECT_EQ(writable(), GetParam().in_freeze);
}

// BT-11: the timing fields of CTRL1 are among what cannot be written outside freeze mode.
TEST_P(Registers, WritableBitsInNormalMode) {
  if (GetParam().offset == reg::kTimer) return;  // counts
  rig_.configure(0);
  rig_.go(0);
  EXPECT_EQ(writable(), GetParam().in_normal);
}

TEST_P(Registers, HardResetRestoresTheResetValue) {
  rig_.configure(0);
  writable();
  rig_.node(0).reset();
  rig_.run(300);
  EXPECT_EQ(rig_.read(0, GetParam().offset), GetParam().reset);
}

INSTANTIATE_TEST_SUITE_P(Map, Registers, ::testing::ValuesIn(kRows), [](const auto &test) {
  std::string name = test.param.name;
  for (char &c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});

class Mcr : public ::testing::Test {
 protected:
  Mcr() : rig_{1} { rig_.run(300); }
  std::uint32_t mcr() { return rig_.read(0, reg::kMcr); }
  MailboxRig rig_;
};

TEST_F(Mcr, ResetAndFirstSteps) {  // section 2
  EXPECT_EQ(mcr(), 0xD890000F);
  rig_.write(0, reg::kMcr, 0x5890000F);
  rig_.run(4);
  EXPECT_EQ(mcr(), 0x5980000F);
}

TEST_F(Mcr,
       FreezeOnlyFieldsOfMcr) {  // 1.1: {29,23,21,19,17,16,13,12,9:8,6:0}; 26, 22, 18 at any time
  rig_.write(0, reg::kMcr, 0x7FFFFFFF & ~reg::kMcrSoftRst);
  rig_.run(4);
  EXPECT_EQ(mcr(), 0x5DC4000F) << "written in disable mode";
  rig_.write(0, reg::kMcr, 0x7FFFFFFF & ~reg::kMcrSoftRst);
  EXPECT_EQ(mcr(), 0x7DEF337F);
  rig_.write(0, reg::kMcr, kFreezeRequest);
  EXPECT_EQ(mcr(), 0x59000000);
  rig_.write(0, reg::kMcr, 0x20AB333F);  // leaves freeze mode: these fields are still written
  rig_.run(4);
  EXPECT_EQ(mcr(), 0x20AB333F);
  rig_.write(0, reg::kMcr, 0);
  EXPECT_EQ(mcr(), 0x20AB333F) << "written in normal mode";
}

TEST_F(Mcr, ByteWritesReachTheirByteOnly) {
  rig_.configure(0);
  const auto byte = [&](std::uint32_t address, std::uint32_t value) {
    rig_.access(0, {.address = address, .write = true, .size = AhbSize::kByte, .data = value});
  };
  rig_.write(0, reg::kCtrl, 0x11223304);
  byte(reg::kCtrl + 3, 0xAB);
  byte(reg::kCtrl + 0, 0x05);
  EXPECT_EQ(rig_.read(0, reg::kCtrl), 0xAB220005u | (0x3300u & 0xDC00u));
  rig_.write(0, reg::kImask1, 0x01020304);
  byte(reg::kImask1 + 2, 0xFF);
  EXPECT_EQ(rig_.read(0, reg::kImask1), 0x01FF0304u);
  rig_.write(0, reg::kEcr, 0x1234);
  byte(reg::kEcr + 1, 0x56);
  EXPECT_EQ(rig_.read(0, reg::kEcr), 0x5634u);
}

TEST_F(Mcr, SoftResetIsAskedForByItsByteAlone) {  // FX-2.3.a
  const auto part = [&](std::uint32_t offset, AhbSize size, std::uint32_t value) {
    rig_.access(0, {.address = reg::kMcr + offset, .write = true, .size = size, .data = value});
    rig_.run(10);
  };
  for (const bool half : {false, true}) {
    rig_.configure(0);
    EXPECT_NE(mcr() & 0x7F, 0x0Fu);
    part(0, half ? AhbSize::kHalf : AhbSize::kByte, 0x0202);
    EXPECT_NE(mcr() & 0x7F, 0x0Fu);
    part(half ? 2 : 3, half ? AhbSize::kHalf : AhbSize::kByte, half ? 0x0200 : 0x02);
    EXPECT_EQ(mcr(), 0x5980000Fu);
  }
}

// The zeros of FRZ and HALT that come with the request are not taken over, from the start.
TEST_F(Mcr, SoftResetBeatsWhatIsWrittenWithIt) {  // FX-2.3.f
  rig_.configure(0);
  rig_.go(0);
  const auto results = rig_.burst(
      0, {{.address = reg::kMcr, .write = true, .data = reg::kMcrSoftRst}, {.address = reg::kMcr}});
  const std::uint32_t frozen = reg::kMcrFrz | reg::kMcrHalt;
  EXPECT_EQ(results[1].data & (reg::kMcrSoftRst | frozen), reg::kMcrSoftRst | frozen);
  rig_.run(20);
  EXPECT_EQ(mcr() & (reg::kMcrSoftRst | frozen), frozen);
}

TEST_F(Mcr, WarningMasksNeedWrnEn) {  // 1.1 bit 21
  rig_.configure(0);
  rig_.write(0, reg::kCtrl, 0x0C00);
  EXPECT_EQ(rig_.read(0, reg::kCtrl), 0x0C00u);
  rig_.write(0, reg::kMcr, kFreezeRequest | 0x3F);
  EXPECT_EQ(rig_.read(0, reg::kCtrl), 0u);
  rig_.write(0, reg::kCtrl, 0x0C00);
  EXPECT_EQ(rig_.read(0, reg::kCtrl), 0u);
}

TEST_F(Mcr, WarningMasksWrittenWithoutWrnEnAreNotKept) {  // 1.1 bit 21
  rig_.configure(0);
  rig_.write(0, reg::kMcr, kFreezeRequest | 0x3F);
  rig_.write(0, reg::kCtrl, 0x0C00);
  rig_.write(0, reg::kMcr, kFreezeRequest | reg::kMcrWrnEn | 0x3F);
  EXPECT_EQ(rig_.read(0, reg::kCtrl), 0u);
}

class Size : public ::testing::TestWithParam<unsigned> {};

TEST_P(Size, BuffersBeyondNumMbAreReserved) {
  const unsigned num_mb = GetParam();
  MailboxRig rig{1, num_mb};
  rig.configure(0);
  EXPECT_EQ(rig.read(0, 0x1008) & 0xFF, num_mb);
  for (std::uint32_t address : {reg::mb(num_mb), reg::mb(num_mb) + 4, reg::rximr(num_mb)}) {
    rig.write(0, address, 0x04FFFFFF);
    EXPECT_EQ(rig.read(0, address), 0u) << std::hex << address;
  }
  for (std::uint32_t address : {reg::kImask1, reg::kImask2}) rig.write(0, address, 0xFFFFFFFF);
  EXPECT_EQ(rig.read(0, reg::kImask2), num_mb > 32 ? 0xFFFFFFFF : 0u);
  EXPECT_EQ(rig.read(0, reg::kImask1), num_mb >= 32 ? 0xFFFFFFFF : 0xFFFFu);
}

TEST_P(Size, EveryBufferAndMaskIsItsOwnMemory) {
  const unsigned num_mb = GetParam();
  MailboxRig rig{1, num_mb};
  rig.configure(0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> written;
  std::mt19937 rng{num_mb};
  for (unsigned mb = 0; mb < num_mb; ++mb) {
    for (unsigned word = 0; word < 4; ++word)
      written.emplace_back(reg::mb(mb, word), word == 0 ? rng() & 0x007FFFFF : rng());
    written.emplace_back(reg::rximr(mb), rng());
  }
  for (std::uint32_t address : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask})
    written.emplace_back(address, rng());
  for (const auto &[address, value] : written) rig.write(0, address, value);
  for (const auto &[address, value] : written)
    EXPECT_EQ(rig.read(0, address), value) << std::hex << address;
}

INSTANTIATE_TEST_SUITE_P(NumMb, Size, ::testing::Values(16u, 32u, 64u));

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 20 of the rule book: golden vectors, sent and received, in all error states.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

struct Vector {
  const char *name;
  Frame frame;
  std::uint16_t crc;
  std::string head;  // SOF..CRC with all stuff bits; empty: the book gives only numbers
  std::size_t stuff_bits;
  std::size_t length;  // of the head; 0: not given
};

void PrintTo(const Vector &vector, std::ostream *out) { *out << vector.name; }

// GV-1..GV-9 as the rule book prints them.
std::vector<Vector> vectors() {
  const std::vector<std::uint8_t> count{1, 2, 3, 4, 5, 6, 7, 8};
  const auto with_dlc = [&](std::uint8_t dlc) {
    Frame frame = base_frame(0x2AA, count);
    frame.dlc = dlc;
    return frame;
  };
  return {
      {"GV1", base_frame(0x123, {0x55}), 0x2363, "0001001000110000010101010101010001101100011", 1,
       43},
      {"GV2", base_frame(0x555), 0x674C, "01010101010100000100110011101001100", 1, 35},
      {"GV3", base_frame(0x009), 0x7C20, "000001000100100000100111110000011000001", 5, 39},
      {"GV4", base_frame(0x017), 0x521F, "0000010010111000001001010010000111110", 3, 37},
      {"GV5", remote_frame(0x123, false, 5), 0x06CB, "0001001000111000101000011011001011", 0, 34},
      {"GV6", remote_frame(0, true), 0x35D5,
       "000001000001001100000100000100000100010000010011010111010101", 6, 60},
      {"GV7", base_frame(0x078, {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}), 0x28A3, "", 19,
       117},
      {"GV8Dlc8", with_dlc(8), 0x248C, "", 0, 0},
      {"GV8Dlc9", with_dlc(9), 0x0FD2, "", 0, 0},
      {"GV8Dlc15", with_dlc(15), 0x318F, "", 0, 0},
      {"GV9Ones", extended_frame(0x1FFFFFFF, std::vector<std::uint8_t>(8, 0xFF)), 0x1B69, "", 18,
       54 + 64 + 18},
      {"GV9Zeros", base_frame(0, std::vector<std::uint8_t>(8, 0)), 0x145B, "", 16, 34 + 64 + 16}};
}

class GoldenVector : public ::testing::TestWithParam<Vector> {
 protected:
  // The bits that lie in front of the CRC are listed by FF-01 and FF-02; the CRC is that of the
  // book.
  [[nodiscard]] static std::string head() {
    const Vector &v = GetParam();
    if (!v.head.empty()) return v.head;
    const std::string plain = plain_bits(v.frame);
    return stuffed(plain.substr(0, plain.size() - 15) + binary(v.crc, 15));
  }
};

INSTANTIATE_TEST_SUITE_P(OfTheBook, GoldenVector, ::testing::ValuesIn(vectors()),
                         [](const auto &vector) { return std::string{vector.param.name}; });

// GV-1, GV-2, GV-3, GV-4, GV-5, GV-6, GV-7, GV-8, GV-9; CR-01.
TEST_P(GoldenVector, IsSentBitByBit) {
  const Vector &v = GetParam();
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    scene.send(v.frame);
    const std::string tx = scene.play(r_bits(head().size() + 1) + "0" + r_bits(8));
    EXPECT_EQ(tx, head() + frame_end());
    const std::string plain = destuffed(tx.substr(0, head().size()));
    EXPECT_EQ(plain.substr(plain.size() - 15), binary(v.crc, 15));
    EXPECT_EQ(scene.dut().sent().size(), 1u);
    if (v.length == 0) continue;
    EXPECT_EQ(head().size(), v.length);
    EXPECT_EQ(v.length - plain.size(), v.stuff_bits);
  }
}

// GV-1, GV-2, GV-3, GV-4, GV-5, GV-6, GV-7, GV-8, GV-9; CR-01.
TEST_P(GoldenVector, IsReceivedAndAcknowledged) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    const std::string bits = head() + frame_end();
    EXPECT_EQ(scene.play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
    ASSERT_EQ(scene.dut().received().size(), 1u);
    EXPECT_EQ(scene.last_received(), GetParam().frame);
  }
}

// CR-01, CR-03: with any other CRC the same bits are neither acknowledged nor delivered.
TEST_P(GoldenVector, IsRefusedWithAnyWrongCrcBit) {
  for (unsigned bit = 0; bit < 15; ++bit) {
    std::string plain = destuffed(head());
    plain = flipped(plain, plain.size() - 15 + bit);
    Scene scene;
    const std::string bits = stuffed(plain) + frame_end();
    EXPECT_EQ(scene.play(bits), r_bits(bits.size() - 7) + d_bits(6) + "1") << bit;
    EXPECT_TRUE(scene.dut().received().empty());
  }
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame codec against the golden vectors and the lengths of the rule book (CR-01, FF-11,
// GV-1..GV-9).
#include "model/frame_codec.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace vericansim {
namespace {

Frame base(std::uint32_t id, std::uint8_t dlc, std::array<std::uint8_t, 8> data = {}) {
  return {.id = id, .dlc = dlc, .data = data};
}

std::string stuffed_text(const EncodedFrame &encoded) {
  return to_string(levels_of({encoded.bits.data(), encoded.stuffed_length}));
}

Frame random_frame(std::mt19937 &rng) {
  Frame f;
  f.extended = (rng() & 1) != 0;
  f.remote = (rng() & 3) == 0;
  f.id = static_cast<std::uint32_t>(rng()) & (f.extended ? 0x1FFFFFFFu : 0x7FFu);
  f.dlc = static_cast<std::uint8_t>(rng() & 15);
  const bool flat = (rng() & 1) != 0;  // long runs make many stuff bits
  for (unsigned i = 0; i < f.payload_size(); ++i) {
    f.data[i] =
        flat ? static_cast<std::uint8_t>((rng() & 1) ? 0xFF : 0) : static_cast<std::uint8_t>(rng());
  }
  return f;
}

struct Golden {
  const char *name;
  Frame frame;
  std::uint16_t crc;
  const char *bits;  ///< empty: not printed in the rule book
};

class GoldenVector : public ::testing::TestWithParam<Golden> {};

TEST_P(GoldenVector, EncodesAndDecodes) {
  const Golden &g = GetParam();
  const EncodedFrame encoded = encode_frame(g.frame);
  EXPECT_EQ(encoded.crc, g.crc);
  if (*g.bits != '\0') {
    EXPECT_EQ(stuffed_text(encoded), g.bits);
  }
  const DecodeResult back = decode_frame(levels_of(encoded.bits));
  EXPECT_EQ(back.error, DecodeError::kNone);
  ASSERT_TRUE(back.frame.has_value());
  EXPECT_EQ(*back.frame, g.frame);
  EXPECT_EQ(back.stuffed_length, encoded.stuffed_length);
}

const std::array<std::uint8_t, 8> kCount = {1, 2, 3, 4, 5, 6, 7, 8};

INSTANTIATE_TEST_SUITE_P(
    Rules, GoldenVector,
    ::testing::Values(
        Golden{"GV_1", base(0x123, 1, {0x55}), 0x2363,
               "0001001000110000010101010101010001101100011"},
        Golden{"GV_2", base(0x555, 0), 0x674C, "01010101010100000100110011101001100"},
        Golden{"GV_3", base(0x009, 0), 0x7C20, "000001000100100000100111110000011000001"},
        Golden{"GV_4", base(0x017, 0), 0x521F, "0000010010111000001001010010000111110"},
        Golden{"GV_5", Frame{.id = 0x123, .remote = true, .dlc = 5}, 0x06CB,
               "0001001000111000101000011011001011"},
        Golden{"GV_6", Frame{.id = 0, .extended = true, .remote = true}, 0x35D5,
               "000001000001001100000100000100000100010000010011010111010101"},
        Golden{"GV_7", base(0x078, 8, {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}), 0x28A3,
               ""},
        Golden{"GV_8_dlc8", base(0x2AA, 8, kCount), 0x248C, ""},
        Golden{"GV_8_dlc9", base(0x2AA, 9, kCount), 0x0FD2, ""},
        Golden{"GV_8_dlc15", base(0x2AA, 15, kCount), 0x318F, ""},
        Golden{"GV_9_ones",
               Frame{.id = 0x1FFFFFFF,
                     .extended = true,
                     .dlc = 8,
                     .data = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}},
               0x1B69, ""},
        Golden{"GV_9_zeros", base(0x000, 8), 0x145B, ""}),
    [](const auto &golden) { return std::string(golden.param.name); });

TEST(FrameCodec, GoldenLengths) {
  EXPECT_EQ(encode_frame(base(0x123, 1, {0x55})).bits.size(), 53u);  // GV-1
  EXPECT_EQ(encode_frame(base(0x123, 1, {0x55})).stuff_count, 1u);
  const auto gv7 = encode_frame(base(0x078, 8, {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}));
  EXPECT_EQ(gv7.stuff_count, 19u);
  EXPECT_EQ(gv7.stuffed_length, 117u);
  Frame ones{.id = 0x1FFFFFFF, .extended = true, .dlc = 8, .data = {}};
  ones.data.fill(0xFF);
  EXPECT_EQ(encode_frame(ones).stuff_count, 18u);            // GV-9
  EXPECT_EQ(encode_frame(base(0x000, 8)).stuff_count, 16u);  // GV-9
}

TEST(FrameCodec, CheckValueOfTheCrc) {  // CR-01
  std::vector<std::uint8_t> bits;
  for (const char c : std::string("123456789")) {
    for (int i = 7; i >= 0; --i) bits.push_back(static_cast<std::uint8_t>((c >> i) & 1));
  }
  EXPECT_EQ(crc15(bits), 0x059E);
}

TEST(FrameCodec, LengthsWithoutStuffBits) {  // FF-03, FF-07, FF-11
  for (const bool extended : {false, true}) {
    for (const bool remote : {false, true}) {
      for (std::uint8_t dlc = 0; dlc <= 15; ++dlc) {
        const Frame f{.id = 0x155, .extended = extended, .remote = remote, .dlc = dlc, .data = {}};
        const EncodedFrame e = encode_frame(f);
        const std::size_t bytes = remote ? 0 : std::min<std::size_t>(dlc, 8);
        EXPECT_EQ(e.bits.size() - e.stuff_count, (extended ? 64u : 44u) + 8 * bytes);
        EXPECT_EQ(e.stuffed_length - e.stuff_count, (extended ? 54u : 34u) + 8 * bytes);
      }
    }
  }
}

TEST(FrameCodec, RandomFramesRoundTripWithinTheLengthBound) {  // ST-01, FF-11
  std::mt19937 rng(1);
  for (int n = 0; n < 5000; ++n) {
    const Frame f = random_frame(rng);
    const EncodedFrame e = encode_frame(f);
    const std::size_t region = (f.extended ? 54u : 34u) + 8u * f.payload_size();
    EXPECT_LE(e.stuff_count, (region - 1) / 4);
    const std::string text = stuffed_text(e);
    EXPECT_EQ(text.find("000000"), std::string::npos);
    EXPECT_EQ(text.find("111111"), std::string::npos);
    const DecodeResult back = decode_frame(levels_of(e.bits));
    ASSERT_TRUE(back.frame.has_value());
    EXPECT_EQ(*back.frame, f);
  }
}

TEST(FrameCodec, ReservedBitsTravelAtEitherLevel) {  // FF-05
  const Frame f{.id = 0x12345678, .extended = true, .dlc = 2, .data = {0xA5, 0x00}};
  for (unsigned mask = 0; mask < 8; ++mask) {
    const EncodeOptions o{.r0 = static_cast<Level>(mask & 1),
                          .r1 = static_cast<Level>((mask >> 1) & 1),
                          .srr = static_cast<Level>((mask >> 2) & 1),
                          .ack_slot = Level::kRecessive};
    const DecodeResult back = decode_frame(levels_of(encode_frame(f, o).bits));
    ASSERT_TRUE(back.frame.has_value());
    EXPECT_EQ(*back.frame, f);
    EXPECT_EQ(back.levels.r0, o.r0);
    EXPECT_EQ(back.levels.r1, o.r1);
    EXPECT_EQ(back.levels.srr, o.srr);
    EXPECT_EQ(back.levels.ack_slot, Level::kRecessive);
  }
}

TEST(FrameCodec, AnnotationsNameEveryPlace) {           // FF-01
  const EncodedFrame e = encode_frame(base(0x009, 0));  // GV-3: 39 bits SOF..final stuff bit
  EXPECT_EQ(e.bits[0].field, Field::kSof);
  EXPECT_EQ(e.bits[5].field, Field::kId);  // r stuff bit after SOF + 4 d (ST-02)
  EXPECT_EQ(e.bits[5].index, 4);
  EXPECT_TRUE(e.bits[5].is_stuff);
  EXPECT_EQ(e.bits[38].field, Field::kCrcDel);
  EXPECT_TRUE(e.bits[38].is_stuff);
  EXPECT_EQ(e.bits[39].field, Field::kCrcDel);
  EXPECT_FALSE(e.bits[39].is_stuff);
  EXPECT_EQ(e.bits[40].field, Field::kAck);
  EXPECT_EQ(e.bits[41].field, Field::kAckDel);
  EXPECT_EQ(e.bits.back().field, Field::kEof);
  EXPECT_EQ(e.bits.back().index, 6);
}

TEST(FrameCodec, DecoderNamesTheFirstError) {  // ST-04, ST-06, ED-09, VA-01
  const EncodedFrame e = encode_frame(base(0x009, 0));
  const auto flipped = [&](std::size_t at) {
    std::vector<Level> bits = levels_of(e.bits);
    bits[at] = !bits[at];
    return decode_frame(bits);
  };
  EXPECT_EQ(flipped(0).error, DecodeError::kNoSof);
  EXPECT_EQ(flipped(5).error, DecodeError::kStuff);
  EXPECT_EQ(flipped(5).position, 5u);
  EXPECT_EQ(flipped(5).field, Field::kId);
  EXPECT_EQ(flipped(38).error, DecodeError::kStuff);  // final stuff bit
  EXPECT_EQ(flipped(38).field, Field::kCrcDel);
  EXPECT_EQ(flipped(39).error, DecodeError::kForm);
  EXPECT_EQ(flipped(41).error, DecodeError::kForm);
  EXPECT_EQ(flipped(41).field, Field::kAckDel);
  EXPECT_EQ(flipped(47).error, DecodeError::kForm);  // EOF6: invalid
  EXPECT_FALSE(flipped(47).frame.has_value());
  EXPECT_EQ(flipped(48).error, DecodeError::kForm);  // EOF7: valid for receivers
  EXPECT_TRUE(flipped(48).frame.has_value());
  std::vector<Level> cut = levels_of(e.bits);
  cut.resize(20);
  EXPECT_EQ(decode_frame(cut).error, DecodeError::kTruncated);
  EXPECT_EQ(decode_frame(cut).position, 20u);
}

TEST(FrameCodec, EverySingleFlipIsSeen) {  // CR-03, MX-08: no frame survives one flipped bit
  std::mt19937 rng(2);
  for (int n = 0; n < 300; ++n) {
    const EncodedFrame e = encode_frame(random_frame(rng));
    std::vector<Level> bits = levels_of(e.bits);
    bits.resize(bits.size() + 40, Level::kRecessive);
    for (std::size_t i = 0; i + 1 < e.bits.size(); ++i) {
      if (e.bits[i].field == Field::kAck) continue;
      bits[i] = !bits[i];
      EXPECT_FALSE(decode_frame(bits).frame.has_value()) << i;
      bits[i] = !bits[i];
    }
  }
}

TEST(FrameCodec, RefusesWhatDoesNotFit) {
  EXPECT_THROW((void)encode_frame(base(0x800, 0)), std::invalid_argument);
  EXPECT_THROW((void)encode_frame(base(0x1, 16)), std::invalid_argument);
  EXPECT_THROW((void)encode_frame(Frame{.id = 0x20000000, .extended = true}),
               std::invalid_argument);
  EXPECT_THROW((void)levels_from_string("01x"), std::invalid_argument);
}

}  // namespace
}  // namespace vericansim

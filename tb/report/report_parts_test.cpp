// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of the recorder: edges, base64 and zlib, the beginnings of bits.
#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <sstream>

#include "report/base64_stream.hpp"
#include "report/bit_track.hpp"
#include "report/edge_list.hpp"

namespace vericansim {
namespace {

constexpr Level d = Level::kDominant, r = Level::kRecessive;

TEST(EdgeList, GivesDistancesInTicks) {
  EdgeList edges{5000, r};
  edges.change(5000, d);
  edges.change(6000, r);
  edges.change(6000, r);  // no change
  edges.change(206'000, d);
  EXPECT_EQ(edges.distances(), (std::vector<std::uint32_t>{0, 1, 200}));
  EXPECT_EQ(edges.initial(), r);
}

// 1000 edges 1.4 ns apart: each is off by half a tick at most, the last one too.
TEST(EdgeList, RoundingDoesNotAddUp) {
  EdgeList edges{0, r};
  for (Time i = 1; i <= 1000; ++i) edges.change(i * 1400, i % 2 != 0 ? d : r);
  std::uint64_t sum = 0, number = 0;
  for (const std::uint32_t distance : edges.distances()) {
    sum += distance;
    ++number;
    EXPECT_LE(sum * 1000, number * 1400 + 500);
    EXPECT_GE(sum * 1000 + 500, number * 1400);
  }
  EXPECT_EQ(number, 1000U);
}

// 4294967295 stands for so many ticks without a change.
TEST(EdgeList, LongDistancesAreSplit) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  EdgeList edges{0, r};
  edges.change(Time{kMost} * 2000 + 7000, d);
  edges.change(Time{kMost} * 3000 + 7000, r);
  EXPECT_EQ(edges.distances(), (std::vector<std::uint32_t>{kMost, kMost, 7, kMost, 0}));
}

// RFC 4648, 10, is about the text; here the bytes are a zlib stream, whose length varies.
TEST(Base64Stream, IsReadBackByZlib) {
  for (std::size_t size = 0; size < 40; ++size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(i * 37 + size);
    std::ostringstream out;
    Base64Stream stream{out};
    stream.write(bytes.data(), size / 2);
    stream.write(bytes.data() + size / 2, size - size / 2);
    stream.finish();
    const std::string text = out.str();
    ASSERT_EQ(text.size() % 4, 0U);
    std::string packed;
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < text.size(); i += 4) {
      std::uint32_t word = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t six = text[i + k] == '=' ? 0 : alphabet.find(text[i + k]);
        ASSERT_NE(six, std::string::npos);
        word = word << 6 | static_cast<std::uint32_t>(six);
      }
      for (int k = 16; k >= 0; k -= 8) packed += static_cast<char>(word >> k);
      for (std::size_t k = 2; k < 4; ++k)
        if (text[i + k] == '=') packed.pop_back();
    }
    std::string back(size + 1, '\0');
    uLongf length = back.size();
    ASSERT_EQ(uncompress(reinterpret_cast<Bytef *>(back.data()), &length,
                         reinterpret_cast<const Bytef *>(packed.data()), packed.size()),
              Z_OK);
    back.resize(length);
    EXPECT_EQ(back, bytes);
  }
}

/// Eight quanta of 125 ns, sampled behind the sixth.
class BitBegins : public ::testing::Test {
 protected:
  static constexpr Time kTq = 125'000, kBit = 8 * kTq, kToSample = 6 * kTq;
  const TrackedBit &bit_at(Time sample, Field field, std::uint8_t left, bool begins = false) {
    BitRecord record;
    record.time = sample;
    record.at.field = field;
    record.at.left = left;
    record.at.rx = begins ? d : r;
    record.after.start = begins;
    return track.take(record);
  }
  Clock clock{ClockConfig{.frequency_hz = 8e6}};
  BitTrack track{BitTiming{1, 3, 2, 2, 1}, clock};
};

// SY-08: a late edge lengthens the bit before its sample point, an early one shortens the bit
// before.
TEST_F(BitBegins, AreMovedByResynchronisation) {
  bit_at(10 * kBit, Field::kData, 7);
  const TrackedBit late = bit_at(11 * kBit + kTq, Field::kData, 6);
  EXPECT_EQ(late.lengthened, 1);
  EXPECT_EQ(late.start, static_cast<double>(11 * kBit + kTq - kToSample - kTq));
  const TrackedBit normal = bit_at(12 * kBit + kTq, Field::kData, 5);
  EXPECT_EQ(normal.lengthened, 0);
  EXPECT_EQ(normal.start, static_cast<double>(12 * kBit + kTq - kToSample));
  const TrackedBit early = bit_at(13 * kBit, Field::kData, 4);
  EXPECT_EQ(early.previous_changed, -1);
  EXPECT_EQ(early.start, static_cast<double>(13 * kBit - kToSample));
}

// EF-06: a wrong bit in an error flag makes a new one begin, here at the first bit.
TEST_F(BitBegins, OfAFlagThatIsSentAnewAreNumberedAnew) {
  std::vector<int> indices;
  for (const std::uint8_t left : {5, 5, 4, 3})
    indices.push_back(
        bit_at(static_cast<Time>(10 + indices.size()) * kBit, Field::kErrFlag, left).index);
  EXPECT_EQ(indices, (std::vector<int>{0, 0, 1, 2}));
}

// SY-06: the SOF of a foreign frame begins anew, wherever the idle bit stood.
TEST_F(BitBegins, AreSetByHardSynchronisation) {
  bit_at(10 * kBit, Field::kIdle, 0);
  const TrackedBit sof = bit_at(11 * kBit + 5 * kTq, Field::kIdle, 0, true);
  EXPECT_TRUE(sof.begins);
  EXPECT_EQ(sof.field, Field::kSof);
  EXPECT_EQ(sof.lengthened, 0);
  EXPECT_EQ(sof.previous_changed, 5);
  EXPECT_EQ(sof.start, static_cast<double>(11 * kBit + 5 * kTq - kToSample));
}

TEST_F(BitBegins, PlacesCountWithoutStuffBits) {
  EXPECT_EQ(bit_at(1 * kBit, Field::kId, 10).index, 0);
  EXPECT_EQ(bit_at(2 * kBit, Field::kId, 9).index, 1);
  BitRecord stuff;
  stuff.time = 3 * kBit;
  stuff.at.field = Field::kId;
  stuff.at.left = 8;
  stuff.at.stuff = true;
  EXPECT_EQ(track.take(stuff).index, 2);
  EXPECT_EQ(bit_at(4 * kBit, Field::kId, 8).index, 2);
  EXPECT_EQ(bit_at(5 * kBit, Field::kErrFlag, 4).index, 0);
  EXPECT_EQ(bit_at(6 * kBit, Field::kErrFlag, 5).index, 0) << "another flag";
}

}  // namespace
}  // namespace vericansim

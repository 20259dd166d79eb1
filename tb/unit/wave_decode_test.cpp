// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveforms that end anywhere: in a frame that nobody has seen the end of, and behind one; and
// those that begin too late for their first frame.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/frame_codec.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = 2 * kMicrosecond;
constexpr std::size_t kRest = 12;  // recessive bits in front of the frame

/// The levels of a frame, acknowledged or not, up to `bits` bits; the waveform ends there, or with
/// its last edge.
Wave cut_wave(const Frame &frame, bool acked, std::size_t bits, bool at_last_edge) {
  Wave wave{"bus.can", 500e3, 0, {{0, Level::kRecessive}}};
  const auto encoded = encode_frame(frame);
  const std::size_t ack = encoded.stuffed_length + 1;
  for (std::size_t i = 0; i < bits; ++i) {
    const bool dominant = i == ack ? acked : encoded.bits[i].level == Level::kDominant;
    const Level level = dominant ? Level::kDominant : Level::kRecessive;
    const Time time = static_cast<Time>(kRest + i) * kBit;
    if (level != wave.changes.back().second) wave.changes.emplace_back(time, level);
  }
  wave.end = at_last_edge ? wave.changes.back().first : static_cast<Time>(kRest + bits) * kBit;
  return wave;
}

const Frame kFrame{0x123, false, false, 2, {0x00, 0xFF}};

// Without the acknowledge slot nobody knows how the frame ended: it is cut, and nothing else.
TEST(WaveDecode, AFrameCutBeforeItsAckDelimiterIsNoFrame) {
  const std::size_t before = encode_frame(kFrame).stuffed_length + 2;  // the ACK slot ends there
  for (const bool acked : {false, true})
    for (std::size_t bits = 1; bits <= before; ++bits) {
      const auto result = decode_wave(cut_wave(kFrame, acked, bits, false), 800);
      EXPECT_TRUE(result.events.empty()) << bits << " " << to_string(result.events.at(0));
      EXPECT_EQ(result.cut, static_cast<Time>(kRest) * kBit) << bits;
    }
}

TEST(WaveDecode, AFrameCutBehindItsAckDelimiterIsWhole) {
  const std::size_t encoded = encode_frame(kFrame).bits.size();
  for (const bool acked : {false, true})
    for (std::size_t bits = encoded - 7; bits <= encoded; ++bits) {
      const auto result = decode_wave(cut_wave(kFrame, acked, bits, false), 800);
      ASSERT_EQ(result.events.size(), 1U) << bits;
      EXPECT_EQ(result.events[0].frame, kFrame);
      EXPECT_EQ(result.events[0].acked, acked);
      EXPECT_EQ(result.cut, std::nullopt) << bits;
    }
}

// A file of changes ends with the last of them, which is the one behind the acknowledge.
TEST(WaveDecode, AFileMayEndWithTheEdgeBehindTheAcknowledge) {
  const std::size_t whole = encode_frame(kFrame).bits.size();
  const auto acked = decode_wave(cut_wave(kFrame, true, whole, true), 800);
  ASSERT_EQ(acked.events.size(), 1U);
  EXPECT_TRUE(acked.events[0].acked);
  const auto open = decode_wave(cut_wave(kFrame, false, whole, true), 800);
  EXPECT_TRUE(open.events.empty());
  EXPECT_TRUE(open.cut);
}

// IN-01: eleven recessive bits come before the first frame that is heard.
TEST(WaveDecode, WhatComesBeforeElevenRecessiveBitsIsTold) {
  const auto begun_at = [](Time time, std::size_t frames) {
    Wave wave{"bus.can", 500e3, 0, {{0, Level::kRecessive}}};
    const Wave one = cut_wave(kFrame, true, encode_frame(kFrame).bits.size(), false);
    for (std::size_t n = 0; n < frames; ++n) {
      const Time shift = time + static_cast<Time>(n) * one.end;
      for (auto change = one.changes.begin() + 1; change != one.changes.end(); ++change)
        wave.changes.emplace_back(change->first - kRest * kBit + shift, change->second);
      wave.end = shift + one.end - kRest * kBit;
    }
    return wave;
  };
  EXPECT_EQ(passed_over(begun_at(11 * kBit, 2), 800), "");
  EXPECT_EQ(passed_over(Wave{"bus.can", 500e3, kMillisecond, {{0, Level::kRecessive}}}, 800), "");
  // SOF, a frame of `bits` bits of which the last eight are recessive (delimiter, EOF), and three.
  const auto bits = static_cast<Time>(encode_frame(kFrame).bits.size());
  EXPECT_EQ(decode_wave(begun_at(10 * kBit, 2), 800).events.size(), 1U);
  const std::string told = fmt::format(
      "what is on the bus in its first {:.3f} us is passed over: eleven "
      "recessive bits come first",
      static_cast<double>((10 + bits + 3) * kBit) / kMicrosecond);
  EXPECT_EQ(passed_over(begun_at(10 * kBit, 2), 800), told);
  Wave late = begun_at(10 * kBit, 2);
  for (auto &change : late.changes) change.first += kSecond;
  late.end += kSecond;
  EXPECT_EQ(passed_over(late, 800), told) << "from its beginning on, wherever that is";
  EXPECT_EQ(passed_over(begun_at(10 * kBit, 1), 800),
            "nowhere in it are eleven recessive bits, behind which alone a frame can begin");
}

}  // namespace
}  // namespace vericansim

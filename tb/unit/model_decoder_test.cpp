// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus decoder: written waveforms, drifting transmitters, and what follows each kind of error.
#include "model/bus_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using namespace model_bench;  // NOLINT: the bench exists for these tests

/// Feeds written bits to a decoder and keeps its events.
class Feed {
 public:
  explicit Feed(DecoderConfig config = {.starts_idle = true})
      : decoder_(config, [this](const BusEvent &e) { events.push_back(e); }),
        bit_(config.bit_time) {}

  /// Bits of `length` ps each; by default of the nominal length.
  Feed &bits(const std::string &text, Time length = 0) {
    for (const char c : text) {
      decoder_.on_level(now, c == '1' ? Level::kRecessive : Level::kDominant);
      now += length == 0 ? bit_ : length;
    }
    return *this;
  }
  Feed &done() {
    decoder_.finish(now);
    return *this;
  }

  std::vector<BusEvent> events;
  Time now = 0;

 private:
  BusDecoder decoder_;
  Time bit_;
};

Frame random_frame(std::mt19937 &rng) {
  Frame f;
  f.extended = (rng() & 1) != 0;
  f.remote = (rng() & 3) == 0;
  f.id = static_cast<std::uint32_t>(rng()) & (f.extended ? 0x1FFFFFFFu : 0x7FFu);
  f.dlc = static_cast<std::uint8_t>(rng() & 15);
  for (unsigned i = 0; i < f.payload_size(); ++i) {
    f.data[i] = (rng() & 1) != 0 ? static_cast<std::uint8_t>(rng()) : std::uint8_t{0};
  }
  return f;
}

TEST(BusDecoder, GoldenFrameWithTimes) {  // GV-1, FF-11
  Feed feed;
  feed.bits("111" + whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 1u);
  const BusEvent &e = feed.events[0];
  EXPECT_EQ(e.kind, BusEventKind::kFrame);
  EXPECT_EQ(e.frame, kGv1);
  EXPECT_TRUE(e.acked);
  EXPECT_EQ(e.stuffed_length, 43u);
  EXPECT_EQ(e.start, 3 * kMicrosecond);
  EXPECT_EQ(e.end, (3 + 53) * kMicrosecond);
}

TEST(BusDecoder, WaitsForElevenRecessiveBits) {  // IN-01
  Feed feed(DecoderConfig{});
  // Enters in the middle of a frame: that one is not decoded, the next one is.
  feed.bits(whole(kGv1).substr(9) + "111" + whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 1u);
  EXPECT_EQ(feed.events[0].start, (53 - 9 + 3) * kMicrosecond);
  Feed early(DecoderConfig{});
  early.bits("0" + rep(10, "1") + whole(kGv1) + "111").done();
  EXPECT_TRUE(early.events.empty());
}

TEST(BusDecoder, RandomTrafficFromDriftingTransmitters) {  // IF-02, BT-08
  std::mt19937 rng(3);
  Feed feed;
  std::vector<Frame> sent;
  for (int n = 0; n < 3000; ++n) {
    sent.push_back(random_frame(rng));
    const Time length = kMicrosecond + static_cast<Time>(rng() % 20001) - 10000;  // +-1 %
    const int idle = (rng() & 1) != 0 ? 0 : static_cast<int>(rng() % 20);
    feed.bits(whole(sent.back()) + "111" + rep(idle, "1"), length);
  }
  feed.done();
  ASSERT_EQ(feed.events.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(feed.events[i].kind, BusEventKind::kFrame);
    EXPECT_EQ(feed.events[i].frame, sent[i]) << i;
  }
}

TEST(BusDecoder, LateAcknowledgeMovesTheGridOnlyALittle) {  // SY-08, SY-18
  Feed feed;
  for (int n = 0; n < 20; ++n) {
    // The slot is dominant from 0.35 to 1.1 bits: a grid moved by the whole 0.35 would miss it.
    feed.bits(to_delimiter(kGv1)).bits("1", 350'000).bits("0", 750'000);
    feed.bits("1", 900'000).bits(rep(10, "1"));
  }
  feed.done();
  ASSERT_EQ(feed.events.size(), 20u);
  for (const BusEvent &e : feed.events) EXPECT_TRUE(e.acked && e.frame == kGv1);
}

TEST(BusDecoder, StartOfFrameInInt3) {  // IF-05
  Feed feed;
  feed.bits(whole(kGv1) + "11" + whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 2u);
  EXPECT_EQ(feed.events[1].frame, kGv1);
  EXPECT_EQ(feed.events[1].start, (53 + 2) * kMicrosecond);
}

TEST(BusDecoder, GlitchesInIdleLeaveNothing) {  // IF-15, SY-15
  Feed feed;
  feed.bits("111").bits("0", 200'000).bits("1", 50'000).bits(whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 1u);
  EXPECT_EQ(feed.events[0].frame, kGv1);
  Feed spike;  // d at exactly one sample point: SOF, then the sixth r
  spike.bits("0" + rep(40, "1")).done();
  ASSERT_EQ(spike.events.size(), 1u);
  EXPECT_EQ(spike.events[0].kind, BusEventKind::kErrorFrame);
  EXPECT_EQ(spike.events[0].problem, BusProblem::kStuff);
  EXPECT_EQ(spike.events[0].field, Field::kId);
  EXPECT_EQ(spike.events[0].index, 5);
  EXPECT_EQ(spike.events[0].flag_bits, 0u);
  EXPECT_EQ(spike.events[0].start, 6 * kMicrosecond);
  EXPECT_EQ(spike.events[0].end, (7 + 6 + 8) * kMicrosecond);  // passive flag, delimiter
}

TEST(BusDecoder, DominantBitsAfterAPassiveFlag) {  // TL-09
  Feed feed;
  feed.bits("0" + rep(12, "1") + rep(6, "0") + rep(11, "1") + whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 2u);
  EXPECT_EQ(feed.events[0].kind, BusEventKind::kErrorFrame);
  EXPECT_EQ(feed.events[0].flag_bits, 6u);
  EXPECT_EQ(feed.events[1].frame, kGv1);
}

TEST(BusDecoder, SpikeThatNobodyAnswers) {
  std::string spiked = whole(kGv1);
  spiked[48] = '0';  // EOF3
  Feed feed;         // the nodes go on: the decoder needs eleven recessive bits and loses one frame
  for (int n = 0; n < 3; ++n) feed.bits((n == 0 ? spiked : whole(kGv1)) + "111");
  feed.done();
  ASSERT_EQ(feed.events.size(), 2u);
  EXPECT_EQ(feed.events[0].kind, BusEventKind::kErrorFrame);
  EXPECT_EQ(feed.events[0].problem, BusProblem::kForm);
  EXPECT_EQ(feed.events[0].flag_bits, 1u);
  EXPECT_EQ(feed.events[1].start, 2 * 56 * kMicrosecond);
}

TEST(BusDecoder, OverloadFrames) {  // OV-03
  const std::string flag = rep(6, "0") + rep(8, "1");
  Feed feed;
  feed.bits(whole(kGv1) + "0" + flag + "10" + flag + "111" + whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 4u);
  EXPECT_EQ(feed.events[1].kind, BusEventKind::kOverloadFrame);
  EXPECT_EQ(feed.events[1].field, Field::kInt);
  EXPECT_EQ(feed.events[1].index, 0);
  EXPECT_EQ(feed.events[1].flag_bits, 7u);
  EXPECT_EQ(feed.events[2].index, 1);
  EXPECT_EQ(feed.events[3].frame, kGv1);
}

TEST(BusDecoder, DominantEof7) {  // ED-11, VA-03
  Feed feed;
  std::string text = whole(kGv1);
  text.back() = '0';
  feed.bits(text + rep(6, "0") + rep(11, "1") + whole(kGv1) + "111").done();
  ASSERT_EQ(feed.events.size(), 3u);
  EXPECT_EQ(feed.events[0].kind, BusEventKind::kFrame);
  EXPECT_TRUE(feed.events[0].eof7_dominant);
  EXPECT_EQ(feed.events[1].kind, BusEventKind::kOverloadFrame);
  EXPECT_EQ(feed.events[1].field, Field::kEof);
  EXPECT_EQ(feed.events[1].index, 6);
  EXPECT_FALSE(feed.events[2].eof7_dominant);
}

TEST(BusDecoder, CrcErrorFlaggedAndNot) {  // ED-20
  std::string bad = kGv1Bits;
  bad.back() = '0';
  Feed feed;
  feed.bits(bad + "111" + rep(7, "0") + rep(11, "1")).bits(bad + rep(13, "1")).done();
  ASSERT_EQ(feed.events.size(), 2u);
  EXPECT_EQ(feed.events[0].kind, BusEventKind::kErrorFrame);
  EXPECT_EQ(feed.events[0].problem, BusProblem::kCrc);
  EXPECT_EQ(feed.events[0].field, Field::kEof);
  EXPECT_EQ(feed.events[0].index, 0);
  EXPECT_EQ(feed.events[0].start, 46 * kMicrosecond);
  EXPECT_EQ(feed.events[0].flag_bits, 7u);
  EXPECT_EQ(feed.events[0].end, (46 + 7 + 8) * kMicrosecond);
  EXPECT_EQ(feed.events[1].kind, BusEventKind::kBadFrame);
  EXPECT_FALSE(feed.events[1].acked);
}

TEST(BusDecoder, AcknowledgeErrorAndErrorInTheDelimiter) {  // TL-03, EF-09
  Feed feed;
  feed.bits(to_delimiter(kGv1) + "1" + rep(6, "0") + "1110" + rep(6, "0") + rep(7, "1") + "0" +
            rep(6, "0") + rep(11, "1") + whole(kGv1) + "111")
      .done();
  ASSERT_EQ(feed.events.size(), 4u);
  EXPECT_EQ(feed.events[0].field, Field::kAckDel);
  EXPECT_EQ(feed.events[0].problem, BusProblem::kForm);
  EXPECT_FALSE(feed.events[0].acked);
  EXPECT_EQ(feed.events[0].flag_bits, 6u);
  EXPECT_EQ(feed.events[1].kind, BusEventKind::kErrorFrame);
  EXPECT_EQ(feed.events[1].field, Field::kDel);
  EXPECT_EQ(feed.events[1].index, 2);  // DEL4
  EXPECT_EQ(feed.events[2].kind, BusEventKind::kOverloadFrame);
  EXPECT_EQ(feed.events[2].index, 6);  // DEL8
  EXPECT_EQ(feed.events[3].frame, kGv1);
}

/// Two nodes, the bit number `at` after SOF inverted on the whole wire; then the retry.
std::vector<BusEvent> disturbed(int at, int tec) {
  std::vector<BusEvent> events;
  BusDecoder decoder({.starts_idle = true}, [&](const BusEvent &e) { events.push_back(e); });
  Wire wire(2);
  wire.nodes[0].preset_counters(tec, 0);
  wire.nodes[0].request(kGv1);
  wire.run(1);
  for (int bit = 0; bit < 200; ++bit) {
    wire.step([&](std::size_t, Level l) { return bit == at ? !l : l; });
    const Level level = bit == at ? !wire.waveform.back() : wire.waveform.back();
    decoder.on_level(bit * kMicrosecond, level);
  }
  decoder.finish(200 * kMicrosecond);
  return events;
}

TEST(BusDecoder, OneErrorFrameForEachInvertedBitThenTheRetry) {  // EF-07
  for (const int tec : {0, 128}) {
    for (int at = 1; at < 52; ++at) {
      if (at == 44) continue;  // the slot: a missing acknowledge may pass
      const std::vector<BusEvent> events = disturbed(at, tec);
      ASSERT_EQ(events.size(), 2u) << at << " TEC " << tec;
      EXPECT_EQ(events[0].kind, BusEventKind::kErrorFrame) << at;
      EXPECT_EQ(events[0].frame_start, 0) << at;
      EXPECT_GE(events[0].start, at * kMicrosecond) << at;
      // Six equal bits show most errors; a CRC error in a passive transmitter's frame shows at
      // EOF1.
      EXPECT_LE(events[0].start, std::max(at + 6, 46) * kMicrosecond) << at;
      EXPECT_GE(events[0].flag_bits, 6u) << at;
      EXPECT_LE(events[0].flag_bits, 13u) << at;
      EXPECT_EQ(events[1].kind, BusEventKind::kFrame) << at;
      EXPECT_EQ(events[1].frame, kGv1) << at;
    }
  }
}

TEST(BusDecoder, ComesToRestAfterNoise) {
  std::mt19937 rng(5);
  for (int n = 0; n < 200; ++n) {
    Feed feed;
    std::string noise;
    for (int i = 0; i < 300; ++i) noise.push_back((rng() & 1) != 0 ? '1' : '0');
    // Eleven recessive bits bring every node back; a passive flag in progress takes six bits more.
    feed.bits(noise).bits(rep(25, "1") + whole(kGv1) + "111").done();
    ASSERT_FALSE(feed.events.empty());
    EXPECT_EQ(feed.events.back().kind, BusEventKind::kFrame);
    EXPECT_EQ(feed.events.back().frame, kGv1);
    EXPECT_EQ(feed.events.back().start, (300 + 25) * kMicrosecond);
  }
}

TEST(BusDecoder, LongIdleCostsNothing) {
  std::uint64_t frames = 0;
  BusDecoder decoder({.starts_idle = true},
                     [&](const BusEvent &e) { frames += e.kind == BusEventKind::kFrame ? 1 : 0; });
  const std::vector<Level> bits = levels_from_string(whole(kGv1));
  Time now = 0;
  for (int n = 0; n < 1000; ++n) {
    for (const Level level : bits) {
      decoder.on_level(now, level);
      now += kMicrosecond;
    }
    now += 3600 * kSecond;
  }
  decoder.finish(now);
  EXPECT_EQ(frames, 1000u);
  EXPECT_EQ(decoder.frames(), 1000u);
}

TEST(BusDecoder, RefusesImpossibleSettings) {
  const BusDecoder::Sink none;
  EXPECT_THROW(BusDecoder({.bit_time = 0}, none), std::invalid_argument);
  EXPECT_THROW(BusDecoder({.sample_point = 1000}, none), std::invalid_argument);
  EXPECT_THROW(BusDecoder({.sync_jump = 501}, none), std::invalid_argument);
}

TEST(BusDecoder, EventsAsText) {
  Feed feed;
  feed.bits("1" + whole(kGv1) + "0" + rep(6, "0") + rep(11, "1")).done();
  ASSERT_EQ(feed.events.size(), 2u);
  EXPECT_EQ(to_string(feed.events[0]), "1.000 us frame 123 [1] 55");
  EXPECT_EQ(to_string(feed.events[1]), "54.000 us overload frame at INT 1, flag of 7 bits");
}

}  // namespace
}  // namespace vericansim

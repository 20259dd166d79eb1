// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 3 of the rule book: what the CRC covers, how it is compared, and that it starts afresh.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

std::vector<std::uint8_t> list_of(std::string_view bits) {
  std::vector<std::uint8_t> list;
  for (const char c : bits) list.push_back(c == '1');
  return list;
}

// CR-01: the judge's long division gives the check word of the rule book.
TEST(Crc, LongDivisionGivesTheCheckWord) {
  std::string bits;
  for (const char c : std::string_view{"123456789"}) bits += binary(static_cast<unsigned>(c), 8);
  EXPECT_EQ(crc15(list_of(bits)), 0x059E);
}

// CR-01, CR-02: with one covered bit changed at a time (identifier, format, DLC, data) the CRC on
// the wire is the remainder of the long division over SOF..last data bit.
TEST(Crc, SentCrcCoversEveryBitOfTheFrame) {
  std::vector<Frame> frames{base_frame(0x2C5, {0x69}), extended_frame(0x0B1C5A93, {0x69}),
                            remote_frame(0x2C5, false, 1), remote_frame(0x0B1C5A93, true, 1)};
  for (unsigned bit = 0; bit < 11; ++bit) frames.push_back(base_frame(0x2C5u ^ 1u << bit, {0x69}));
  for (unsigned bit = 0; bit < 29; ++bit) frames.push_back(extended_frame(0x0B1C5A93u ^ 1u << bit));
  for (unsigned bit = 0; bit < 64; ++bit) {
    Frame frame = base_frame(0x2C5, {9, 8, 7, 6, 5, 4, 3, 2});
    frame.data[bit / 8] ^= static_cast<std::uint8_t>(0x80u >> bit % 8);
    frames.push_back(frame);
  }
  Scene scene;
  for (const Frame &frame : frames) {
    scene.send(frame);
    const std::size_t head = ack_offset(frame) - 1;
    const std::string tx = scene.play(r_bits(head + 1) + "0" + r_bits(11));
    const std::string plain = destuffed(tx.substr(0, head));
    const std::size_t covered = plain.size() - 15;
    ASSERT_EQ(plain.substr(covered), binary(crc15(list_of(plain.substr(0, covered))), 15));
  }
  EXPECT_EQ(scene.dut().sent().size(), frames.size());
}

// CR-02, FF-05: the receiver's CRC covers SRR, r1 and r0 as sampled: recessive ones are
// acknowledged with the CRC that belongs to them, and not with the CRC of dominant ones.
TEST(Crc, ReceivedCrcCoversReservedBitsAndSrr) {
  const EncodeOptions changed[] = {
      {.r0 = Level::kRecessive}, {.r1 = Level::kRecessive}, {.srr = Level::kDominant}};
  const Frame frame = extended_frame(0x0B1C5A93, {0x69, 0x96});
  const std::string usual = plain_bits(frame);
  for (const EncodeOptions &options : changed) {
    Scene scene;
    const std::string good = wire(frame, options);
    EXPECT_EQ(scene.play(good + r_bits(3)), receiver_tx(good) + r_bits(3));
    EXPECT_EQ(scene.dut().received().size(), 1u);
    const std::string plain = plain_bits(frame, options);
    const std::string bad =
        stuffed(plain.substr(0, plain.size() - 15) + usual.substr(usual.size() - 15)) + frame_end();
    EXPECT_EQ(scene.play(bad), r_bits(bad.size() - 7) + d_bits(6) + "1");
    EXPECT_EQ(scene.dut().received().size(), 1u);
  }
}

// CR-02: the raw DLC is covered, in data frames of eight bytes too: DLC 9 with the CRC of DLC 8 is
// refused (section 20 has their CRCs: GV-8).
TEST(Crc, ReceivedCrcCoversTheRawDlc) {
  Frame frame = base_frame(0x2AA, {1, 2, 3, 4, 5, 6, 7, 8});
  const auto with_crc = [&](std::uint8_t dlc, std::uint16_t crc) {
    frame.dlc = dlc;
    const std::string plain = plain_bits(frame);
    return stuffed(plain.substr(0, plain.size() - 15) + binary(crc, 15)) + frame_end();
  };
  for (const auto &[dlc, crc] :
       {std::pair{8, 0x248C}, std::pair{9, 0x0FD2}, std::pair{15, 0x318F}}) {
    for (const int given : {8, 9, 15}) {
      Scene scene;
      const std::string bits =
          with_crc(static_cast<std::uint8_t>(given), static_cast<std::uint16_t>(crc));
      scene.play(bits + r_bits(20));
      EXPECT_EQ(scene.dut().received().size(), given == dlc ? 1u : 0u);
    }
  }
}

class WrongCrc : public ::testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(EveryBit, WrongCrc, ::testing::Range(0u, 15u));

// CR-03: each single CRC bit inverted: no acknowledge, no delivery. CR-04, ED-20: the frame goes on
// to the ACK delimiter, the flag starts at EOF1. FC-02: REC + 1, once. AK-01.
TEST_P(WrongCrc, IsNotAcknowledgedAndFlaggedAtEof1) {
  for (const Frame &frame : typical_frames()) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      const std::string bits =
          wire_with_bad_crc(frame, static_cast<std::uint16_t>(1u << GetParam()));
      EXPECT_EQ(scene.play(bits.substr(0, bits.size() - 7)), r_bits(bits.size() - 7));
      EXPECT_EQ(scene.play(r_bits(6)), flag_of(counters));
      scene.play(r_bits(8 + 3));
      scene.expect_counters(counters.tec, counters.rec + 1u);
      EXPECT_EQ(scene.events().errors, kErrCrc);
      EXPECT_TRUE(scene.dut().received().empty());
      scene.expect_reception(frame);  // CR-05
    }
  }
}

// CR-03: errors of several bits are found too, in every position of a byte.
TEST(Crc, AnyPatternOfWrongBitsIsFound) {
  const Frame frame = base_frame(0x4B3, {0xC0, 0x0F});
  Scene scene;
  unsigned errors = 0;
  for (std::uint16_t mask = 1; mask < 0x8000; mask = static_cast<std::uint16_t>(mask * 3 + 1)) {
    scene.play(wire_with_bad_crc(frame, mask) + r_bits(14));
    ++errors;
    EXPECT_TRUE(scene.dut().received().empty());
    if (errors > 100) break;
  }
  EXPECT_GT(errors, 5u);
}

// CR-05: a good frame is received right after one that was broken by a stuff error in any bit: SOF
// in the third intermission bit.
TEST(Crc, StartsAfreshAfterAnErrorAtAnyBit) {
  const Frame frame = extended_frame(0x0B1C5A93, {0x69, 0x96});
  const std::string bits = wire(frame);
  for (std::size_t at = 1; at < ack_offset(frame) - 6; ++at) {
    Scene scene;
    // Six equal bits, begun anywhere, are a stuff error at the latest seven bits later.
    std::string lt = bits.substr(0, at);
    const char last = lt.back();
    unsigned run = 0;
    for (std::size_t i = lt.size(); i-- > 0 && lt[i] == last;) ++run;
    lt += std::string(6 - run, last);
    EXPECT_EQ(scene.play(lt + r_bits(6)), r_bits(lt.size()) + d_bits(6)) << at;
    scene.play(r_bits(8 + 2));
    EXPECT_EQ(scene.play(bits), receiver_tx(bits)) << at;
    EXPECT_EQ(scene.dut().received().size(), 1u) << at;
    scene.expect_counters(0, 0);
  }
}

// CR-05: the same for the transmitter: the frame is sent again, bit-exact, after an error at any
// bit.
TEST(Crc, OwnFrameIsSentAfreshAfterAnErrorAtAnyBit) {
  const Frame frame = base_frame(0x2C5, {0x69, 0xFF});
  const std::string bits = wire(frame);
  for (std::size_t at = 0; at < ack_offset(frame) - 1; ++at) {
    if (at > 0 && at < 13 && bits[at] == '1') continue;  // lost arbitration: see section 6
    Scene scene;
    scene.send(frame);
    scene.play(r_bits(at));
    scene.bench.force_next(0, Effect::kFlip);
    EXPECT_EQ(scene.play(r_bits(1 + 6 + 8 + 3)), bits.substr(at, 1) + d_bits(6) + r_bits(11)) << at;
    EXPECT_EQ(scene.play(flipped(r_bits(bits.size()), ack_offset(frame))), bits) << at;
    scene.expect_counters(7, 0);
  }
}

// CR-05, IF-05: SOF in INT3 starts the CRC afresh, after a good frame and after one with a wrong
// CRC.
TEST(Crc, StartsAfreshWithSofInInt3) {
  const Frame frame = base_frame(0x000, {0x00});
  Scene scene;
  scene.play(wire(base_frame(0x2C5, {0x69})) + r_bits(2));
  EXPECT_EQ(scene.play(wire(frame)), receiver_tx(wire(frame)));
  const std::string bad = wire_with_bad_crc(frame, 0x4001);
  scene.play(r_bits(3) + bad + r_bits(6 + 8 - 7 + 2));
  EXPECT_EQ(scene.play(wire(frame)), receiver_tx(wire(frame)));
  EXPECT_EQ(scene.dut().received().size(), 3u);
}

// CR-05, IF-15, PF-58: a dominant glitch in idle that is over before the sample point leaves
// nothing behind: SOF in the next bit begins a good frame.
TEST(Crc, StartsAfreshAfterAGlitchInIdle) {
  for (unsigned clocks = 1; clocks < 5; ++clocks) {
    for (const Frame &frame : {base_frame(0x000, {0x00}), extended_frame(0x1FFFFFFF)}) {
      Scene scene;
      for (unsigned i = 0; i < clocks; ++i) scene.bench.clock(Level::kDominant);
      scene.play("1");
      EXPECT_EQ(scene.field(), Field::kIdle);
      scene.expect_reception(frame);
      scene.expect_counters(0, 0);
    }
  }
}

// CR-05, FF-06: the same after a protocol exception and integration.
TEST(Crc, StartsAfreshAfterAProtocolException) {
  CoreConfig config = CoreBench::default_config();
  config.fd_tolerant = true;
  Scene scene{kActive, config};
  scene.play(wire(base_frame(0x2C5), {.r0 = Level::kRecessive}).substr(0, 15) + r_bits(11));
  scene.expect_reception(base_frame(0x000, {0x00}));
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 1 of the rule book: order, number and level of the bits of a frame, in both roles.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

// The frame bit by bit as FF-01, FF-02 and FF-03 list it, up to the CRC and without stuff bits.
std::string listed_bits(const Frame &f) {
  const std::string rtr = f.remote ? "1" : "0";
  std::string bits = "0";  // SOF
  if (f.extended) {
    bits += binary(f.id >> 18, 11) + "1" + "1";            // SRR, IDE
    bits += binary(f.id & 0x3FFFF, 18) + rtr + "0" + "0";  // RTR, r1, r0
  } else {
    bits += binary(f.id, 11) + rtr + "0" + "0";  // RTR, IDE, r0
  }
  bits += binary(f.dlc, 4);
  const unsigned bytes = f.remote ? 0u : f.dlc > 8 ? 8u : f.dlc;
  for (unsigned i = 0; i < bytes; ++i) bits += binary(f.data[i], 8);
  return bits;
}

std::uint16_t crc_of(const std::string &bits) {
  std::vector<std::uint8_t> list;
  for (const char c : bits) list.push_back(c == '1');
  return crc15(list);
}

Frame with_data(Frame frame) {
  for (unsigned i = 0; i < frame.payload_size(); ++i) {
    frame.data[i] = static_cast<std::uint8_t>(0x35 + 0x4B * i);
  }
  return frame;
}

// Sends `frame` and compares what is on the wire with the list of its fields.
void expect_listed_bits(const Frame &frame, const Counters &counters) {
  Scene scene{counters};
  const std::string bits = listed_bits(frame);
  const std::string plain = bits + binary(crc_of(bits), 15);
  const std::string head = stuffed(plain);
  scene.send(frame);
  const std::string tx = scene.play(r_bits(head.size() + 1) + "0" + r_bits(8));
  EXPECT_EQ(destuffed(tx.substr(0, head.size())), plain);
  EXPECT_EQ(tx.substr(head.size()), frame_end());
  EXPECT_EQ(scene.dut().sent().size(), 1u);
  scene.play(r_bits(11));
}

enum class Kind { kBaseData, kExtendedData, kBaseRemote, kExtendedRemote };

Frame frame_of(Kind kind, std::uint8_t dlc) {
  const bool extended = kind == Kind::kExtendedData || kind == Kind::kExtendedRemote;
  const bool remote = kind == Kind::kBaseRemote || kind == Kind::kExtendedRemote;
  return with_data(
      {.id = extended ? 0x0B1C5A93u : 0x2C5u, .extended = extended, .remote = remote, .dlc = dlc});
}

constexpr Kind kKinds[] = {Kind::kBaseData, Kind::kExtendedData, Kind::kBaseRemote,
                           Kind::kExtendedRemote};

class EveryLength : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static std::uint8_t dlc() { return static_cast<std::uint8_t>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Dlc, EveryLength, ::testing::Range(0, 16));

// FF-01, FF-02, FF-03: order of the fields. FF-04: reserved bits and base IDE dominant, SRR
// recessive. FF-07: DLC 9..15 are eight bytes, the raw code is on the wire and in the CRC.
TEST_P(EveryLength, IsSentFieldByField) {
  for (const Kind kind : kKinds) {
    for (const Counters &counters : kStates) expect_listed_bits(frame_of(kind, dlc()), counters);
  }
}

// FF-08: eight bytes and the raw code are reported. FF-09: a remote frame keeps its DLC and brings
// no data. FF-03: its CRC follows the DLC. FF-13: the format is that of the wire.
TEST_P(EveryLength, IsReceivedAndAcknowledged) {
  for (const Kind kind : kKinds) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      scene.expect_reception(frame_of(kind, dlc()));
    }
  }
}

// FF-09: nothing of the data frame before it shows in a remote frame, nor is a byte missing in the
// data frame after it.
TEST_P(EveryLength, RemoteFrameBetweenDataFramesTouchesNoData) {
  for (const bool extended : {false, true}) {
    Scene scene;
    scene.expect_reception(frame_of(Kind::kBaseData, 8));
    scene.expect_reception(remote_frame(0x123, extended, dlc()));
    scene.expect_reception(frame_of(Kind::kExtendedData, 8));
  }
}

// FF-11: 44 + 8n and 64 + 8n bits and the stuff bits, from SOF to EOF7; three bits later comes the
// next one.
TEST_P(EveryLength, LastsAsManyBitsAsTheFormulaSays) {
  for (const Kind kind : kKinds) {
    const Frame frame = frame_of(kind, dlc());
    const unsigned bytes = frame.payload_size();
    const std::size_t unstuffed = (frame.extended ? 64 : 44) + 8 * bytes;
    const std::size_t region = (frame.extended ? 54 : 34) + 8 * bytes;
    const std::string head = listed_bits(frame) + binary(crc_of(listed_bits(frame)), 15);
    const std::size_t stuff_bits = stuffed(head).size() - head.size();
    EXPECT_LE(stuff_bits, (region - 1) / 4);
    Scene scene;
    scene.bench.lt_acknowledges(true);
    scene.request(frame);
    scene.send(frame);
    const std::uint64_t sof = scene.bench.bits();
    ASSERT_TRUE(scene.bench.run_until([&] { return scene.events().sent == 1; }, 200));
    EXPECT_EQ(scene.bench.bits() - sof, unstuffed + stuff_bits);
    scene.run_to(Field::kSof);
    EXPECT_EQ(scene.bench.bits() - sof, unstuffed + stuff_bits + 3);
    scene.play(r_bits(200));
  }
}

// FF-11: the longest of all searched frames stay within 132 and 157 bits, and on the wire they are
// as long as the rule of the stuff bits makes them.
TEST(FrameFormat, WorstStuffingStaysWithinTheBound) {
  for (const Frame &frame : {base_frame(0x078, {0x3C, 0x3C, 0x3C, 0x3C, 0x3C, 0x3C, 0x3C, 0x3C}),
                             base_frame(0x078, {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}),
                             extended_frame(0x01F0C3C3, {0xC3, 0xC3, 0xC3, 0xC3, 0xC3, 0xC3})}) {
    Scene scene;
    scene.send(frame);
    const std::uint64_t sof = scene.bench.bits();
    scene.bench.lt_acknowledges(true);
    ASSERT_TRUE(scene.bench.run_until([&] { return scene.events().sent == 1; }, 200));
    const std::uint64_t length = scene.bench.bits() - sof;
    EXPECT_EQ(length, wire(frame).size());
    EXPECT_LE(length, frame.extended ? 157u : 132u);
  }
}

// FF-05: either level of r0; base frames, data and remote. CR-02: it is in the CRC as sampled.
TEST(FrameFormat, ReceiverTakesEitherLevelOfTheReservedBit) {
  for (const Counters &counters : kStates) {
    for (const Kind kind : {Kind::kBaseData, Kind::kBaseRemote}) {
      const Frame frame = frame_of(kind, 4);
      for (const Level r0 : {Level::kDominant, Level::kRecessive}) {
        Scene scene{counters};
        const std::string bits = wire(frame, {.r0 = r0});
        EXPECT_EQ(scene.play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
        ASSERT_EQ(scene.dut().received().size(), 1u);
        EXPECT_EQ(scene.last_received(), frame);
      }
    }
  }
}

// FF-05: all eight combinations of SRR, r1 and r0 of extended frames.
TEST(FrameFormat, ReceiverTakesAllLevelsOfSrrAndReservedBits) {
  for (const Counters &counters : kStates) {
    for (unsigned code = 0; code < 16; ++code) {
      const EncodeOptions levels{.r0 = static_cast<Level>(code & 1),
                                 .r1 = static_cast<Level>(code >> 1 & 1),
                                 .srr = static_cast<Level>(code >> 2 & 1)};
      const Frame frame =
          frame_of((code & 8) != 0 ? Kind::kExtendedRemote : Kind::kExtendedData, 3);
      Scene scene{counters};
      const std::string bits = wire(frame, levels);
      EXPECT_EQ(scene.play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3)) << code;
      ASSERT_EQ(scene.dut().received().size(), 1u) << code;
      EXPECT_EQ(scene.last_received(), frame) << code;
    }
  }
}

CoreConfig fd_tolerant() {
  CoreConfig config = CoreBench::default_config();
  config.fd_tolerant = true;
  return config;
}

// FF-06: with the option on, a recessive FDF bit (base: after IDE; extended: r1) silences the node
// until eleven recessive bits have passed; counters stand. Then a classical frame is received.
TEST(FrameFormat, FdTolerantNodeStaysOutOfFramesWithRecessiveFdf) {
  for (const Counters &counters : kStates) {
    for (const bool extended : {false, true}) {
      const Frame frame = frame_of(extended ? Kind::kExtendedData : Kind::kBaseData, 8);
      const EncodeOptions fd = extended ? EncodeOptions{.r1 = Level::kRecessive}
                                        : EncodeOptions{.r0 = Level::kRecessive};
      Scene scene{counters, fd_tolerant()};
      // What follows is no CAN 2.0 frame any more: seven dominant bits, and a form without sense.
      const std::size_t fdf = offset_of(frame, extended ? Field::kR1 : Field::kR0, 0);
      const std::string bits = wire(frame, fd).substr(0, fdf + 1) + d_bits(7) + "101001110" + "0";
      EXPECT_EQ(scene.play(bits + r_bits(10)), r_bits(bits.size() + 10));
      EXPECT_EQ(scene.field(), Field::kInteg);
      scene.play("1");
      EXPECT_EQ(scene.field(), Field::kIdle);
      scene.expect_counters(counters.tec, counters.rec);
      EXPECT_EQ(scene.events().errors, 0);
      scene.expect_reception(frame_of(Kind::kBaseData, 2));
    }
  }
}

// FF-06: r0 of an extended frame after a dominant FDF bit does not matter to that option either.
TEST(FrameFormat, FdTolerantNodeIgnoresExtendedR0) {
  Scene scene{kActive, fd_tolerant()};
  const Frame frame = frame_of(Kind::kExtendedData, 8);
  const std::string bits = wire(frame, {.r0 = Level::kRecessive});
  EXPECT_EQ(scene.play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
  ASSERT_EQ(scene.dut().received().size(), 1u);
  EXPECT_EQ(scene.last_received(), frame);
}

std::vector<Frame> legal_identifiers() {
  std::vector<Frame> frames;
  for (unsigned bit = 0; bit < 11; ++bit) {
    frames.push_back(base_frame(1u << bit, {0xA5}));
    frames.push_back(base_frame(0x7FFu ^ (1u << bit)));
  }
  for (unsigned bit = 0; bit < 29; ++bit) {
    frames.push_back(extended_frame(1u << bit, {0x5A}));
    frames.push_back(extended_frame(0x1FFFFFFFu ^ (1u << bit)));
  }
  for (std::uint32_t id = 0x7F0; id <= 0x7FF; ++id) {
    frames.push_back(base_frame(id, {0xFF}));
    frames.push_back(extended_frame((id << 18) | 0x3FFFF));
    frames.push_back(remote_frame(id, false));
  }
  frames.push_back(base_frame(0));
  frames.push_back(extended_frame(0));
  return frames;
}

// FF-10: every identifier bit alone, all but one, and seven leading recessive bits: received.
TEST(FrameFormat, EveryIdentifierIsReceived) {
  Scene scene;
  for (const Frame &frame : legal_identifiers()) scene.expect_reception(frame);
  scene.expect_counters(0, 0);
}

// FF-10: the same, sent.
TEST(FrameFormat, EveryIdentifierIsSent) {
  Scene scene;
  for (const Frame &frame : legal_identifiers()) scene.expect_transmission(frame);
  scene.expect_counters(0, 0);
}

// FF-12, AR-13: whatever the host does after the frame has begun, at any bit of it, the wire
// shows the frame as it was.
TEST(FrameFormat, FrameUnderWayIsNotAlteredByTheHost) {
  for (const Frame &frame : {frame_of(Kind::kBaseData, 8), frame_of(Kind::kExtendedData, 5)}) {
    const std::string bits = wire(frame);
    const Frame other = frame_of(Kind::kExtendedRemote, 3);
    for (std::size_t at = 0; at < bits.size(); ++at) {
      Scene scene;
      scene.send(frame);
      const std::string lt = flipped(r_bits(bits.size()), ack_offset(frame));
      std::string tx = scene.play(lt.substr(0, at));
      scene.cancel();
      scene.request(other);
      tx += scene.play(lt.substr(at));
      ASSERT_EQ(tx, bits) << "at bit " << at;
      scene.run_to(Field::kSof);
      const std::string next = wire(other);
      EXPECT_EQ(scene.play(flipped(r_bits(next.size()), ack_offset(other))), next);
      EXPECT_EQ(scene.dut().sent().size(), 2u);
    }
  }
}

// FF-13: base and extended frames, data and remote, with equal identifier bits are told apart.
TEST(FrameFormat, EqualIdentifierBitsInAllFormatsAreKeptApart) {
  for (const std::uint32_t id : {0x000u, 0x2AAu, 0x7FFu}) {
    Scene scene;
    for (const Frame &frame :
         {base_frame(id), extended_frame(id), extended_frame(id << 18), remote_frame(id, false),
          remote_frame(id, true), remote_frame(id << 18, true), base_frame(id)}) {
      scene.expect_reception(frame);
      scene.expect_transmission(frame);
    }
  }
}

}  // namespace
}  // namespace vericansim

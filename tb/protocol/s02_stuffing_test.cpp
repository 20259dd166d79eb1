// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 2 of the rule book: bit stuffing, sent, received, joined and after lost arbitration.
#include <gtest/gtest.h>

#include <set>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

class Stuffing : public ::testing::TestWithParam<Frame> {};

std::string name_of(const ::testing::TestParamInfo<Frame> &info) {
  const Frame &f = info.param;
  return (f.extended ? "Ext" : "Base") + std::to_string(f.id) + (f.remote ? "Remote" : "Data") +
         std::to_string(f.dlc);
}

INSTANTIATE_TEST_SUITE_P(Typical, Stuffing, ::testing::ValuesIn(typical_frames()), name_of);

// ST-01: never six equal bits from SOF to CRC0; with the stuff bits taken out the frame is whole;
// ST-05: the ten bits of the end are not stuffed.
TEST_P(Stuffing, SenderPutsAComplementAfterFiveEqualBits) {
  const std::string plain = plain_bits(GetParam());
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    scene.send(GetParam());
    const std::size_t head = stuffed(plain).size();
    const std::string tx = scene.play(r_bits(head + 1) + "0" + r_bits(8));
    EXPECT_EQ(destuffed(tx.substr(0, head)), plain);
    EXPECT_EQ(tx.substr(head), frame_end());
    EXPECT_EQ(scene.events().sent, 1u);
  }
}

// ST-05, ST-09: the receiver takes all stuff bits out, and none of the end of frame for one.
TEST_P(Stuffing, ReceiverTakesTheStuffBitsOut) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    const std::string bits = stuffed(plain_bits(GetParam())) + frame_end();
    EXPECT_EQ(scene.play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
    ASSERT_EQ(scene.dut().received().size(), 1u);
    EXPECT_EQ(scene.last_received(), GetParam());
  }
}

// ST-06, ED-08, PF-44: a stuff bit that does not come is a stuff error at that bit: flag in the
// next one, REC + 1. Every stuff bit of both levels, the last one (ST-04) included.
TEST_P(Stuffing, ReceiverFlagsTheBitAfterASixthEqualOne) {
  const std::string bits = wire(GetParam());
  for (const std::size_t at : stuff_offsets(GetParam())) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      const std::string lt = flipped(bits.substr(0, at + 1), at) + r_bits(6);
      EXPECT_EQ(scene.play(lt), r_bits(at + 1) + flag_of(counters)) << at;
      scene.expect_counters(counters.tec, counters.rec + 1u);
      EXPECT_EQ(scene.events().errors, kErrStuff);
      scene.play(r_bits(8 + 3));
      scene.expect_reception(GetParam());
    }
  }
}

// ST-01, AR-04, AR-05, ED-08: the same at the transmitter, which sends the stuff bit: one flag in
// the next bit, whatever the name of the error.
TEST_P(Stuffing, SenderFlagsTheBitAfterABrokenStuffBit) {
  const std::string bits = wire(GetParam());
  for (const std::size_t at : stuff_offsets(GetParam())) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      scene.send(GetParam());
      scene.play(r_bits(at));
      scene.bench.force_next(0, Effect::kFlip);
      EXPECT_EQ(scene.play("1"), bits.substr(at, 1));
      EXPECT_EQ(scene.play(r_bits(6)), flag_of(counters)) << at;
      EXPECT_EQ(scene.events().failed, 1u);
      EXPECT_EQ(scene.events().delivered, 0u);
    }
  }
}

// ST-01: together the typical frames have stuff bits before nearly every bit of a frame: the sweep
// above means something.
TEST(StuffingSweep, StuffBitsStandEverywhere) {
  std::set<std::pair<Field, unsigned>> places;
  for (const Frame &frame : typical_frames()) {
    for (const WireBit &bit : encode_frame(frame).bits) {
      if (bit.is_stuff) places.insert({bit.field, bit.index});
    }
  }
  EXPECT_GE(places.size(), 45u);
}

// ST-02: SOF is the first of the run, the recessive bits before it are none. ID 0x07F: after SOF
// and four dominant bits comes a recessive one. Any length of idle changes nothing.
TEST(StuffingRun, BeginsWithSof) {
  for (const unsigned idle : {0u, 1u, 4u, 5u, 6u, 40u}) {
    Scene sender;
    sender.play(r_bits(idle));
    sender.send(base_frame(0x07F));
    EXPECT_EQ(sender.play(r_bits(13)),
              "0"
              "0000"
              "1"
              "1111"
              "0"
              "11");
    Scene receiver;
    receiver.play(r_bits(idle));
    receiver.expect_reception(base_frame(0x07F));
    receiver.expect_reception(base_frame(0x7F0));  // five recessive bits of EOF and INT before SOF
  }
}

// ST-02: the recessive bits before SOF do not count: four recessive bits after it need no stuff
// bit.
TEST(StuffingRun, IsNotMadeOfIdleBits) {
  Scene scene;
  scene.send(base_frame(0x780));
  EXPECT_EQ(scene.play(r_bits(8)),
            "0"
            "1111"
            "000");
}

// ST-03, GV-3, GV-4: a run that reaches five at CRC0 gets its stuff bit, of either level, between
// CRC0 and the CRC delimiter.
TEST(StuffingRun, EndsWithAStuffBitAfterTheCrc) {
  const std::pair<Frame, std::string> vectors[] = {
      {base_frame(0x009), "000001000100100000100111110000011000001"},
      {base_frame(0x017), "0000010010111000001001010010000111110"}};
  for (const auto &[frame, head] : vectors) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      scene.send(frame);
      EXPECT_EQ(scene.play(r_bits(head.size() + 1) + "0" + r_bits(8)), head + frame_end());
      EXPECT_EQ(scene.events().sent, 1u);
    }
  }
}

// ST-04: the receiver takes that bit out, does not read it as delimiter; inverted, it is a stuff
// error whose flag begins where the CRC delimiter would stand.
TEST(StuffingRun, LastStuffBitIsCheckedByTheReceiver) {
  for (const std::string &head : {std::string{"000001000100100000100111110000011000001"},
                                  std::string{"0000010010111000001001010010000111110"}}) {
    for (const Counters &counters : kStates) {
      Scene good{counters};
      EXPECT_EQ(good.play(head + frame_end()), receiver_tx(head + frame_end()));
      EXPECT_EQ(good.dut().received().size(), 1u);
      Scene bad{counters};
      const std::string broken = flipped(head, head.size() - 1);
      EXPECT_EQ(bad.play(broken + r_bits(6)), r_bits(head.size()) + flag_of(counters));
      EXPECT_EQ(bad.events().errors, kErrStuff);
      bad.play(r_bits(20));
      EXPECT_TRUE(bad.dut().received().empty());
    }
  }
}

// ST-05: nine recessive bits after the delimiter of a recessive CRC are not stuffed, nor are error
// flags, delimiters and intermission: a frame right after them is received.
TEST(StuffingRun, NothingAfterTheCrcIsStuffed) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    scene.play(d_bits(6));  // a frame broken by a stuff error
    EXPECT_EQ(scene.play(r_bits(6 + 8 + 3)), flag_of(counters) + r_bits(11));
    scene.expect_reception(base_frame(0x017));
  }
}

// ST-07, IF-06, TL-07: a frame joined at a foreign SOF counts it: with an identifier that starts
// with 0000 the fifth bit sent is a recessive stuff bit; the CRC counts it too.
TEST(StuffingRun, JoinedStartCountsTheForeignSof) {
  for (const Frame &frame : {base_frame(0x07F), base_frame(0x000, {0x00}),
                             extended_frame(0x01FFFFFF), base_frame(0x075, {0x11, 0x22})}) {
    for (const Counters &counters : kStates) {
      Scene scene{counters};
      scene.play(wire(base_frame(0x555)));
      scene.request(frame);
      const std::string bits = wire(frame);
      EXPECT_EQ(scene.play("110"), "111");
      const std::string lt = flipped(r_bits(bits.size()), ack_offset(frame)).substr(1);
      const std::string tx = scene.play(lt);
      EXPECT_EQ(tx.substr(0, 5), "00001");
      EXPECT_EQ(tx, bits.substr(1));
      EXPECT_EQ(scene.events().sent, 1u);
    }
  }
}

// ST-08: loser and winner, base and extended, differ at every bit of the identifier in turn; runs
// of either level span the bit where arbitration is lost. The winner's frame is delivered.
TEST(StuffingRun, GoesOnAcrossLostArbitration) {
  for (const std::uint32_t pattern : {0x00000000u, 0x1FFFFFFFu, 0x03E0F83Eu, 0x1C1F07C1u}) {
    for (const bool extended : {false, true}) {
      for (unsigned bit = 0; bit < (extended ? 29u : 11u); ++bit) {
        const std::uint32_t id = extended ? pattern : pattern >> 18;
        Frame winner = extended ? extended_frame(id & ~(1u << bit), {0xC1})
                                : base_frame(id & ~(1u << bit), {0xC1});
        Frame loser = winner;
        loser.id |= 1u << bit;
        Scene scene;
        scene.send(loser);
        const std::string bits = wire(winner);
        const std::string tx = scene.play(bits + r_bits(3));
        const std::size_t lost = offset_of(winner, extended && bit < 18 ? Field::kExId : Field::kId,
                                           extended ? (bit < 18 ? 17 - bit : 28 - bit) : 10 - bit);
        EXPECT_EQ(tx,
                  wire(loser).substr(0, lost + 1) + receiver_tx(bits).substr(lost + 1) + r_bits(3));
        ASSERT_EQ(scene.dut().received().size(), 1u);
        EXPECT_EQ(scene.last_received(), winner);
        scene.expect_counters(0, 0);
      }
    }
  }
}

// Frames with a stuff bit right before the bit at a place, searched by the rule of stuff bits.
Frame frame_with_stuff_bit(bool extended, Field field, unsigned index) {
  for (std::uint32_t n = 0; n < 200000; ++n) {
    const std::uint32_t id = n * 2654435761u >> (extended ? 3 : 21);
    const auto byte = static_cast<std::uint8_t>(n % 3 == 0 ? 0x00 : n % 3 == 1 ? 0xFF : n >> 2);
    Frame frame = extended ? extended_frame(id, {byte, byte}) : base_frame(id, {byte, byte});
    if ((n & 1) != 0 && field != Field::kData) {
      frame = remote_frame(id, extended, static_cast<std::uint8_t>(n >> 1 & 15));
    }
    if (offset_of(frame, field, index, true) != std::string::npos) return frame;
  }
  ADD_FAILURE() << "no frame with a stuff bit before " << field_name(field) << index;
  return {};
}

// ST-09: a stuff bit at every boundary of fields and bytes, in both roles: ID/RTR, ID18/SRR,
// ID16/ID15, RTR/r1, r0/DLC, DLC/data, between bytes, data/CRC, CRC/delimiter.
TEST(StuffingRun, StuffBitsAtFieldBoundariesShiftNothing) {
  struct Boundary {
    bool extended;
    Field field;
    unsigned index;
  };
  for (const Boundary &at : {Boundary{false, Field::kRtr, 0}, Boundary{true, Field::kRtr, 0},
                             Boundary{false, Field::kIde, 0}, Boundary{true, Field::kIde, 0},
                             Boundary{true, Field::kExId, 0}, Boundary{true, Field::kExId, 2},
                             Boundary{true, Field::kExId, 10}, Boundary{true, Field::kExRtr, 0},
                             Boundary{true, Field::kR1, 0}, Boundary{false, Field::kR0, 0},
                             Boundary{true, Field::kR0, 0}, Boundary{false, Field::kDlc, 0},
                             Boundary{true, Field::kDlc, 0}, Boundary{false, Field::kData, 8},
                             Boundary{true, Field::kData, 8}, Boundary{false, Field::kCrc, 0},
                             Boundary{true, Field::kCrc, 0}, Boundary{false, Field::kCrcDel, 0},
                             Boundary{true, Field::kCrcDel, 0}}) {
    const Frame frame = frame_with_stuff_bit(at.extended, at.field, at.index);
    Scene scene;
    scene.expect_reception(frame);
    scene.expect_transmission(frame);
  }
}

// ST-09: between DLC and data only a recessive r0 makes one possible, with DLC 15.
TEST(StuffingRun, StuffBitBetweenDlcAndDataIsTakenOut) {
  for (const bool extended : {false, true}) {
    Frame frame = base_frame(0x155, {0x92, 0x42, 0x24, 0x18, 0xFF, 0x00, 0xAA, 0x55});
    frame.extended = extended;
    frame.dlc = 15;
    Scene scene;
    const std::string bits = wire(frame, {.r0 = Level::kRecessive});
    EXPECT_NE(bits.find("111110" + binary(0x92, 8)), std::string::npos);
    EXPECT_EQ(scene.play(bits), receiver_tx(bits));
    ASSERT_EQ(scene.dut().received().size(), 1u);
    EXPECT_EQ(scene.last_received(), frame);
  }
}

}  // namespace
}  // namespace vericansim

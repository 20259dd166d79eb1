// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 6 of the rule book: arbitration, lost at every bit and in every format.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

// A place in the arbitration field (AR-01): 0 = ID28 .. 10 = ID18, 11 = RTR or SRR; extended also
// 12 = IDE, 13 = ID17 .. 30 = ID0, 31 = RTR.
struct Place {
  Field field;
  unsigned index;
};

Place place_of(unsigned position) {
  if (position < 11) return {Field::kId, position};
  if (position == 11) return {Field::kRtr, 0};
  if (position == 12) return {Field::kIde, 0};
  if (position < 31) return {Field::kExId, position - 13};
  return {Field::kExRtr, 0};
}

// Loser and winner whose first difference is the bit at `position`, where the loser is recessive.
std::pair<Frame, Frame> rivals(bool extended, unsigned position, std::uint32_t pattern) {
  const std::uint32_t base = pattern >> 18;
  if (!extended) {
    if (position == 11) return {remote_frame(base, false, 2), base_frame(base, {0x5A, 0x3C})};
    const std::uint32_t bit = 0x400u >> position;
    return {base_frame(base | bit), base_frame(base & ~bit, {0x5A, 0x3C})};
  }
  if (position == 11) return {extended_frame(pattern), base_frame(base, {0x5A})};
  if (position == 12) return {extended_frame(pattern), remote_frame(base, false, 3)};
  if (position == 31) return {remote_frame(pattern, true, 4), extended_frame(pattern, {0x5A})};
  const std::uint32_t bit = position < 11 ? 1u << (28 - position) : 1u << (30 - position);
  return {extended_frame(pattern | bit), extended_frame(pattern & ~bit, {0x5A, 0x3C})};
}

struct LossCase {
  bool extended;
  unsigned position;
};

std::vector<LossCase> all_losses() {
  std::vector<LossCase> cases;
  for (unsigned position = 0; position < 12; ++position) cases.push_back({false, position});
  for (unsigned position = 0; position < 32; ++position) cases.push_back({true, position});
  return cases;
}

std::string name_of(const ::testing::TestParamInfo<LossCase> &loss) {
  return std::string{loss.param.extended ? "Extended" : "Base"} + "Bit" +
         std::to_string(loss.param.position);
}

constexpr std::uint32_t kPatterns[] = {0x00000000, 0x1FFFFFFF, 0x15555555, 0x03E0F83E, 0x1C1F07C1};

class Loss : public ::testing::TestWithParam<LossCase> {
 protected:
  // Offset of the bit where `loser` loses, in the frames of both.
  [[nodiscard]] static std::size_t lost_at(const Frame &loser) {
    const Place place = place_of(GetParam().position);
    return offset_of(loser, place.field, place.index);
  }
};

INSTANTIATE_TEST_SUITE_P(At, Loss, ::testing::ValuesIn(all_losses()), name_of);

// AR-01, AR-02, AR-07: lost at each of the 12 and 32 bits: no error, counters stand, recessive from
// the next bit on; the winner's frame, of whatever format, is acknowledged and delivered bit-exact.
// AR-06: RTR, SRR and IDE decide between equal identifiers. AR-08, AR-09: then the own frame again.
TEST_P(Loss, LeavesAReceiverOfTheWinner) {
  for (const std::uint32_t pattern : kPatterns) {
    for (const Counters &counters : kStates) {
      const auto [loser, winner] = rivals(GetParam().extended, GetParam().position, pattern);
      const std::size_t lost = lost_at(loser);
      const std::string bits = wire(winner);
      Scene scene{counters};
      scene.send(loser);
      EXPECT_EQ(scene.play(bits),
                wire(loser).substr(0, lost + 1) + receiver_tx(bits).substr(lost + 1));
      EXPECT_EQ(scene.events().errors, 0);
      EXPECT_EQ(scene.events().failed, 1u);
      EXPECT_EQ(scene.tec(), counters.tec);
      ASSERT_EQ(scene.dut().received().size(), 1u);
      EXPECT_EQ(scene.last_received(), winner);
      const std::string again = "111" + wire(loser);
      EXPECT_EQ(scene.play(flipped(r_bits(again.size()), 3 + ack_offset(loser))), again);
      EXPECT_EQ(scene.dut().sent().size(), 1u);
    }
  }
}

// AR-02, MX-02: the same bit, but the one who drove it falls silent: the sixth recessive bit is a
// stuff error of a receiver: REC + 1, TEC stands, and the frame is sent again without suspend.
TEST_P(Loss, IsReceptionEvenIfNobodyGoesOn) {
  for (const Counters &counters : kStates) {
    const auto [loser, winner] = rivals(GetParam().extended, GetParam().position, 0x15555555);
    const std::size_t lost = lost_at(loser);
    Scene scene{counters};
    scene.send(loser);
    scene.play(wire(winner).substr(0, lost + 1));
    EXPECT_EQ(scene.play(r_bits(6)), r_bits(6));
    EXPECT_EQ(scene.play(r_bits(6)), flag_of(counters));
    scene.expect_counters(counters.tec, counters.rec + 1u);
    EXPECT_EQ(scene.play(r_bits(8 + 3 + 1)), r_bits(11) + "0");
  }
}

// AR-01, AR-03: a dominant bit of the field seen recessive is a bit error wherever it stands, SOF
// and base IDE included: flag in the next bit, TEC + 8 (FC-05), never a loss.
TEST(Arbitration, DominantBitSeenRecessiveIsABitError) {
  for (const Frame &frame :
       {base_frame(0x2A5), remote_frame(0x000, false), extended_frame(0x0AAAA555),
        extended_frame(0x10000000), extended_frame(0x00000000, {1})}) {
    const EncodedFrame encoded = encode_frame(frame);
    for (std::size_t at = 0; encoded.bits[at].field < Field::kDlc; ++at) {
      if (encoded.bits[at].level == Level::kRecessive) continue;
      for (const Counters &counters : kStates) {
        Scene scene{counters};
        scene.send(frame);
        scene.play(r_bits(at));
        scene.bench.force_next(0, Effect::kRecessive);
        EXPECT_EQ(scene.play(r_bits(1 + 6)), "0" + flag_of(counters)) << at;
        scene.expect_counters(counters.tec + 8u, counters.rec);
        EXPECT_EQ(scene.events().errors, kErrBit0);
        EXPECT_EQ(scene.play(r_bits(8 + 3)), r_bits(11));
        EXPECT_EQ(scene.play(r_bits(9)),
                  counters.passive() ? r_bits(8) + "0" : wire(frame).substr(0, 9));
      }
    }
  }
}

// AR-01: recessive bits behind the field are not arbitration: control, data, CRC: bit error.
TEST(Arbitration, RecessiveBitBehindTheFieldSeenDominantIsABitError) {
  for (const Frame &frame : {base_frame(0x2A5, {0xAA}), extended_frame(0x0AAAA555, {0x55, 0xFF})}) {
    const EncodedFrame encoded = encode_frame(frame);
    for (std::size_t at = 0; at < encoded.stuffed_length; ++at) {
      const WireBit &bit = encoded.bits[at];
      if (bit.field < Field::kR1 || bit.level == Level::kDominant) continue;
      Scene scene;
      scene.send(frame);
      scene.play(r_bits(at));
      EXPECT_EQ(scene.play("0" + r_bits(6)), "1" + d_bits(6)) << at;
      scene.expect_counters(8, 0);
      EXPECT_EQ(scene.events().errors, kErrBit1);
    }
  }
}

// AR-04, PF-51: an own recessive stuff bit seen dominant is a stuff error, not a loss: flag in the
// next bit, the node stays transmitter (retry, with suspend if passive), TEC as FC-05 exception 2.
TEST(Arbitration, RecessiveStuffBitSeenDominantIsAStuffError) {
  for (const Frame &frame : {base_frame(0x078), base_frame(0x003), extended_frame(0x01F07FFF),
                             extended_frame(0x15540001), remote_frame(0x00000000, true)}) {
    unsigned tried = 0;
    for (const std::size_t at : stuff_offsets(frame)) {
      const WireBit bit = encode_frame(frame).bits[at];
      if (bit.field > Field::kExRtr || bit.level == Level::kDominant) continue;
      if (!frame.extended && bit.field == Field::kIde) continue;  // after RTR: FC-05b
      ++tried;
      for (const Counters &counters : kStates) {
        Scene scene{counters};
        scene.send(frame);
        scene.play(r_bits(at));
        EXPECT_EQ(scene.play("0" + r_bits(6)), "1" + flag_of(counters)) << at;
        scene.expect_counters(counters.tec, counters.rec);
        EXPECT_EQ(scene.events().errors, kErrStuff);
        const unsigned wait = counters.passive() ? 8 + 3 + 8 : 8 + 3;
        EXPECT_EQ(scene.play(r_bits(wait + 1)), r_bits(wait) + "0");
        EXPECT_EQ(scene.events().delivered, 0u);
      }
    }
    EXPECT_NE(tried, 0u) << "no such bit in a frame of id " << frame.id;
  }
}

// AR-05: an own dominant stuff bit seen recessive in arbitration is a bit error: TEC + 8.
TEST(Arbitration, DominantStuffBitSeenRecessiveIsABitError) {
  for (const Frame &frame : {base_frame(0x7C0), base_frame(0x3F0), extended_frame(0x1FFFFFFF)}) {
    unsigned tried = 0;
    for (const std::size_t at : stuff_offsets(frame)) {
      const WireBit bit = encode_frame(frame).bits[at];
      if (bit.field > Field::kExRtr || bit.level == Level::kRecessive) continue;
      ++tried;
      for (const Counters &counters : kStates) {
        Scene scene{counters};
        scene.send(frame);
        scene.play(r_bits(at));
        scene.bench.force_next(0, Effect::kRecessive);
        EXPECT_EQ(scene.play(r_bits(1 + 6)), "0" + flag_of(counters)) << at;
        scene.expect_counters(counters.tec + 8u, counters.rec);
      }
    }
    EXPECT_NE(tried, 0u) << "no such bit in a frame of id " << frame.id;
  }
}

// AR-06: pairs of formats with equal identifier bits, on two engines: who wins, who loses, both
// frames arrive.
TEST(Arbitration, FormatsWithEqualIdentifiersAreRanked) {
  for (const std::uint32_t id : {0x000u, 0x2C5u, 0x7FFu}) {
    const Frame base = base_frame(id, {0x11});
    const Frame base_remote = remote_frame(id, false, 1);
    const Frame extended = extended_frame(id << 18, {0x22});
    const Frame extended_remote = remote_frame(id << 18, true, 1);
    const std::pair<Frame, Frame> ranks[] = {
        {base, extended},        {base, extended_remote},
        {base_remote, extended}, {base_remote, extended_remote},
        {base, base_remote},     {extended, extended_remote}};
    for (const auto &[winner, loser] : ranks) {
      CoreBench bench{2};
      Lockstep judge{bench};
      judge.start();
      judge.request(0, loser);
      judge.request(1, winner);
      ASSERT_TRUE(bench.run_until([&] { return !bench.dut(0).sent().empty(); }, 400));
      EXPECT_EQ(bench.dut(0).received(), std::vector<Frame>{winner});
      EXPECT_EQ(bench.dut(1).received(), std::vector<Frame>{loser});
      EXPECT_EQ(bench.dut(0).events().failed, 1u);
      EXPECT_EQ(bench.dut(1).events().failed, 0u);
      EXPECT_TRUE(judge.agrees()) << judge.report();
    }
  }
}

// AR-07: lost at SRR, the next bit, IDE, tells the winner's format: dominant is a base data frame,
// recessive an extended one with a dominant SRR (FF-05).
TEST(Arbitration, LossAtSrrLeavesTheFormatOpen) {
  const Frame loser = extended_frame(0x0B1C5A93);
  for (const Frame &winner :
       {base_frame(0x0B1C5A93 >> 18, {0x77}), extended_frame(0x0B1C5A93 ^ 0x155, {0x77})}) {
    Scene scene;
    scene.send(loser);
    const std::string bits = wire(winner, {.srr = Level::kDominant});
    scene.play(bits);
    ASSERT_EQ(scene.dut().received().size(), 1u);
    EXPECT_EQ(scene.last_received(), winner);
    EXPECT_EQ(scene.events().errors, 0);
  }
}

// AR-08: the loser's duties are those of a receiver: REC - 1 at the acknowledge, overload frame
// after a dominant EOF7 with the frame delivered (ED-11), no suspend.
TEST(Arbitration, LoserTreatsTheEndOfFrameAsAReceiver) {
  const Frame winner = base_frame(0x2C5, {0x12});
  for (const std::uint8_t tec : {0, 136}) {
    Scene scene{{tec, 5}};
    scene.send(base_frame(0x2C7));
    const std::string bits = wire(winner);
    scene.play(flipped(bits, bits.size() - 1));
    EXPECT_EQ(scene.play(r_bits(6 + 8)), d_bits(6) + r_bits(8));
    EXPECT_EQ(scene.dut().received().size(), 1u);
    scene.expect_counters(tec, 4);
    EXPECT_EQ(scene.play("1111"), "1110");
  }
}

// AR-09: after each lost arbitration the frame contends again at the first start point, without a
// change of TEC, as often as it takes.
TEST(Arbitration, LoserContendsAgainUntilItWins) {
  Scene scene{{3, 0}};
  const Frame winner = base_frame(0x2C5, {0x12});
  scene.send(base_frame(0x2C7));
  const std::size_t lost = offset_of(winner, Field::kId, 9);
  for (unsigned i = 0; i < 20; ++i) {
    const std::string bits = wire(winner);
    EXPECT_EQ(scene.play(bits).substr(0, lost + 1), wire(base_frame(0x2C7)).substr(0, lost + 1));
    EXPECT_EQ(scene.play("111"), "111");
  }
  EXPECT_EQ(scene.events().failed, 20u);
  EXPECT_EQ(scene.tec(), 3u);
  const std::string own = wire(base_frame(0x2C7));
  EXPECT_EQ(scene.play(flipped(r_bits(own.size()), ack_offset(base_frame(0x2C7)))), own);
}

// AR-10: same identifier and format, different later bits: who sends recessive at the first
// difference sees a bit error there: DLC, data.
TEST(Arbitration, EqualIdentifiersClashLaterAsABitError) {
  const std::pair<Frame, Frame> clashes[] = {
      {base_frame(0x2C5, {0x01}), base_frame(0x2C5, {0x01, 0x00})},
      {base_frame(0x2C5, {0x01}), base_frame(0x2C5, {0x81})},
      {extended_frame(0x0B1C5A93, {0x55, 0x00}), extended_frame(0x0B1C5A93, {0x55, 0x01})}};
  for (const auto &[low, high] : clashes) {
    CoreBench bench{2};
    Lockstep judge{bench};
    judge.start();
    judge.request(0, low);
    judge.request(1, high);
    ASSERT_TRUE(bench.run_until([&] { return bench.dut(1).events().failed != 0; }, 200));
    const std::string a = wire(low);
    const std::string b = wire(high);
    std::size_t clash = 0;
    while (a[clash] == b[clash]) ++clash;
    const unsigned loser = a[clash] == '1' ? 0 : 1;
    bench.run_bits(1);
    EXPECT_NE(bench.dut(loser).events().errors & kErrBit1, 0);
    EXPECT_EQ(bench.dut(1).events().failed, 1u);
    EXPECT_TRUE(judge.agrees()) << judge.report();
  }
}

// AR-10: fully identical frames: both succeed if a third node acknowledges, both see an
// acknowledge error if not.
TEST(Arbitration, IdenticalFramesAreSentTogether) {
  for (const bool acknowledged : {true, false}) {
    CoreBench bench{2};
    Lockstep judge{bench};
    judge.start();
    bench.lt_acknowledges(acknowledged);
    judge.request(0, base_frame(0x2C5, {1, 2}));
    judge.request(1, base_frame(0x2C5, {1, 2}));
    const std::size_t length = wire(base_frame(0x2C5, {1, 2})).size();
    bench.run_bits(static_cast<unsigned>(length) + 1);
    for (const unsigned i : {0u, 1u}) {
      EXPECT_EQ(bench.dut(i).events().sent, acknowledged ? 1u : 0u);
      EXPECT_EQ(bench.dut(i).events().errors, acknowledged ? 0 : kErrAck);
    }
    EXPECT_TRUE(judge.agrees()) << judge.report();
  }
}

// AR-11, IF-06, AR-07: a joined start arbitrates from ID28 on: lost at each bit of the field.
TEST_P(Loss, OfAJoinedStartLeavesAReceiverToo) {
  for (const std::uint32_t pattern : kPatterns) {
    for (const Counters &counters : kStates) {
      const auto [loser, winner] = rivals(GetParam().extended, GetParam().position, pattern);
      const std::size_t lost = lost_at(loser);
      Scene scene{counters};
      scene.play(wire(base_frame(0x555)));
      scene.request(loser);
      const std::string bits = wire(winner);
      EXPECT_EQ(scene.play("11" + bits),
                "111" + wire(loser).substr(1, lost) + receiver_tx(bits).substr(lost + 1));
      EXPECT_EQ(scene.last_received(), winner);
      EXPECT_EQ(scene.events().errors, 0);
      EXPECT_EQ(scene.tec(), counters.tec);
      EXPECT_EQ(scene.play("111" + wire(loser).substr(0, 9)), "111" + wire(loser).substr(0, 9));
    }
  }
}

// AR-13, PF-02: a request at any clock around INT2, INT3 and SOF of a foreign frame: what the
// engine sends is whole, now or later, and the foreign frame arrives whole too.
TEST(Arbitration, RequestAtAnyClockIsTakenWholeOrLater) {
  const Frame foreign = base_frame(0x2C5, {0x69});
  const Frame own = extended_frame(0x0B1C5A93, {0xA1, 0xB2, 0xC3, 0xD4, 0xE5});
  for (unsigned phase = 0; phase < 50; ++phase) {
    CoreBench bench{2};
    bench.start();
    bench.dut(0).request(foreign);
    bench.dut(0).request(foreign);
    bench.run_until([&] { return bench.place(1).field() == Field::kInt; }, 200);
    for (unsigned i = 0; i < phase; ++i) bench.clock(Level::kRecessive);
    bench.dut(1).request(own);
    ASSERT_TRUE(bench.run_until([&] { return bench.dut(1).events().sent == 1; }, 400));
    bench.run_bits(100);
    EXPECT_EQ(bench.dut(0).received(), std::vector<Frame>{own}) << phase;
    EXPECT_EQ(bench.dut(1).received(), (std::vector<Frame>{foreign, foreign})) << phase;
    EXPECT_EQ(bench.dut(0).events().errors | bench.dut(1).events().errors, 0) << phase;
  }
}

}  // namespace
}  // namespace vericansim

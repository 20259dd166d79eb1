// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 4 of the rule book: acknowledge and end of frame.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

class Acknowledge : public ::testing::TestWithParam<Counters> {
 protected:
  [[nodiscard]] static const Counters &counters() { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(States, Acknowledge, ::testing::ValuesIn(kStates),
                         [](const auto &state) { return state_name(state.param); });

// AK-01: a receiver sends exactly one dominant bit, in the ACK slot, in every error state; PF-52.
// AK-05: and nothing dominant after it.
TEST_P(Acknowledge, IsOneDominantBitInTheSlot) {
  for (const Frame &frame : typical_frames()) {
    Scene scene{counters()};
    const std::string bits = wire(frame);
    const std::string tx = scene.play(bits + r_bits(3));
    EXPECT_EQ(std::count(tx.begin(), tx.end(), '0'), 1);
    EXPECT_EQ(tx.find('0'), ack_offset(frame));
    EXPECT_EQ(scene.dut().received().size(), 1u);
  }
}

// AK-01: not after an error that came before it: under a passive flag the others go on and the slot
// stays recessive; an active flag ends the frame.
TEST_P(Acknowledge, IsNotSentAfterAnError) {
  const Frame frame = base_frame(0x123, {0xFF, 0xFF});
  const std::string bits = wire(frame);
  Scene scene{counters()};
  const std::size_t at = stuff_offsets(frame).front();
  EXPECT_EQ(scene.play(flipped(bits, at).substr(0, at + 1)), r_bits(at + 1));
  EXPECT_EQ(scene.play(bits.substr(at + 1, 6)), flag_of(counters()));
  const std::size_t rest = bits.size() - at - 7;
  const std::string lt = counters().passive() ? bits.substr(at + 7) : r_bits(rest);
  EXPECT_EQ(scene.play(lt), r_bits(rest));
  EXPECT_TRUE(scene.dut().received().empty());
}

// AK-02: with a wrong CRC the slot stays recessive, and a foreign acknowledge in it is no error:
// no flag until EOF1.
TEST_P(Acknowledge, ForeignOneIsNoErrorForWhoFoundAWrongCrc) {
  for (const Frame &frame : typical_frames()) {
    Scene scene{counters()};
    std::string bits = wire_with_bad_crc(frame, 0x0100);
    bits[bits.size() - 9] = '0';
    EXPECT_EQ(scene.play(bits), r_bits(bits.size() - 7) + flag_of(counters()) + "1");
    EXPECT_EQ(scene.events().errors, kErrCrc);
    scene.expect_counters(counters().tec, counters().rec + 1u);
  }
}

// AK-03, ED-16: the transmitter sends the slot recessive; if it stays so, that is an acknowledge
// error: flag from the ACK delimiter on. FC-05: TEC + 8, but not if passive (exception 1).
TEST_P(Acknowledge, MissingOneIsFlaggedFromTheAckDelimiterOn) {
  for (const Frame &frame : typical_frames()) {
    Scene scene{counters()};
    scene.send(frame);
    const std::string bits = wire(frame);
    const std::size_t slot = ack_offset(frame);
    EXPECT_EQ(scene.play(r_bits(slot + 1)), bits.substr(0, slot) + "1");
    EXPECT_EQ(scene.play(r_bits(6)), flag_of(counters()));
    scene.play("11");
    EXPECT_EQ(scene.events().errors, kErrAck);
    EXPECT_EQ(scene.events().failed, 1u);
    scene.expect_counters(counters().passive() ? counters().tec : 8, counters().rec);
  }
}

// AK-03, ED-03, PF-35: a dominant slot is no bit error; AK-05: the rest of the frame is recessive.
TEST_P(Acknowledge, LetsTheTransmitterSucceed) {
  for (const Frame &frame : typical_frames()) {
    Scene scene{counters()};
    scene.expect_transmission(frame);
    EXPECT_EQ(scene.events().errors, 0);
    scene.expect_counters(counters().tec == 0 ? 0 : counters().tec - 1u, counters().rec);
  }
}

// AK-06: the own acknowledge is driven although others acknowledge already.
TEST_P(Acknowledge, IsSentAlsoOnTopOfAForeignOne) {
  for (const Frame &frame : typical_frames()) {
    Scene scene{counters()};
    EXPECT_EQ(scene.play(acked_wire(frame) + r_bits(3)), receiver_tx(wire(frame)) + r_bits(3));
    EXPECT_EQ(scene.dut().received().size(), 1u);
  }
}

// AK-04, AR-08: a node that lost arbitration acknowledges the winner, in every error state.
TEST_P(Acknowledge, IsSentByTheLoserOfArbitration) {
  for (const Frame &winner : {base_frame(0x2C5, {1, 2}), extended_frame(0x0B1C5A93, {3})}) {
    Scene scene{counters()};
    scene.send(winner.extended ? extended_frame(0x0B1C5A97, {3}) : base_frame(0x2C7, {1, 2}));
    const std::string bits = wire(winner);
    const std::string tx = scene.play(bits);
    EXPECT_EQ(tx.substr(ack_offset(winner) - 1), "10" + r_bits(8));
    ASSERT_EQ(scene.dut().received().size(), 1u);
    EXPECT_EQ(scene.last_received(), winner);
  }
}

// AK-04: two engines: the loser is the only receiver, the winner needs its acknowledge.
TEST(AcknowledgeOfTwo, LoserAsTheOnlyReceiverMakesTheWinnerSucceed) {
  CoreBench bench{2};
  Lockstep judge{bench};
  judge.start();
  judge.request(0, base_frame(0x2C5, {1, 2}));
  judge.request(1, base_frame(0x2C7, {3}));
  ASSERT_TRUE(bench.run_until([&] { return !bench.dut(1).sent().empty(); }, 300));
  EXPECT_EQ(bench.dut(1).received(), (std::vector<Frame>{base_frame(0x2C5, {1, 2})}));
  EXPECT_EQ(bench.dut(0).received(), (std::vector<Frame>{base_frame(0x2C7, {3})}));
  EXPECT_EQ(bench.dut(0).events().errors | bench.dut(1).events().errors, 0);
  EXPECT_TRUE(judge.agrees()) << judge.report();
}

// AK-01, PF-52: the acknowledge depends on nothing that follows: a frame whose end is broken was
// acknowledged like any other. And on no store: a hundred frames in a row, none fetched.
TEST(AcknowledgeOfTwo, DependsOnNothingButTheCrc) {
  const Frame frame = base_frame(0x2C5, {1, 2});
  const std::string bits = wire(frame);
  for (std::size_t at = ack_offset(frame) + 1; at < bits.size(); ++at) {
    Scene scene;
    const std::string tx = scene.play(flipped(bits, at).substr(0, at + 1));
    EXPECT_EQ(tx, receiver_tx(bits).substr(0, at + 1));
  }
  Scene scene;
  for (unsigned i = 0; i < 100; ++i) {
    EXPECT_EQ(scene.play(bits + r_bits(3)), receiver_tx(bits) + r_bits(3));
  }
  EXPECT_EQ(scene.dut().received().size(), 100u);
}

}  // namespace
}  // namespace vericansim

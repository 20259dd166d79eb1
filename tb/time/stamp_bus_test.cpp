// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What decides the stamp of a frame on a real bus: TM-22, TM-23, TM-26, TM-28.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "bus/faults.hpp"
#include "model/frame_codec.hpp"
#include "time/stamp_rule.hpp"
#include "time/time_rig.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

Frame random_frame(std::mt19937 &random) {
  Frame frame;
  frame.extended = random() % 2 != 0;
  frame.id = random() & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
  frame.remote = random() % 4 == 0;
  frame.dlc = static_cast<std::uint8_t>(random() % 16);
  for (auto &byte : frame.data)
    byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xFF : random() % 3 == 0 ? 0 : random());
  return frame;
}

// TM-22: in every format, with every DLC, and with recessive r0 and r1, within eleven bits.
TEST(CanStamp, ReferenceBitExists) {
  std::mt19937 random{22};
  std::size_t last = 0;
  for (unsigned i = 0; i < 200000; ++i) {
    EncodeOptions options;
    options.r0 = static_cast<Level>(random() % 2);
    options.r1 = static_cast<Level>(random() % 2);
    const std::vector<WireBit> bits = encode_frame(random_frame(random), options).bits;
    last = std::max(last, reference_bit(bits) - first_behind_arbitration(bits) + 1);
  }
  EXPECT_LE(last, 11u);
  EXPECT_GE(last, 8u);  // the frames reach far
}

/// Brings nodes up that stamp at the reference edge; all but node 0 receive `like` in buffer 5.
void bring_up(TimeRig &time, const Frame &like) {
  MailboxRig &rig = time.rig;
  rig.run(400);
  for (unsigned n = 0; n < rig.node_count(); ++n) rig.configure(n);
  for (unsigned n = 0; n < rig.node_count(); ++n) rig.go(n);
  for (unsigned n = 1; n < rig.node_count(); ++n) rig.put_rx(n, 5, like, {});
  rig.run(200);
}

Frame frame_of(std::uint32_t id, unsigned dlc) {
  Frame frame;
  frame.id = id;
  frame.dlc = static_cast<std::uint8_t>(dlc);
  return frame;
}

// TM-23: a node that has lost arbitration, at whichever bit, stamps the winner's edge; and the
// dominant ACK of several receivers is none.
TEST(CanStamp, LosersAndReceiversDoNotMoveIt) {
  const Frame winner = frame_of(0x2AA & ~0x155u, 3);
  TimeRig time{4};
  MailboxRig &rig = time.rig;
  bring_up(time, winner);
  unsigned lost = 0;
  for (unsigned bit = 0; bit < 11; ++bit) {
    if ((winner.id >> bit & 1) != 0) continue;
    ++lost;
    const std::size_t falls = time.node(0).falls().size();
    // Both wait for the end of a frame, and start at once.
    rig.put_tx(3, 9, frame_of(0x7F0, 0));
    rig.run(100);
    rig.put_tx(1, 8, frame_of(winner.id | 1u << bit, 8));
    rig.put_tx(0, 8, winner);
    ASSERT_TRUE(rig.wait_flag(0, 8));
    rig.run(20);
    const std::vector<WireBit> bits = encode_frame(winner).bits;
    // Its first fall is the ACK of node 3's frame.
    const std::uint64_t sof = time.node(0).falls().at(falls + 1);
    const std::uint64_t sent = (sof + 8 * reference_bit(bits)) * kTimeStep;
    EXPECT_EQ(time.stamp(0, 8), sent) << bit;
    for (unsigned n = 1; n < 4; ++n) EXPECT_EQ(time.stamp(n, 5), sent + 2 * kTimeStep) << bit;
    ASSERT_TRUE(rig.wait_flag(1, 8));
    for (unsigned n = 0; n < 4; ++n) {
      rig.clear_flag(n, 8);
      rig.clear_flag(n, 5);
      rig.clear_flag(n, 9);
      if (n != 0) rig.get(n, 5);
      rig.read(n, reg::kTimer);
    }
  }
  EXPECT_EQ(lost, 6u);
}

// TM-26: from the edge at the pin to TIME in the stamp: one to two clocks, on average RXLAT.
TEST(CanStamp, FixedLatency) {
  constexpr Time kPeriod = 125 * kNanosecond;
  constexpr unsigned kReceivers = 6;
  std::mt19937 random{26};
  double sum = 0;
  unsigned count = 0;
  for (unsigned run = 0; run < 12; ++run) {
    std::vector<Time> phase{0};
    for (unsigned n = 1; n <= kReceivers; ++n)
      phase.push_back(static_cast<Time>((run * kReceivers + n) * kPeriod / (12 * kReceivers)) -
                      static_cast<Time>(random() % 100));
    TimeRig time{phase};
    const Frame frame = frame_of(0x123, 8);
    bring_up(time, frame);
    const std::size_t falls = time.node(0).falls().size();
    time.rig.put_tx(0, 8, frame);
    ASSERT_TRUE(time.rig.wait_flag(0, 8));
    time.rig.run(20);
    const std::uint64_t bit = reference_bit(encode_frame(frame).bits);
    const Time edge = time.at(0, time.node(0).falls().at(falls) + 8 * bit);
    EXPECT_EQ(time.at(0, time.stamp(0, 8) / kTimeStep), edge);  // TXLAT: none
    for (unsigned n = 1; n <= kReceivers; ++n) {
      const std::uint64_t stamp = time.stamp(n, 5);
      ASSERT_EQ(stamp % kTimeStep, 0u);
      const Time late = time.at(n, stamp / kTimeStep) - edge;
      EXPECT_GE(late, kPeriod) << phase[n];
      EXPECT_LE(late, 2 * kPeriod) << phase[n];
      sum += static_cast<double>(late);
      ++count;
    }
  }
  EXPECT_EQ(count, 12 * kReceivers);
  EXPECT_NEAR(sum / count, 1.5 * static_cast<double>(kPeriod), 0.02 * static_cast<double>(kPeriod));
}

// TM-21: of several edges before the sample point of the reference bit the last one counts: here a
// spike splits the bit that the receiver has begun to see.
TEST(CanStamp, LastEdgeBeforeTheSamplePoint) {
  const Frame frame = frame_of(0x123, 8);
  const std::vector<WireBit> bits = encode_frame(frame).bits;
  const std::size_t reference = reference_bit(bits);
  ASSERT_EQ(bits[reference].field, Field::kDlc);  // the second of its bits, behind no stuff bit
  ASSERT_EQ(bits[reference - 2].field, Field::kR0);
  TimeRig time{2};
  bring_up(time, frame);
  FaultLog log;
  PlaceFault spike{
      1, {.field = Field::kDlc, .index = 1, .first_clock = 0, .last_clock = 0}, Effect::kRecessive};
  spike.log_to(log);
  time.rig.bus().add(spike);
  const std::size_t falls = time.node(0).falls().size();
  time.rig.put_tx(0, 8, frame);
  ASSERT_TRUE(time.rig.wait_flag(0, 8));
  time.rig.run(20);
  ASSERT_EQ(log.stretches().size(), 1u);
  const Time seen = log.stretches()[0].from;
  const Time edge = time.at(0, time.node(0).falls().at(falls) + 8 * reference);
  EXPECT_EQ(time.at(0, time.stamp(0, 8) / kTimeStep), edge);
  ASSERT_GT(seen, edge);
  // The level falls behind the clock edge that saw the spike, as it would at a transmitter.
  EXPECT_EQ(time.at(1, time.stamp(1, 5) / kTimeStep),
            seen + 2 * static_cast<Time>(kTimeStep) * kNanosecond);
}

// TM-28: a frame that failed is stamped anew when it is sent again.
TEST(CanStamp, RetryTakesTheLastAttempt) {
  TimeRig time{3};
  const Frame frame = frame_of(0x321, 4);
  PlaceFault fault{1, {.frame = 1, .field = Field::kCrc, .index = 3}, Effect::kFlip, kAllNodes};
  bring_up(time, frame);
  time.rig.bus().add(fault);
  const std::size_t valids = time.node(0).valids().size();
  time.rig.put_tx(0, 8, frame);
  ASSERT_TRUE(time.rig.wait_flag(0, 8));
  time.rig.run(20);
  ASSERT_GE(fault.hits(), 1u);
  ASSERT_EQ(time.node(0).valids().size(), valids + 1);
  // The last SOF: the first fall behind the eleven recessive bits of delimiter and intermission.
  const auto &falls = time.node(0).falls();
  std::uint64_t sof = 0;
  for (std::size_t i = 1; i < falls.size(); ++i)
    if (falls[i] < time.node(0).valids().back() && falls[i] - falls[i - 1] > 10 * 8) sof = falls[i];
  const std::uint64_t sent = (sof + 8 * reference_bit(encode_frame(frame).bits)) * kTimeStep;
  EXPECT_EQ(time.stamp(0, 8), sent);
  EXPECT_EQ(time.stamp(1, 5), sent + 2 * kTimeStep);
}

}  // namespace
}  // namespace vericansim

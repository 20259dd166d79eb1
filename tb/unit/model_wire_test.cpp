// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Node models among themselves on one wire, judged by the frame codec and the bus decoder.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "model/bus_decoder.hpp"
#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using namespace model_bench;  // NOLINT: the bench exists for these tests

Frame random_frame(std::mt19937 &rng) {
  Frame f;
  f.extended = (rng() & 1) != 0;
  f.remote = (rng() & 7) == 0;
  // Few identifiers, so that arbitration often runs long.
  f.id = (rng() & 3) == 0 ? static_cast<std::uint32_t>(rng()) : 0x15555555u ^ (1u << (rng() % 29));
  f.id &= f.extended ? 0x1FFFFFFFu : 0x7FFu;
  f.dlc = static_cast<std::uint8_t>(rng() & 15);
  for (unsigned i = 0; i < f.payload_size(); ++i) f.data[i] = static_cast<std::uint8_t>(rng());
  return f;
}

std::vector<BusEvent> decode(const std::vector<Level> &waveform) {
  std::vector<BusEvent> events;
  BusDecoder decoder({.starts_idle = true}, [&](const BusEvent &e) { events.push_back(e); });
  Time now = 0;
  for (const Level level : waveform) {
    decoder.on_level(now, level);
    now += kMicrosecond;
  }
  decoder.finish(now);
  return events;
}

/// Two frames of which the second loses at the named position (0 = ID28 .. 31 = last RTR).
struct Contest {
  Frame winner, loser;
};

Contest contest_at(unsigned position, bool extended_loser) {
  Frame low{.id = 0x0A5 << 1, .dlc = 2, .data = {0x12, 0x34}};
  if (!extended_loser) {
    Frame high = low;
    if (position < 11) {
      low.id &= ~(1u << (10 - position));
      high.id = low.id | (1u << (10 - position));
    } else {
      high.remote = true;  // AR-06: data against remote
      high.data = {};
    }
    return {low, high};
  }
  Frame high{.id = 0x0AAAAAAA, .extended = true, .dlc = 3, .data = {9, 8, 7}};
  if (position == 11 || position == 12) {  // loss at SRR to base data, at IDE to base remote
    low.id = high.id >> 18;
    low.remote = position == 12;
    if (low.remote) low.data = {};
    return {low, high};
  }
  Frame winner = high;
  if (position == 31) {
    high.remote = true;
    high.data = {};
    return {winner, high};
  }
  const unsigned bit = position < 11 ? 28 - position : 30 - position;
  winner.id &= ~(1u << bit);
  high.id = winner.id | (1u << bit);
  return {winner, high};
}

void expect_contest(unsigned position, bool extended, bool third_node) {
  const Contest c = contest_at(position, extended);
  Wire wire(third_node ? 3 : 2);
  wire.nodes[0].request(c.winner);
  wire.nodes[1].request(c.loser);
  bool lost = false;
  for (int bit = 0; bit < 400; ++bit) {
    wire.step();
    const NodeEvents &e = wire.nodes[1].events();
    if (!e.lost_arbitration) continue;
    EXPECT_FALSE(lost) << "twice";
    lost = true;
    EXPECT_EQ(e.lost_position, position);
    EXPECT_EQ(wire.nodes[1].role(), Role::kReceiver);
  }
  EXPECT_TRUE(lost) << position;
  for (const NodeModel &node : wire.nodes) {
    EXPECT_FALSE(node.pending());
    EXPECT_EQ(node.tec() + node.rec(), 0);
  }
  // The first node receives the loser's frame, the second the winner's, a third both.
  EXPECT_EQ(wire.delivered.size(), third_node ? 4u : 2u);
  EXPECT_EQ(wire.delivered.front().frame, c.winner);
  EXPECT_EQ(wire.delivered.back().frame, c.loser);
  const std::vector<BusEvent> events = decode(wire.waveform);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].frame, c.winner);
  EXPECT_EQ(events[1].frame, c.loser);
  EXPECT_EQ(events[1].start - events[0].end, 3 * kMicrosecond);  // IF-02, IF-03
}

TEST(NodeModelWire, LossAtEveryBasePosition) {  // AR-02, AR-04..AR-09, AK-04, ST-08
  for (unsigned position = 0; position < 12; ++position) {
    for (const bool third : {false, true}) expect_contest(position, false, third);
  }
}

TEST(NodeModelWire, LossAtEveryExtendedPosition) {  // AR-06, AR-07, PF-17
  for (unsigned position = 0; position < 32; ++position) {
    for (const bool third : {false, true}) expect_contest(position, true, third);
  }
}

TEST(NodeModelWire, SameIdentifierDifferentData) {  // AR-10
  Wire wire(3);
  wire.nodes[0].request({.id = 0x100, .dlc = 1, .data = {0x0F}});
  wire.nodes[1].request({.id = 0x100, .dlc = 1, .data = {0x1F}});
  int errors = 0;
  for (int bit = 0; bit < 60; ++bit) {
    wire.step();
    if (wire.nodes[1].events().error == NodeError::kBit1) ++errors;
  }
  EXPECT_EQ(errors, 1);
  EXPECT_EQ(wire.nodes[1].tec(), 8);
}

TEST(NodeModelWire, IdenticalFramesBothSucceed) {  // AR-10
  Wire wire(3);
  for (int i = 0; i < 2; ++i) wire.nodes[static_cast<std::size_t>(i)].request(kGv1);
  wire.run(70);
  EXPECT_FALSE(wire.nodes[0].pending() || wire.nodes[1].pending());
  EXPECT_EQ(wire.delivered.size(), 1u);
}

TEST(NodeModelWire, RandomTrafficMatchesCodecAndDecoder) {  // FF-01, FF-02, CR-05, IF-03
  std::mt19937 rng(7);
  Wire wire(4);
  for (int bit = 0; bit < 200'000; ++bit) {
    for (NodeModel &node : wire.nodes) {
      if (!node.pending() && rng() % 150 == 0) node.request(random_frame(rng));
    }
    wire.step();
  }
  const std::vector<BusEvent> events = decode(wire.waveform);
  ASSERT_GT(events.size(), 1000u);
  std::size_t delivery = 0;
  for (const BusEvent &e : events) {
    if (e.kind != BusEventKind::kFrame) continue;  // equal identifiers may collide in the data
    const EncodedFrame expected = encode_frame(e.frame);
    const auto first = static_cast<std::size_t>(e.start / kMicrosecond);
    const std::vector<Level> seen(
        wire.waveform.begin() + static_cast<std::ptrdiff_t>(first),
        wire.waveform.begin() + static_cast<std::ptrdiff_t>(first + expected.bits.size()));
    ASSERT_EQ(to_string(seen), to_string(levels_of(expected.bits)));
    while (delivery < wire.delivered.size() && wire.delivered[delivery].frame == e.frame)
      ++delivery;
  }
  EXPECT_GE(delivery + 4, wire.delivered.size());  // all but a frame that the end cut off
}

TEST(NodeModelWire, NoiseNeverHangsNorCorrupts) {  // TH-07, TH-08, VA-01
  std::mt19937 rng(11);
  Wire wire(4);
  std::vector<Frame> requested;
  const auto noise = [&](std::size_t, Level level) { return rng() % 400 == 0 ? !level : level; };
  for (int bit = 0; bit < 200'000; ++bit) {
    for (NodeModel &node : wire.nodes) {
      if (node.pending() || rng() % 200 != 0) continue;
      requested.push_back(random_frame(rng));
      node.request(requested.back());
    }
    wire.step(noise);
  }
  ASSERT_GT(wire.delivered.size(), 200u);
  for (const Wire::Delivery &d : wire.delivered) {
    EXPECT_NE(std::find(requested.begin(), requested.end(), d.frame), requested.end());
  }
  wire.run(128 * 11 + 2000);  // longest wait: bus-off
  for (const NodeModel &node : wire.nodes) {
    EXPECT_FALSE(node.pending());
    EXPECT_NE(node.error_state(), ErrorState::kBusOff);
  }
}

TEST(NodeModelWire, PassiveReceiverOutOfStep) {  // EF-12
  // A passive receiver errs locally in a frame that the others accept; its flag ends with six equal
  // bits, and a frame that follows at once meets its delimiter or its intermission.
  for (int gap = 3; gap <= 9; ++gap) {  // bits between EOF7 and the next SOF
    Wire wire(3);
    wire.nodes[2].preset_counters(200, 0);
    wire.nodes[0].request(kGv1);
    wire.run(1);
    bool overload = false;
    bool form = false;
    for (int bit = 0; bit < 53 + gap + 20; ++bit) {
      if (bit == 53 + gap - 1) wire.nodes[0].request(kGv1);
      // Bit 17 is the frame's only stuff bit.
      wire.step([&](std::size_t n, Level l) { return n == 2 && bit == 17 ? !l : l; });
      if (bit > 53) overload |= wire.nodes[2].events().overload;
      if (bit > 53) form |= wire.nodes[2].events().error == NodeError::kForm;
    }
    const int idle_bit = gap - 3 + 1;  // the SOF stands in this idle bit
    EXPECT_EQ(form, idle_bit <= 2) << gap;
    EXPECT_EQ(overload, idle_bit >= 3 && idle_bit <= 5) << gap;
  }
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Simultaneity: RN-46 to RN-48. All of it: remote_campaign.
#include <gmock/gmock.h>

#include "bus/faults.hpp"
#include "harness/depth.hpp"
#include "remote/rtl_bus.hpp"
#include "remote/trigger_skew.hpp"

namespace vericansim {
namespace {

// RN-47: every pair of nodes of every trigger, on a sample of random buses.
TEST(TriggerSkewOfTheRtl, IsWithinItsBoundInEveryCycle) {
  TriggerSkew sum;
  const unsigned buses = depth(8U, 30U);
  for (unsigned seed = 1; seed <= buses; ++seed) sum += measure_triggers("small", seed, 10);
  EXPECT_EQ(sum.triggers, 10 * buses);
  EXPECT_EQ(sum.lost, 0U);
  EXPECT_EQ(sum.above, 0U) << sum.worst;
  EXPECT_GT(sum.part, 0.5) << "nothing comes near the bound: " << sum.worst;
}

// RN-48, VA-03: an error in EOF6 of one node's bus. That node acts at the repetition, the others
// twice; the count says that it was one trigger.
TEST(TriggerSkewOfTheRtl, ErrorInEof6DelaysOneNodeToTheRepetition) {
  RtlBus bus{std::vector<unsigned>{3, 4, 5}};
  (void)bus.start();
  (void)bus.send("000#01");
  std::array<unsigned, 3> applied{};
  for (std::size_t i = 0; i < 3; ++i)
    bus.node(i).on_pulse = [&applied, i](const RemotePulse &pulse) { applied[i] += pulse.apply; };
  PlaceFault flip{3, {.frame = 1, .field = Field::kEof, .index = 5}, Effect::kDominant};
  bus.bus.add(flip);
  (void)bus.send("001#07");
  EXPECT_EQ(flip.hits(), 1U);
  EXPECT_THAT(applied, ::testing::ElementsAre(2, 1, 2));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(bus.node(i).peek(remote_map::kStatus + 7), 7);
}

// RN-46: staged bytes become visible with the trigger, in OPERATE alone; in SAFE it only counts.
TEST(TriggerSkewOfTheRtl, StagedBytesWaitForTheTrigger) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  (void)bus.send("190#0102030405060708");
  (void)bus.send("001#05");
  EXPECT_EQ(bus.node().peek(0x10), 0);
  EXPECT_EQ(bus.node().peek(remote_map::kStatus + 7), 5);
  (void)bus.send("000#01");
  EXPECT_EQ(bus.node().peek(0x17), 0);
  (void)bus.send("001#");
  for (unsigned i = 0; i < 8; ++i) EXPECT_EQ(bus.node().peek(0x10 + i), i + 1);
  EXPECT_EQ(bus.node().peek(remote_map::kStatus + 7), 6);
}

}  // namespace
}  // namespace vericansim

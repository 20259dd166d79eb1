// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors on the RTL, bit by bit: RN-20 to RN-27, RN-30, RN-31, RN-46.
#include <gmock/gmock.h>

#include "remote/frame_texts.hpp"
#include "remote/golden_vectors.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

void expect_memory(const RemoteNode &node, const golden::Vector &vector) {
  for (const auto &[address, bytes] : vector.memory)
    for (unsigned i = 0; i < bytes.size(); ++i)
      EXPECT_EQ(node.peek(address + i), bytes[i]) << std::hex << address + i;
}

// `counts`: codes and counts too, which a repetition may change.
void expect_status(const RemoteNode &node, const golden::Vector &vector, bool counts) {
  if (!vector.status) return;
  for (unsigned i = 0; i < 8; ++i) {
    const auto &wanted = (*vector.status)[i];
    if (wanted && (counts || i < 3 || i == 7)) {
      EXPECT_EQ(node.peek(remote_map::kStatus + i), *wanted) << "byte " << i;
    }
  }
}

std::unique_ptr<RemoteNode> unit_of(const golden::Life &life, const std::string &profile) {
  RemoteConfig config = RemoteConfig::profile(profile);
  config.name_bits = life.name_bits;
  config.serial = life.serial;
  return rtl_unit(life.number, config);
}

class GoldenOnBus : public ::testing::TestWithParam<const char *> {};

// RN-20 to RN-26, RN-30, RN-31, RN-46: as written.
TEST_P(GoldenOnBus, EveryVectorAnswersAsWritten) {
  for (const golden::Life &life : golden::load()) {
    RtlBus bus{unit_of(life, GetParam())};
    EXPECT_THAT(bus.settle(), ::testing::IsEmpty());  // RN-70: off the bus
    EXPECT_EQ(bus.start(), texts_of({life.boot}));
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps)
        EXPECT_EQ(bus.UnitBus::send(step.send, step.from_node),
                  texts_of(step.answers_of(GetParam())));
      expect_memory(bus.node(), vector);
      expect_status(bus.node(), vector, true);
    }
  }
}

// RN-27, VA-03: every frame twice, the second before the node's answer where it can be.
TEST_P(GoldenOnBus, EveryVectorTwiceHasTheEffectOfOne) {
  for (const golden::Life &life : golden::load()) {
    RtlBus bus{unit_of(life, GetParam())};
    (void)bus.start();
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps) {
        (step.from_node ? bus.other : bus.host).request(step.send);
        (void)bus.UnitBus::send(step.send, step.from_node);
      }
      expect_memory(bus.node(), vector);
      expect_status(bus.node(), vector, false);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, GoldenOnBus, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors on the model: RN-20 to RN-26, RN-30, RN-31, RN-40, RN-41, RN-46.
#include "remote/golden_vectors.hpp"
#include "remote/model_node.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

void expect_memory(const ModelNode &node, const golden::Vector &vector) {
  for (const auto &[address, bytes] : vector.memory)
    EXPECT_THAT(node.bytes(address, bytes.size()), ElementsAreArray(bytes)) << std::hex << address;
  if (vector.node) {
    EXPECT_EQ(node.model.number(), *vector.node);
  }
}

/// `counts`: bytes 3 to 6, which a repetition changes, too.
void expect_status(const ModelNode &node, const golden::Vector &vector, bool counts) {
  if (!vector.status) return;
  for (unsigned i = 0; i < 8; ++i) {
    const auto &wanted = (*vector.status)[i];
    if (wanted && (counts || i < 3 || i == 7)) {
      EXPECT_EQ(node.model.memory()[0xFF0 + i], *wanted) << "byte " << i;
    }
  }
}

RemoteConfig config_of(const golden::Life &life, const std::string &profile) {
  RemoteConfig config = RemoteConfig::profile(profile);
  config.name_bits = life.name_bits;
  config.serial = life.serial;
  return config;
}

class GoldenOnModel : public ::testing::TestWithParam<const char *> {};

TEST_P(GoldenOnModel, EveryVectorAnswersAsWritten) {
  for (const golden::Life &life : golden::load()) {
    ModelNode node{config_of(life, GetParam()), life.number};
    EXPECT_THAT(node.drain(), IsEmpty());  // RN-70: off the bus
    node.model.start();
    EXPECT_EQ(node.drain(), texts_of({life.boot}));
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps)
        EXPECT_EQ(node.send(candump_frame(step.send)), texts_of(step.answers_of(GetParam())));
      expect_memory(node, vector);
      expect_status(node, vector, true);
    }
  }
}

// RN-27: every frame comes twice, as after an error in EOF6 for its sender.
TEST_P(GoldenOnModel, EveryVectorTwiceHasTheEffectOfOne) {
  for (const golden::Life &life : golden::load()) {
    ModelNode node{config_of(life, GetParam()), life.number};
    node.started();
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps) {
        node.hear(candump_frame(step.send));
        (void)node.send(candump_frame(step.send));
      }
      expect_memory(node, vector);
      expect_status(node, vector, false);
    }
  }
}

// Vector 15: nodes 3 to 7 answer a poll, each under its own identifier.
TEST(GoldenOnModels, APollIsAnsweredByEveryNumber) {
  const golden::Step poll = golden::load().front().vectors.at(14).steps.at(0);
  ASSERT_EQ(poll.others.size(), 4U);
  for (const auto &[number, answer] : poll.others) {
    ModelNode node{RemoteConfig::profile("full"), number};
    EXPECT_EQ(node.started().send(candump_frame(poll.send)), texts_of({answer}));
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, GoldenOnModel, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim

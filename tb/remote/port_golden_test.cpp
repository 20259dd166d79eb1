// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors on the RTL, at the engine's port: RN-20 to RN-26, RN-30, RN-31, RN-46.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/frame_port.hpp"
#include "remote/frame_texts.hpp"
#include "remote/golden_vectors.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

void expect_memory(const FramePort &port, const golden::Vector &vector) {
  for (const auto &[address, bytes] : vector.memory) {
    for (unsigned i = 0; i < bytes.size(); ++i)
      EXPECT_EQ(port.peek(address + i), bytes[i]) << std::hex << address + i;
  }
}

// As the node tells it: reading STATUS changes nothing in it.
void expect_status(FramePort &port, const golden::Life &life, const golden::Vector &vector,
                   bool counts) {
  if (!vector.status) return;
  Frame ask;
  ask.id = (life.number << (10 - life.name_bits)) + (1U << (10 - life.name_bits)) - 2;
  ask.remote = true;
  ask.dlc = 8;
  port.receive(ask);
  const std::vector<Frame> answers = port.drain();
  ASSERT_EQ(answers.size(), 1U);
  for (unsigned i = 0; i < 8; ++i) {
    const auto &wanted = (*vector.status)[i];
    if (wanted && (counts || i < 3 || i == 7)) {
      EXPECT_EQ(answers[0].data[i], *wanted) << "byte " << i;
    }
  }
}

class GoldenOnPort : public ::testing::TestWithParam<const char *> {};

TEST_P(GoldenOnPort, EveryVectorAnswersAsWritten) {
  for (const golden::Life &life : golden::load()) {
    const auto port = FramePort::create(GetParam(), life.name_bits, life.serial, life.number);
    EXPECT_FALSE(port->running());  // RN-70: off the bus
    EXPECT_THAT(port->drain(), ::testing::IsEmpty());
    port->start();
    EXPECT_EQ(texts_of(port->drain()), texts_of({life.boot}));
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps) {
        port->receive(step.send);
        EXPECT_EQ(texts_of(port->drain()), texts_of(step.answers_of(GetParam())));
      }
      expect_memory(*port, vector);
      expect_status(*port, life, vector, true);
    }
  }
}

// RN-27: every frame comes twice, as after an error in EOF6 for its sender.
TEST_P(GoldenOnPort, EveryVectorTwiceHasTheEffectOfOne) {
  for (const golden::Life &life : golden::load()) {
    const auto port = FramePort::create(GetParam(), life.name_bits, life.serial, life.number);
    port->start();
    (void)port->drain();
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps) {
        port->receive(step.send);
        port->receive(step.send);
        (void)port->drain();
      }
      expect_memory(*port, vector);
      expect_status(*port, life, vector, false);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, GoldenOnPort, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A part of every frame and every access at the engine's port: RN-101. All: remote_campaign.
#include <gtest/gtest.h>

#include "remote/port_every_frame.hpp"

namespace vericansim {
namespace {

class PortEveryFrame : public ::testing::TestWithParam<const char *> {};

// RN-01, RN-02, RN-03, RN-04: what a frame is; RN-30, RN-32, RN-33, RN-34: what comes of it.
// A stride that shares no factor with 32: all DLCs and both RTR at identifiers of every kind.
TEST_P(PortEveryFrame, HasTheEffectOfTheModel) {
  std::uint64_t frames = 0, answers = 0;
  for (unsigned index = 0; index < kPortSettings; ++index) {
    const PortRun run = run_every_frame(port_setting(GetParam(), index), 37, index, 1 + index);
    ASSERT_EQ(run.difference, "");
    frames += run.frames;
    answers += run.answers;
  }
  EXPECT_GT(frames, 28'000U);
  EXPECT_GT(answers, 1'000U);
}

// RN-05, RN-22, RN-32: memory, what is locked or protected, and where areas end.
TEST_P(PortEveryFrame, AccessHasTheEffectOfTheModel) {
  for (const unsigned index : {6U, 7U}) {
    const PortRun run = run_every_access(port_setting(GetParam(), index), 17, index, 1);
    ASSERT_EQ(run.difference, "");
    EXPECT_GT(run.frames, 7'000U);
    EXPECT_GT(run.answers, 2'000U);
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, PortEveryFrame, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim

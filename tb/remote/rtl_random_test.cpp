// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random commands on random buses, RTL beside the model: RN-101. All of it: remote_campaign.
#include <gtest/gtest.h>

#include "remote/random_remotes.hpp"

namespace vericansim {
namespace {

class RtlRandom : public ::testing::TestWithParam<const char *> {};

// RN-101: with drift, delays, noise and disturbed bits.
TEST_P(RtlRandom, NodesDoWhatTheModelDoes) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    RandomRemotes remotes{GetParam(), seed};
    for (unsigned i = 0; i < 50; ++i)
      ASSERT_TRUE(remotes.step()) << "seed " << seed << " step " << i << "\n"
                                  << remotes.history() << remotes.difference();
  }
}

// RN-65: user logic writes an entry in the midst of a frame that it would take.
TEST(RtlRandomSeeds, AnEntryHoldsFromTheNextFrameOn) {
  RandomRemotes remotes{"standard", 2'404'000'067};
  for (unsigned i = 0; i < 50; ++i)
    ASSERT_TRUE(remotes.step()) << remotes.history() << remotes.difference();
}

INSTANTIATE_TEST_SUITE_P(Profiles, RtlRandom, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim

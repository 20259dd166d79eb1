// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Stamps of nodes whose clocks drift and whose bits synchronisation makes shorter and longer, from
// 5 to 11 clocks, by the other's edges and by glitches; software accesses the core in every clock.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "harness/random_seeds.hpp"
#include "time/stamp_judge.hpp"
#include "time/stamp_traffic.hpp"

namespace vericansim {
namespace {

class StampJitter : public StampTraffic {
 protected:
  StampJitter() : StampTraffic{clocks(), kElastic8} { rig_.bus().add(judge_); }

  /// Software shifts the clocks, by so much that both halves of all stamps differ.
  void prepare() override {
    for (const unsigned n : {0u, 1u}) {
      rig_.write(n, time_reg::kTshlo, 0);
      rig_.write(n, time_reg::kTshhi, 1);
      judge_.shifted(n, 1ULL << 32);
    }
    rig_.run(16 * steps_);
  }
  void note(const Frame & /*frame*/, unsigned mb) override {
    sent_[mb] = judge_.valid(0).back();
    const auto &valid = judge_.valid(1);
    received_[number_].insert(valid.begin() + static_cast<std::ptrdiff_t>(noted_), valid.end());
    noted_ = valid.size();
  }

  StampJudge judge_{time_, tctrl_, rareness(), GetParam()};

 private:
  /// Within 0.8 % of 8 MHz: BT-08 allows 1.4 %.
  static std::vector<ClockConfig> clocks() {
    std::mt19937 random{GetParam()};
    std::vector<ClockConfig> all(2);
    for (ClockConfig &clock : all) {
      clock.error_ppm = static_cast<double>(random() % 16001) - 8000;
      clock.phase = static_cast<Time>(random() % 125000);
    }
    return all;
  }
  static unsigned rareness() { return GetParam() % 5 == 0 ? 0 : 20 * (GetParam() % 5); }

  std::size_t noted_ = 0;
};

// TM-20, TM-21, TM-24, TM-25, TM-27, TM-28.
TEST_P(StampJitter, EveryFrameWithItsOwn) {
  run(60);
  EXPECT_GT(judge_.shortened() + judge_.lengthened(), 100u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, StampJitter, random_seeds(16));

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The search for the bit rate on the RTL, bit by bit: RN-70, RN-73, RN-74.
#include <gtest/gtest.h>

#include "harness/depth.hpp"
#include "remote/rate_search.hpp"

namespace vericansim {
namespace {

constexpr unsigned kRows = 8;
constexpr unsigned kFrames = 40;  // RN-74
constexpr unsigned kActive = 16;  // attempts of a single sender until it is error passive

Frame numbered_frame(unsigned number) {
  Frame frame;
  frame.id = 0x123 + 37 * number;
  frame.dlc = static_cast<std::uint8_t>(number % 9);
  for (unsigned i = 0; i < frame.dlc; ++i)
    frame.data[i] = static_cast<std::uint8_t>(91 * number + i);
  return frame;
}

class RtlRate : public ::testing::Test {
 protected:
  void begin(unsigned row, unsigned hosts, double ppm = 0) {
    search_ = std::make_unique<RateSearch>(RateSetting{.row = row, .hosts = hosts, .ppm = ppm});
    search_->start();
    search_->run_bits(20);
  }
  std::unique_ptr<RateSearch> search_;
};

// RN-73: every rate is found, within 40 frames, and the node takes part then.
TEST_F(RtlRate, IsFoundOnABusOfTwo) {
  for (unsigned row = 0; row < kRows; ++row) {
    for (const double ppm : {-1000.0, 0.0, 1000.0}) {
      SCOPED_TRACE(row);
      begin(row, 2, ppm);
      EXPECT_EQ(search_->node().state(), RemoteState::kListen);  // RN-70
      for (unsigned sent = 0; search_->listens() && sent <= kFrames; ++sent) {
        search_->request(numbered_frame(sent));
        // A frame of at most 135 bits, and a pause that is none of the bus's.
        search_->run_bits(150 + sent * 7 % 40);
      }
      EXPECT_LE(search_->frames(), kFrames);
      EXPECT_EQ(search_->node().rate_row(), row);
      search_->run_bits(40);
      EXPECT_EQ(search_->node().state(), RemoteState::kSafe);
      search_->run_bits(200);
      EXPECT_EQ(search_->host(0).events().errors, 0U);  // it has disturbed nobody
    }
  }
}

// RN-73: on a silent bus it waits at the first row and sends nothing.
TEST_F(RtlRate, SilentBusIsLeftAlone) {
  begin(0, 1);
  search_->run_bits(50'000);
  EXPECT_EQ(search_->node().state(), RemoteState::kListen);
  EXPECT_EQ(search_->node().rate_row(), 0U);
  EXPECT_EQ(search_->host(0).events().errors, 0U);
}

// RN-74: a single sender, whom nobody acknowledges, is error passive after 16 attempts; then its
// frames are valid for a listener. It repeats without rest: at 800 kbit/s two bytes take as long as
// a bit at 10 kbit/s, whose sample points fall between frames then.
TEST_F(RtlRate, IsFoundWithASingleSender) {
  for (unsigned row = 0; row < kRows; ++row) {
    for (unsigned dlc = 2; dlc <= (row < 4 ? 8U : 2U); ++dlc) {
      SCOPED_TRACE(testing::Message() << "row " << row << ", DLC " << dlc);
      begin(row, 1);
      Frame frame = numbered_frame(dlc);
      frame.id = 0x2A5;
      search_->request(frame);
      while (search_->listens() && search_->frames() <= kFrames + kActive) search_->run_bits(20);
      EXPECT_LE(search_->frames(), kFrames + kActive);
      EXPECT_EQ(search_->node().rate_row(), row);
      search_->run_bits(400);
      EXPECT_EQ(search_->node().state(), RemoteState::kSafe);
      EXPECT_FALSE(search_->host(0).pending());  // now there is one that acknowledges
    }
  }
}

// RN-73, RN-74: a sample of the campaign's random buses. None is taken for another.
TEST_F(RtlRate, RandomBuses) {
  for (unsigned seed = 0; seed < depth(10U, 40U); ++seed) {
    SCOPED_TRACE(seed);
    const RateTrial trial = random_rate_trial(seed);
    EXPECT_TRUE(trial.right);
    if (trial.setting.noise_per_bit != 0) continue;
    EXPECT_LE(trial.frames, trial.setting.hosts == 1 ? kFrames + kActive : kFrames);
    EXPECT_TRUE(trial.found);
  }
}

}  // namespace
}  // namespace vericansim

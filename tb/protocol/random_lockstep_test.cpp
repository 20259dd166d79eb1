// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Several engines on one wire with noise, each beside its own rule model; the seed is the name of
// the test. VERICAN_SEED=n adds n to all seeds, VERICAN_BITS=n sets the length of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

unsigned environment(const char *name, unsigned otherwise) {
  const char *text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr ? otherwise : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
}

constexpr unsigned kDuts = 3;

// Random traffic, single flips, and bursts that everybody sees.
class Storm {
 public:
  explicit Storm(unsigned seed) : random_{seed} {
    // Every fourth storm has a listener, every fifth an FD-tolerant node, rates differ.
    if (seed % 4 == 3) {
      CoreConfig config = CoreBench::default_config();
      config.listen_only = true;
      configure(2, config);
    }
    if (seed % 5 == 4) {
      CoreConfig config = CoreBench::default_config();
      config.fd_tolerant = true;
      configure(1, config);
    }
    // Right after a sample point of that DUT: engine and model see the request in the same bit.
    bench.on_bit = [this, then = bench.on_bit](unsigned i, const DutBit &bit) {
      then(i, bit);
      if (running_ && !bench.dut(i).pending() && random_() % 200 < 3) request(i);
    };
    flips_per_million_ = 200U << (seed % 7);
    for (unsigned i = 0; i < kDuts; ++i) {
      judge.preset_counters(i, static_cast<std::uint8_t>(random_() % 200), 0);
    }
  }

  void run(unsigned bits) {
    judge.start();
    running_ = true;
    for (unsigned n = 0; n < bits && judge.agrees(); ++n) {
      for (unsigned i = 0; i < kDuts; ++i) {
        if (random_() % 1'000'000 < flips_per_million_) bench.force_next(i, Effect::kFlip);
      }
      if (burst_ == 0 && random_() % 20'000 == 0) burst_ = 1 + random_() % 40;
      if (burst_ != 0) --burst_;
      bench.lt(burst_ != 0 && random_() % 3 != 0 ? Level::kDominant : Level::kRecessive);
      bench.step();
    }
  }

  // TH-08: what anybody delivered is what somebody asked for.
  void expect_only_requested_frames() {
    for (unsigned i = 0; i < kDuts; ++i) {
      for (const Frame &frame : bench.dut(i).received()) {
        const auto same = [&](const Frame &other) { return other == frame; };
        EXPECT_TRUE(std::any_of(requested_.begin(), requested_.end(), same));
      }
    }
  }

  CoreBench bench{kDuts};
  Lockstep judge{bench};
  Assertions assertions{bench};
  std::vector<Frame> sent_by[kDuts];  // requests in their order

 private:
  void configure(unsigned i, const CoreConfig &config) {
    bench.dut(i).configure(config);
    judge.model(i).config().listen_only = config.listen_only;
    judge.model(i).config().fd_tolerant = config.fd_tolerant;
  }

  void request(unsigned i) {
    Frame frame;
    frame.extended = random_() % 2 == 0;
    frame.remote = random_() % 5 == 0;
    frame.dlc = static_cast<std::uint8_t>(random_() % 16);
    // Few identifiers, so that arbitration goes far; each node has its own last bits.
    frame.id = frame.extended ? (0x123U << 18 | (random_() % 4) << 2 | i) : 0x120U + 4 * i;
    for (unsigned k = 0; k < frame.payload_size(); ++k) {
      const auto byte = static_cast<std::uint8_t>(random_());
      frame.data[k] = random_() % 3 == 0 ? std::uint8_t(0xFF * (byte & 1)) : byte;
    }
    judge.request(i, frame);
    requested_.push_back(frame);
    sent_by[i].push_back(frame);
  }

  std::mt19937 random_;
  bool running_ = false;
  unsigned flips_per_million_ = 0;
  unsigned burst_ = 0;
  std::vector<Frame> requested_;
};

class RandomLockstep : public ::testing::TestWithParam<unsigned> {};

INSTANTIATE_TEST_SUITE_P(Seed, RandomLockstep, ::testing::Range(1U, 17U),
                         [](const auto &test) { return std::to_string(test.param); });

// TH-06, TH-07, TH-08, FC-01, RO-01, RO-02, RO-03, PF-56: in step for tens of thousands of bits;
// each request ends exactly once, in order; nothing is delivered that was not sent.
TEST_P(RandomLockstep, EnginesFollowTheRulesUnderNoise) {
  const unsigned seed = GetParam() + environment("VERICAN_SEED", 0);
  SCOPED_TRACE("seed " + std::to_string(seed));
  Storm storm(seed);
  storm.run(environment("VERICAN_BITS", 30'000));
  EXPECT_TRUE(storm.judge.agrees()) << storm.judge.report();
  EXPECT_TRUE(storm.assertions.hold()) << storm.assertions.report();
  storm.expect_only_requested_frames();
  std::size_t sent = 0;
  for (unsigned i = 0; i < kDuts; ++i) {
    const std::vector<Frame> &done = storm.bench.dut(i).sent();
    sent += done.size();
    const std::size_t open = storm.bench.dut(i).pending() ? 1 : 0;
    ASSERT_EQ(done.size() + open, storm.sent_by[i].size());
    EXPECT_TRUE(std::equal(done.begin(), done.end(), storm.sent_by[i].begin()));
  }
  EXPECT_GT(sent, 0u);  // the storm leaves room for traffic
}

}  // namespace
}  // namespace vericansim

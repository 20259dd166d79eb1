// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The stamps of the model beside those of the RTL: the same oscillators, the same edges (TM-122 c).
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "timesync/clock_node.hpp"
#include "timesync/rtl_station.hpp"
#include "verican/timesync.h"

namespace vericansim {
namespace {

constexpr double kFrequency = 20e6;  // 50 ns: what is whole stays whole
constexpr std::uint32_t kBitrate = 500'000, kSyncId = 0x080;
constexpr unsigned kFollowers = 8, kFrames = 1'000;
// The RTL's oscillators keep whole ps at their first edge: nearer ones may fall either way.
constexpr Nanoseconds kUnsure = 0.002L;

/// When a frame begins, its edge at the stamp point SOF: the first dominant level behind eleven
/// recessive bits.
class Beginnings : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kLevels; }
  void on_level(Time t, Level level) override {
    if (level == Level::kDominant && t - recessive_ > 10 * kSecond / kBitrate) latest = t;
    if (level == Level::kRecessive) recessive_ = t;
  }
  Time latest = 0;

 private:
  Time recessive_ = 0;
};

/// The same clock twice.
struct Follower {
  Follower(Bus &bus, unsigned number)
      : oscillator{kFrequency, {.constant = (static_cast<double>(number) - 4) * 23.7e-6}, number},
        rtl{bus, "follower", config(number), kBitrate} {}

  [[nodiscard]] ClockConfig config(unsigned number) {
    ClockConfig result;
    result.frequency_hz = kFrequency;
    result.error_ppm = (static_cast<double>(number) - 4) * 23.7;
    result.phase = std::llround(oscillator.time_of(1, 0) * 1e3L);
    return result;
  }

  // TIME of the model is that of the RTL once; both go on by themselves.
  void align(Time now) {
    const std::int64_t edge = oscillator.last_edge(static_cast<Nanoseconds>(now) / 1e3L);
    const auto begun = static_cast<std::uint64_t>(edge) * 50;
    model = std::make_unique<ClockNode>(oscillator, rtl.reading().whole - begun);
  }

  /// What a driver makes of the model's stamp.
  [[nodiscard]] std::uint64_t stamp(Nanoseconds sof) const {
    return model->receive_stamp(sof) - kReceiveLatency * std::uint64_t{50} / 2;
  }
  [[nodiscard]] bool sure(Nanoseconds sof) {
    const Nanoseconds count = oscillator.count(sof);
    return std::abs(count - std::round(count)) * 50 > kUnsure;
  }

  Oscillator oscillator;
  RtlStation rtl;
  std::unique_ptr<ClockNode> model;
};

struct Stamps {
  void start() {
    ClockConfig clock;
    clock.frequency_hz = kFrequency;
    clock.error_ppm = 41.3;
    clock.phase = 12'345;
    master = std::make_unique<RtlStation>(bus, "master", clock, kBitrate);
    for (unsigned n = 1; n <= kFollowers; ++n)
      followers.push_back(std::make_unique<Follower>(bus, n));
    bus.add(beginnings);
    master->start(0, 0);
    for (const auto &follower : followers) {
      follower->rtl.start(kSyncId, 0x7FF);
      ASSERT_EQ(verican_clock_point(&follower->rtl.dev, VERICAN_STAMP_SOF, false), VERICAN_OK);
    }
    bus.run_for(20 * kSecond / kBitrate);  // all take part
    for (const auto &follower : followers) follower->align(bus.now());
  }

  // A frame, and all software that it needs.
  void send() {
    verican_frame_t frame{};
    frame.id = kSyncId;
    ASSERT_EQ(verican_send(&master->dev, &frame, nullptr), VERICAN_OK);
    const Time end = bus.now() + 80 * kSecond / kBitrate;
    while (bus.now() < end) {
      bus.run_until(end);
      serve();
    }
  }
  // Each interrupt ends a run of the bus.
  void serve() {
    if (master->interrupted()) master->serve();
    for (const auto &follower : followers)
      if (follower->rtl.interrupted()) follower->rtl.serve();
  }

  Bus bus;
  Beginnings beginnings;
  std::unique_ptr<RtlStation> master;
  std::vector<std::unique_ptr<Follower>> followers;
};

TEST(TimeModel, EqualsSkip) {
  Stamps stamps;
  stamps.start();
  unsigned compared = 0;
  for (unsigned n = 0; n < kFrames; ++n) {
    stamps.send();
    const Nanoseconds sof = static_cast<Nanoseconds>(stamps.beginnings.latest) / 1e3L;
    for (const auto &follower : stamps.followers) {
      verican_frame_t frame{};
      ASSERT_TRUE(follower->rtl.receive(frame)) << n;
      if (!follower->sure(sof)) continue;
      ASSERT_EQ(frame.time_ns, follower->stamp(sof)) << n;
      ++compared;
    }
  }
  EXPECT_GT(compared, kFollowers * kFrames * 99 / 100);
}

}  // namespace
}  // namespace vericansim

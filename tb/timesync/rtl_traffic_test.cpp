// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The other frames and the errors of a bus in RTL on which clocks are synchronised.
#include "timesync/rtl_traffic.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "bus/bus.hpp"
#include "node/core_node.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = 2 * kMicrosecond;
constexpr unsigned kBits = 50'000;
// Base data frames of eight bytes with their intermission (FF-11), without and with all stuff bits.
constexpr double kShortest = 111, kLongest = 135;

/// A node that listens at 500 kbit/s; the traffic's software is run by the bus.
struct Listening {
  explicit Listening(const SyncCase &setting)
      : traffic{bus, setting, 1, [this](Time when, std::function<void()> software) {
                  bus.at(when, std::move(software));
                }} {
    traffic.others_send = [] { return false; };
    traffic.on_error = [this] { ++errors; };
    bus.add(node);
    node.start();
    bus.run_for(kBits * kBit);
  }

  static ClockConfig clock() {
    ClockConfig config;
    config.frequency_hz = 9.5e6;  // 19 clocks a bit
    return config;
  }

  Bus bus;
  CoreNode node{"listener", {{.prescaler = 1, .prop = 8, .ps1 = 5, .ps2 = 5, .sjw = 4}}, clock()};
  RtlTraffic traffic;
  unsigned errors = 0;
};

double frames(Listening &listening) {
  return static_cast<double>(listening.node.received().size());
}

TEST(RtlTraffic, FillsTheBus) {
  SyncCase setting;
  setting.load = 1;
  Listening listening{setting};
  EXPECT_GE(frames(listening), kBits / kLongest - 2);
  EXPECT_LE(frames(listening), kBits / kShortest);
  EXPECT_FALSE(listening.traffic.silent());
  for (const Frame &frame : listening.node.received()) EXPECT_GT(frame.id, 0x080u);
}

TEST(RtlTraffic, LeavesGaps) {
  SyncCase setting;
  setting.load_above = 0.25;
  Listening listening{setting};
  EXPECT_GE(frames(listening), 0.15 * kBits / kLongest);
  EXPECT_LE(frames(listening), 0.35 * kBits / kLongest);
  for (const Frame &frame : listening.node.received()) EXPECT_LT(frame.id, 0x080u);
}

// Each of them is an error of the listener too, and the frame is sent again.
TEST(RtlTraffic, MakesErrors) {
  SyncCase setting;
  setting.load = 1;
  setting.bit_errors = 1e-3;
  Listening listening{setting};
  EXPECT_GE(listening.errors, 30u);  // of 50, on average
  EXPECT_LE(listening.errors, 70u);
  EXPECT_NE(listening.node.events().errors & kErrStuff, 0);
  EXPECT_LT(frames(listening), kBits / kShortest - 30);
}

// A bus on which nobody sends is left alone.
TEST(RtlTraffic, LeavesAnIdleBusAlone) {
  SyncCase setting;
  setting.bit_errors = 1e-2;
  Listening listening{setting};
  EXPECT_EQ(listening.errors, 0u);
  EXPECT_EQ(listening.node.events().errors, 0);
  EXPECT_TRUE(listening.traffic.silent());
}

}  // namespace
}  // namespace vericansim

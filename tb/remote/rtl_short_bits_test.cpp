// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bits that glitches make as short as SJW allows, at 8 clocks a bit: the node must have looked at a
// byte before the engine receives the next bits (RN-36).
#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "node/core_node.hpp"
#include "remote/frame_texts.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

constexpr Time kClock = 125 * kNanosecond;
constexpr NodeId kDevice = 1;

constexpr BitTiming kTiming{.prescaler = 1, .prop = 1, .ps1 = 3, .ps2 = 3, .sjw = 3};
constexpr Time kShort = 5 * kClock;  // the shortest bit

/// Sample points of the device in the data field.
class DataBits : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node != kDevice || bit.at.transmitter) return;
    if (bit.at.field == Field::kData && !bit.at.stuff) points.push_back(bit.time);
    if (bit.at.field == Field::kCrc && points.size() == bits) points.push_back(bit.time);
    if (bit.after.rx_valid) valid = true;
  }
  std::size_t bits = 0;  ///< of the data field
  std::vector<Time> points;
  bool valid = false;
};

/// A node and a host with one clock; a frame meets a millisecond in which both bytes of the
/// watchdog are counted.
class ShortBits {
 public:
  ShortBits(const char *profile, const std::vector<std::string> &before)
      : host_{"host", {.timing = kTiming}, UnitBus::clock()} {
    RemoteConfig config = RemoteConfig::profile(profile);
    config.serial = 0xCAFE1234;
    node = RemoteNode::create("unit3", config, 3, kTiming, UnitBus::clock());
    bus_.add(host_);
    bus_.add(*node);
    bus_.add(glitches_);
    bus_.add(bits);
    // WDT: the low byte is 0 from 1 ms on, when its map entries let a node feed it once more.
    node->user_write(0xF00 / 4, (config.num_map == 0 ? 258U : 257U) << 16, 0xC);
    host_.start();
    node->start();
    bus_.run_for(100 * kMicrosecond);
    for (const std::string &frame : before) {
      host_.request(frame_of(frame));
      bus_.run_for(160 * kMicrosecond);
    }
  }
  ~ShortBits() { bus_.remove(bits); }

  /// Sends so that SOF comes `before` the end of the second millisecond; what the node answers.
  std::vector<std::string> send(const Frame &frame, Time before) {
    bits.points.clear();
    bits.valid = false;
    bits.bits = 8UL * frame.dlc;
    bus_.run_until(2 * kMillisecond - before);
    host_.received().clear();
    host_.request(frame);
    bus_.run_for(400 * kMicrosecond);
    std::vector<std::string> said;
    for (const Frame &one : host_.received()) said.push_back(candump_frame(one));
    return said;
  }
  /// All nodes see a dominant level for a clock.
  void glitch(Time at) { glitches_.add(kAllNodes, Effect::kDominant, {at, at + kClock}); }

  std::unique_ptr<RemoteNode> node;
  DataBits bits;

 private:
  CoreNode host_;
  Bus bus_;
  ScheduledFaults glitches_;
};

class RtlShortBits : public ::testing::Test {
 protected:
  /// Sends a frame whose byte `index` ends with two recessive bits, behind those `before`; the bits
  /// behind them are made short. `good` looks at what the node has done.
  template <typename Good>
  void run(const char *profile, const char *text, unsigned index, Good &&good,
           const std::vector<std::string> &before = {}) {
    const Frame frame = frame_of(text);
    ShortBits plain{profile, before};
    ASSERT_TRUE(good(plain, plain.send(frame, 300 * kMicrosecond)));
    const std::size_t last = 8UL * index + 7;
    const Time begin = 2 * kMillisecond - 300 * kMicrosecond;
    const Time offset = plain.bits.points.at(last - 1) - begin;
    unsigned both = 0;
    for (Time ms = -2; ms < 14; ms += 2)
      for (Time glitch = -3; glitch < 2; ++glitch) {
        ShortBits bus{profile, before};
        const Time first = 2 * kMillisecond + ms * kClock;
        bus.glitch(first + glitch * kClock);
        bus.glitch(first + glitch * kClock + kShort);
        const auto said = bus.send(frame, offset - ms * kClock);
        const std::vector<Time> &points = bus.bits.points;
        if (!bus.bits.valid || points.size() <= last + 1) continue;
        both +=
            points[last] - points[last - 1] == kShort && points[last + 1] - points[last] == kShort;
        EXPECT_TRUE(good(bus, said)) << text << ", ms " << ms << ", glitch " << glitch;
      }
    EXPECT_GT(both, 3U);
  }
};

// RN-26: the mask 03 leaves out bit 2, in which the number differs.
TEST_F(RtlShortBits, ASelectIsObeyed) {
  run("small", "002#300312FFFEFFCAFF", 1, [](ShortBits &, const std::vector<std::string> &said) {
    return said == std::vector<std::string>{"402#"};
  });
}

// RN-41: the fourth frame of a block write is the next one.
TEST_F(RtlShortBits, ASequenceNumberIsCompared) {
  run("full", "1FB#0311223344556677", 0,
      [](ShortBits &bus, const std::vector<std::string> &said) {
        return said.empty() && bus.node->peek(0x300 + 3 * 7) == 0x11;
      },
      {"1FA#025B00032000", "1FB#0000000000000000", "1FB#0100000000000000", "1FB#0200000000000000"});
}

}  // namespace
}  // namespace vericansim

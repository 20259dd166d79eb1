// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Stamps at the end of a frame whose last bit a glitch makes as short as SJW allows, at 8 clocks a
// bit and with software that accesses the core in every clock (TM-24, TM-28).
#include <gtest/gtest.h>

#include <cstdint>

#include "bus/faults.hpp"
#include "time/time_rig.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

constexpr Time kClock = 125 * kNanosecond;
constexpr std::uint32_t kPointEof = 0x32;
constexpr unsigned kShort = 5;
/// Upper half of TIME, which no buffer has in its stamp yet.
constexpr std::uint32_t kUpper = 0x1234;

/// Sample points of node 0 in EOF.
class EndOfFrame : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node != 0 || bit.at.field != Field::kEof) return;
    before_last = last;
    last = bit.time;
  }
  Time before_last = 0, last = 0;
};

/// Node 0 sends a frame from buffer 8; a glitch comes `glitch` clocks behind the sample point of
/// EOF6, and its software reads stamps, from `start` clocks behind the write on.
class OwnFrame {
 public:
  OwnFrame() {
    rig_.bus().add(eof_);
    rig_.bus().add(glitches_);
    rig_.run(400);
    for (unsigned n = 0; n < 2; ++n) rig_.configure(n, {.ctrl = kElastic8});
    rig_.write(0, kTctrl, kPointEof);
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
    rig_.write(0, kTimelo, 0);
    rig_.write(0, kTimehi, kUpper);
  }
  ~OwnFrame() { rig_.bus().remove(eof_); }

  void glitch(Time at) { glitches_.add(0, Effect::kDominant, {at, at + kClock}); }
  void send(unsigned start) {
    rig_.put_tx(0, 8, Frame{.id = 0x2AA, .dlc = 0});
    rig_.run(start);
    rig_.hammer(0, [] { return AhbTransfer{.address = stamp(20)}; });
    rig_.run(800);
    rig_.hammer(0, nullptr);
  }

  TimeRig time{2};
  [[nodiscard]] Time last_bit() const { return eof_.last - eof_.before_last; }
  [[nodiscard]] Time valid() const { return eof_.before_last; }

 private:
  MailboxRig &rig_ = time.rig;
  EndOfFrame eof_;
  ScheduledFaults glitches_;
};

// TM-28: a short EOF7, behind which the buffer is no longer on the bus, leaves time for both words.
TEST(StampShortBits, OwnFrameAtItsEnd) {
  unsigned shortened = 0;
  for (const unsigned start : {20U, 21U}) {
    OwnFrame plain;
    plain.send(start);
    const std::uint64_t expected = plain.time.stamp(0, 8);
    ASSERT_EQ(expected >> 32, kUpper);
    ASSERT_EQ(plain.last_bit(), 8 * kClock);
    for (Time glitch = -3; glitch < 6; ++glitch) {
      OwnFrame disturbed;
      disturbed.glitch(plain.valid() + glitch * kClock);
      disturbed.send(start);
      if ((disturbed.time.rig.flags(0) & 1U << 8) == 0 || disturbed.valid() != plain.valid())
        continue;
      shortened += disturbed.last_bit() == kShort * kClock;
      EXPECT_EQ(disturbed.time.stamp(0, 8), expected)
          << "from " << start << ", glitch " << glitch << ", EOF7 of "
          << disturbed.last_bit() / kClock;
    }
  }
  EXPECT_EQ(shortened, 2U);
}

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bits that a glitch makes as short as SJW allows, at 8 clocks a bit, and software that writes the
// buffers in every clock: what the frame on the bus leaves in its hidden row, it leaves in time.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr Time kClock = 125 * kNanosecond;
constexpr Time kShort = 5 * kClock;
constexpr NodeId kReceiver = 1;

/// Sample points of the receiver in the data field.
class DataBits : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node != kReceiver || bit.at.transmitter) return;
    if (bit.at.field == Field::kData && !bit.at.stuff) points.push_back(bit.time);
  }
  std::vector<Time> points;
};

Frame data_frame(std::uint32_t id) {
  Frame frame{.id = id, .dlc = 4};
  for (unsigned i = 0; i < 4; ++i) frame.data[i] = static_cast<std::uint8_t>(0x59 + 0x22 * i);
  return frame;
}

/// Node 0 sends; node 1 receives in buffer 20 what its software has read and not let go yet, and in
/// 21 the frame of which a bit is short.
class Receiver {
 public:
  Receiver() {
    rig.bus().add(glitches_);
    rig.run(400);
    for (unsigned n = 0; n < 2; ++n) rig.configure(n, {.ctrl = kElastic8});
    for (unsigned n = 0; n < 2; ++n) rig.go(n);
    rig.put_rx(kReceiver, 20, data_frame(0x100));
    rig.put_rx(kReceiver, 21, data_frame(0x200));
    rig.put_tx(0, 8, data_frame(0x100));
    EXPECT_TRUE(rig.wait_flag(0, 8));
    rig.run(100);
    rig.put(kReceiver, 30, mb_words(data_frame(0x300), 8));  // all but its code
    EXPECT_EQ(rig.get(kReceiver, 20).code(), 2U);
    rig.bus().add(bits);
    rig.put_tx(0, 9, data_frame(0x200));
  }
  ~Receiver() { rig.bus().remove(bits); }

  void glitch(Time at) { glitches_.add(kReceiver, Effect::kDominant, {at, at + kClock}); }
  /// Software that offers a frame, lets go of buffer 20 `between` accesses later and goes on
  /// writing; all of it from `at` on.
  void work(Time at, unsigned between) {
    rig.bus().run_until(at);
    const AhbTransfer filler{.address = reg::mb(40, 2), .write = true, .data = 0};
    std::vector<AhbTransfer> all{{.address = reg::mb(30, 0), .write = true, .data = 0x0C040000}};
    all.insert(all.end(), between, filler);
    all.push_back({.address = reg::kTimer});
    all.insert(all.end(), 8, filler);
    rig.burst(kReceiver, all);
    rig.run(1500);
  }

  MailboxRig rig{2};
  DataBits bits;

 private:
  ScheduledFaults glitches_;
};

// FX-3.5.q: a byte is written before the next bits push it on, though a copy, the serviced mark and
// a write of the CPU meet in the same clocks.
TEST(ShortBits, DataBytes) {
  Receiver plain;
  plain.rig.run(1500);
  const MbWords expected = plain.rig.get(kReceiver, 21);
  ASSERT_EQ(mb_frame(expected), data_frame(0x200));
  const Time byte = plain.bits.points.at(15);  // the last bit of byte 1, recessive
  unsigned shortened = 0;
  for (unsigned between = 2; between < 6; ++between)
    for (Time from = -20; from < -2; ++from) {
      Receiver busy;
      busy.glitch(byte - kClock);
      busy.work(byte + from * kClock, between);
      ASSERT_EQ(busy.bits.points.size(), 32U);
      shortened += busy.bits.points[16] - busy.bits.points[15] == kShort;
      const MbWords got = busy.rig.get(kReceiver, 21);
      EXPECT_EQ(got.low, expected.low) << std::hex << "between " << between << ", from " << from;
    }
  EXPECT_EQ(shortened, 72U);
}

}  // namespace
}  // namespace vericansim

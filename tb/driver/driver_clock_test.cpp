// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The clock and the stamps of the time unit, register access by register access.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "driver/fake_core.hpp"
#include "verican/timesync.h"

namespace vericansim {
namespace {

using ::testing::_;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

verican_frame_t one_byte() {
  verican_frame_t frame{};
  frame.id = 0x123;
  frame.dlc = 1;
  return frame;
}

class DriverClock : public ::testing::Test {
 protected:
  void up(bool time_unit = true) {
    if (time_unit) core.word(VERICAN_XCONFIG_OFFSET) |= VERICAN_XCONFIG_TIME_MASK;
    core.word(VERICAN_TCAP_OFFSET) = 0x00020703;  // 2, 7, 3 half clocks
    core.word(VERICAN_TCTRL_OFFSET) = VERICAN_TCTRL_RESET;
    verican_config_t config = core.config();
    config.clock_hz = clock_hz;
    config.bitrate = clock_hz / 25;
    config.callbacks.user = this;
    config.callbacks.on_sent = [](void *self, verican_t *, const verican_tx_event_t *event) {
      static_cast<DriverClock *>(self)->sent.push_back(*event);
    };
    ASSERT_EQ(verican_init(&dev, &config), VERICAN_OK);
    ASSERT_EQ(verican_start(&dev), VERICAN_OK);
    core.on_write = [this](std::uint32_t offset, std::uint32_t value) {
      EXPECT_TRUE(!paired || core.depth > 0);
      writes.emplace_back(offset, value);
    };
    core.on_read = [this](std::uint32_t offset) { reads.push_back(offset); };
  }
  // The words of a mailbox, as a frame leaves them, and its stamp.
  void fill(unsigned mb, std::uint32_t code, std::uint64_t stamp) {
    core.word(VERICAN_MB_CS_OFFSET(mb)) = VERICAN_MB_CS_CODE_SET(code) | 1u << 16;
    core.word(VERICAN_MB_ID_OFFSET(mb)) = 0x123u << VERICAN_MB_ID_STD_SHIFT;
    core.word(0x1400 + 8 * mb) = static_cast<std::uint32_t>(stamp);
    core.word(0x1404 + 8 * mb) = static_cast<std::uint32_t>(stamp >> 32);
    core.word(mb < 32 ? VERICAN_IFLAG1_OFFSET : VERICAN_IFLAG2_OFFSET) |= 1u << mb % 32;
  }
  std::uint64_t received_at(unsigned mb, std::uint32_t code, std::uint64_t stamp) {
    fill(mb, code, stamp);
    verican_irq_handler(&dev);
    verican_frame_t frame{};
    EXPECT_EQ(verican_receive(&dev, &frame), VERICAN_OK);
    return frame.time_ns;
  }
  std::uint64_t sent_at(std::uint32_t code, std::uint64_t stamp) {
    const verican_frame_t frame = one_byte();
    std::uint8_t mb = 0;
    EXPECT_EQ(verican_send(&dev, &frame, &mb), VERICAN_OK);
    fill(mb, code, stamp);
    verican_irq_handler(&dev);
    EXPECT_FALSE(sent.empty());
    return sent.empty() ? 0 : sent.back().time_ns;
  }

  FakeCore core;
  verican_t dev{};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> writes;
  std::vector<std::uint32_t> reads;
  std::vector<verican_tx_event_t> sent;
  std::uint32_t clock_hz = 16'000'000;
  bool paired = false;  ///< every write is to be under lock
};

constexpr std::uint64_t kTime = 0x1234'5678'9ABC'DEF0;

// TM-91: pairs of words, the one that acts last, under lock.
TEST_F(DriverClock, ExactAccesses) {
  up();
  paired = true;
  core.word(VERICAN_TIMELO_OFFSET) = 0x9ABCDEF0;
  core.word(VERICAN_TIMEHI_OFFSET) = 0x12345678;
  std::uint64_t now = 0, increment = 0;
  const unsigned locks = core.locks;
  EXPECT_EQ(verican_clock_get(&dev, &now), VERICAN_OK);
  EXPECT_EQ(now, kTime);
  EXPECT_EQ(core.locks, locks + 1);
  EXPECT_THAT(reads, ElementsAre(0x1110, 0x1114));
  EXPECT_THAT(writes, IsEmpty());
  EXPECT_EQ(verican_clock_set(&dev, kTime), VERICAN_OK);
  EXPECT_EQ(verican_clock_shift(&dev, -2), VERICAN_OK);
  EXPECT_EQ(verican_clock_rate(&dev, 0x14'0000'0007), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1128, 0), Pair(0x1110, 0x9ABCDEF0),
                                  Pair(0x1114, 0x12345678), Pair(0x1120, 0xFFFFFFFE),
                                  Pair(0x1124, 0xFFFFFFFF), Pair(0x1118, 0x14), Pair(0x111C, 0x7)));
  EXPECT_EQ(verican_clock_increment(&dev, &increment), VERICAN_OK);
  EXPECT_EQ(increment, 0x14'0000'0007u);
  EXPECT_EQ(core.depth, 0u);
  EXPECT_FALSE(core.bad_unlock);
}

// TM-14, TM-91: verican_init() sets the rate of its clock, to the nearest; one below 3.93 MHz has
// none.
TEST_F(DriverClock, RateOfTheClock) {
  up();
  EXPECT_EQ(core.word(VERICAN_TINCN_OFFSET), 62u);
  EXPECT_EQ(core.word(VERICAN_TINCF_OFFSET), 0x80000000u);
  clock_hz = 24'000'000;
  up();
  EXPECT_EQ(core.word(VERICAN_TINCN_OFFSET), 41u);
  EXPECT_EQ(core.word(VERICAN_TINCF_OFFSET), 0xAAAAAAABu);  // 2/3
  clock_hz = 3'906'250;                                     // 256 ns
  up();
  EXPECT_EQ(verican_clock_slew(&dev, 0), VERICAN_ERR_UNSUPPORTED);
}

// TM-91: one word for the slew.
TEST_F(DriverClock, Slew) {
  up();
  EXPECT_EQ(verican_clock_slew(&dev, -900), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1128, 0xFFFFFC7Cu)));
}

// TM-31, TM-91: armed for a whole second that is at least 1 ms ahead. Arming sets OUT to 0, so the
// pin is let out behind that.
TEST_F(DriverClock, PulsePerSecond) {
  up();
  const auto armed_at = [this](std::uint64_t now) {
    core.word(VERICAN_TIMELO_OFFSET) = static_cast<std::uint32_t>(now);
    core.word(VERICAN_TIMEHI_OFFSET) = static_cast<std::uint32_t>(now >> 32);
    writes.clear();
    EXPECT_EQ(verican_clock_pps(&dev, true), VERICAN_OK);
    EXPECT_EQ(writes.size(), 4u);
    EXPECT_EQ(writes.at(0), std::make_pair(0x1104u, 0x2031u));
    EXPECT_EQ(writes.at(1), std::make_pair(0x1134u, 500'000'000u));
    EXPECT_EQ(writes.at(2).first, 0x1130u);
    EXPECT_EQ(writes.at(3), std::make_pair(0x1104u, 0x3031u));
    return writes.at(2).second;
  };
  EXPECT_EQ(armed_at(0), 1'000'000'000u);
  EXPECT_EQ(armed_at(998'999'999), 1'000'000'000u);
  EXPECT_EQ(armed_at(999'000'000), 2'000'000'000u);
  EXPECT_EQ(armed_at(1'700'000'000'123'456'789),
            static_cast<std::uint32_t>(1'700'000'001'000'000'000));
  writes.clear();
  EXPECT_EQ(verican_clock_pps(&dev, false), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1104, 0x31)));
}

// TM-31, TM-91: a jump of the clock stops the pulses, and they begin anew at a second of the time
// then, which shows five clocks after it was written: eight reads later.
TEST_F(DriverClock, PulsesBeginAnewBehindAJump) {
  up();
  ASSERT_EQ(verican_clock_pps(&dev, true), VERICAN_OK);
  for (const bool set : {true, false}) {
    writes.clear();
    reads.clear();
    paired = true;
    core.word(VERICAN_TIMELO_OFFSET) = 5;  // as it is after the shift
    core.word(VERICAN_TIMEHI_OFFSET) = 0;
    EXPECT_EQ(set ? verican_clock_set(&dev, 0x1'0000'0000) : verican_clock_shift(&dev, -7),
              VERICAN_OK);
    const std::uint32_t low = set ? 0x1110 : 0x1120;
    if (set) {
      ASSERT_GT(writes.size(), 1u);
      EXPECT_EQ(writes[1], std::make_pair(0x1128u, 0u));
      writes.erase(writes.begin() + 1);
    }
    EXPECT_THAT(writes,
                ElementsAre(Pair(0x1104, 0x31), Pair(low, set ? 0u : 0xFFFFFFF9u),
                            Pair(low + 4, set ? 1u : 0xFFFFFFFFu), Pair(0x1104, 0x2031),
                            Pair(0x1134, 500'000'000u),
                            Pair(0x1130, set ? 705'032'704u : 1'000'000'000u),  // 5 s modulo 2^32
                            Pair(0x1104, 0x3031)));
    EXPECT_EQ(std::count(reads.begin(), reads.end(), 0x1110u), 4);
  }
  EXPECT_EQ(verican_clock_pps(&dev, false), VERICAN_OK);
  writes.clear();
  EXPECT_EQ(verican_clock_set(&dev, 9), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1128, 0u), Pair(0x1110, 9u), Pair(0x1114, 0u)));
}

// TM-03, TM-40: what a soft reset keeps. A launch of before would hold the mailbox of the next
// frame; an interrupt of before has nobody to tell; a slew of before would change the time that the
// next user sets.
TEST_F(DriverClock, InitForgetsLaunchesEventsAndASlew) {
  up();
  const verican_frame_t frame = one_byte();
  core.word(VERICAN_TIMELO_OFFSET) = 1000;
  ASSERT_EQ(verican_send_at(&dev, &frame, 1'000'000, nullptr), VERICAN_OK);
  ASSERT_NE(core.word(VERICAN_TTXMB_OFFSET) & VERICAN_TTXMB_HOLD_MASK, 0u);
  core.word(VERICAN_TCTRL_OFFSET) |= VERICAN_CLOCK_RISING;
  ASSERT_EQ(verican_clock_slew(&dev, 1'000'000), VERICAN_OK);
  core.on_write = [&](std::uint32_t, std::uint32_t) {
    const bool quiet = (core.word(VERICAN_TCTRL_OFFSET) & VERICAN_CLOCK_EVENTS) == 0;
    EXPECT_TRUE(core.depth > 0 || quiet) << "nobody would clear it";
  };
  core.on_read = nullptr;
  verican_config_t config = core.config();
  config.clock_hz = 16'000'000;
  ASSERT_EQ(verican_init(&dev, &config), VERICAN_OK);
  EXPECT_EQ(core.word(VERICAN_TTXMB_OFFSET), 0u);
  EXPECT_EQ(core.word(VERICAN_TCTRL_OFFSET), VERICAN_TCTRL_RESET);
  EXPECT_EQ(core.word(VERICAN_TSLEW_OFFSET), 0u);
}

// TM-03: the clock runs on in disable mode, and would ask a handler that no longer knows the
// device.
TEST_F(DriverClock, DeinitEndsItsEvents) {
  up();
  core.word(VERICAN_TCTRL_OFFSET) |= VERICAN_CLOCK_RISING;
  const auto quiet = [&] { return (core.word(VERICAN_TCTRL_OFFSET) & VERICAN_CLOCK_EVENTS) == 0; };
  core.on_write = [&](std::uint32_t, std::uint32_t) {
    EXPECT_TRUE(core.depth > 0 || dev.life != 0 || quiet()) << "nobody would clear it";
  };
  ASSERT_EQ(verican_deinit(&dev), VERICAN_OK);
  EXPECT_TRUE(quiet());
  EXPECT_EQ(dev.life, 0);
}

// TM-32, TM-91: what is asked for interrupts; the time of an edge is less the latency of 93 ns.
TEST_F(DriverClock, Events) {
  up();
  std::vector<std::pair<std::uint32_t, std::uint64_t>> told;
  const auto on_event = [](void *user, verican_t *, std::uint32_t flags, std::uint64_t time_ns) {
    static_cast<decltype(told) *>(user)->emplace_back(flags, time_ns);
  };
  EXPECT_EQ(verican_clock_irq_handler(&dev), VERICAN_ERR_EMPTY);
  EXPECT_EQ(
      verican_clock_on_event(&dev, VERICAN_CLOCK_RISING | VERICAN_CLOCK_COMPARE, on_event, &told),
      VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1108, 7), Pair(0x1104, 0x30131)));
  core.word(VERICAN_TSTAT_OFFSET) = 0x0007'0005;
  core.word(VERICAN_TEXTLO_OFFSET) = 92;
  core.word(VERICAN_TEXTHI_OFFSET) = 7;
  writes.clear();
  EXPECT_EQ(verican_clock_irq_handler(&dev), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1108, 5)));
  EXPECT_THAT(told, ElementsAre(Pair(5, 0x6'FFFF'FFFF)));
  core.word(VERICAN_TSTAT_OFFSET) = VERICAN_TSTAT_SLEWD_MASK;
  EXPECT_EQ(verican_clock_irq_handler(&dev), VERICAN_OK);
  EXPECT_THAT(told, ElementsAre(Pair(5, 0x6'FFFF'FFFF), Pair(8, 0)));
  writes.clear();
  EXPECT_EQ(verican_clock_on_event(&dev, 0, nullptr, nullptr), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1104, 0x31)));
  EXPECT_EQ(verican_clock_irq_handler(&dev), VERICAN_OK);
  EXPECT_EQ(told.size(), 2u);
}

// TM-91: what happened before it was asked for is not told; what is asked for as before, and may
// wait for the handler, stays.
TEST_F(DriverClock, EventsOfBefore) {
  up();
  paired = true;
  const auto on_event = [](void *, verican_t *, std::uint32_t, std::uint64_t) {};
  const auto cleared_by = [&](std::uint32_t events) {
    writes.clear();
    EXPECT_EQ(verican_clock_on_event(&dev, events, on_event, nullptr), VERICAN_OK);
    EXPECT_EQ(writes.back(), std::make_pair(0x1104u, 0x31u | events));
    return writes.size() == 2 && writes[0].first == 0x1108 ? writes[0].second : 0;
  };
  EXPECT_EQ(cleared_by(VERICAN_CLOCK_SLEWED), 0x08u);
  EXPECT_EQ(cleared_by(VERICAN_CLOCK_SLEWED), 0u);
  EXPECT_EQ(cleared_by(VERICAN_CLOCK_SLEWED | VERICAN_CLOCK_RELEASED), 0x10u);
  EXPECT_EQ(cleared_by(VERICAN_CLOCK_FALLING | VERICAN_CLOCK_RELEASED), 0x03u);
  EXPECT_EQ(cleared_by(VERICAN_CLOCK_RISING | VERICAN_CLOCK_COMPARE), 0x04u);
  EXPECT_EQ(cleared_by(0), 0u);
  EXPECT_EQ(cleared_by(VERICAN_CLOCK_EVENTS), 0x1Fu);
}

// TM-26, TM-27, TM-91: 3 half clocks of 62.5 ns are 93.75 ns, whole ns are taken off; the stamp is
// read under the lock of its mailbox, before TIMER.
TEST_F(DriverClock, StampOfAReceivedFrame) {
  up();
  EXPECT_EQ(received_at(5, VERICAN_MB_CS_CODE_RX_FULL, kTime), kTime - 93);
  const auto at = [this](std::uint32_t offset) {
    return std::find(reads.begin(), reads.end(), offset) - reads.begin();
  };
  EXPECT_LT(at(VERICAN_MB_CS_OFFSET(5)), at(0x1428));
  EXPECT_LT(at(0x1428), at(0x142C));
  EXPECT_LT(at(0x142C), at(VERICAN_TIMER_OFFSET));
}

// TM-28, TM-91: a frame that was sent, a remote frame, one that was aborted.
TEST_F(DriverClock, StampOfASentFrame) {
  up();
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_TX_INACTIVE, kTime), kTime - 218);  // 7 half clocks
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_RX_EMPTY, kTime + 1), kTime + 1 - 218);
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_TX_ABORT, kTime), 0u);
}

// TM-24, TM-25: point and pin decide of the latencies.
TEST_F(DriverClock, StampPoints) {
  up();
  EXPECT_EQ(verican_clock_point(&dev, VERICAN_STAMP_EDGE, true), VERICAN_OK);
  EXPECT_THAT(writes, ElementsAre(Pair(0x1104, 0x35)));
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_TX_INACTIVE, kTime), kTime - 93);
  EXPECT_EQ(verican_clock_point(&dev, VERICAN_STAMP_EOF, false), VERICAN_OK);
  EXPECT_EQ(core.word(VERICAN_TCTRL_OFFSET), 0x32u);
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_TX_INACTIVE, kTime), kTime - 62);
  EXPECT_EQ(received_at(1, VERICAN_MB_CS_CODE_RX_FULL, kTime), kTime - 62);
  EXPECT_EQ(verican_clock_point(&dev, VERICAN_STAMP_SOF, false), VERICAN_OK);
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_TX_INACTIVE, kTime), kTime - 218);
  EXPECT_EQ(verican_clock_point(&dev, static_cast<verican_stamp_point_t>(3), false),
            VERICAN_ERR_RANGE);
}

// TM-40, TM-91: the buffer is held before the frame is in it; at most 2 s ahead, one at a time.
TEST_F(DriverClock, SendAt) {
  up();
  core.word(VERICAN_TIMELO_OFFSET) = 1000;
  const verican_frame_t frame = one_byte();
  std::uint8_t mb = 0;
  EXPECT_EQ(verican_send_at(&dev, &frame, 2'000'001'001, &mb), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_send_at(&dev, &frame, UINT64_MAX, &mb), VERICAN_ERR_RANGE);
  EXPECT_THAT(writes, IsEmpty());
  paired = true;
  EXPECT_EQ(verican_send_at(&dev, &frame, 2'000'001'000, &mb), VERICAN_OK);
  EXPECT_EQ(mb, 56);
  ASSERT_GE(writes.size(), 3u);
  EXPECT_EQ(writes[0], std::make_pair(0x1140u, 2'000'001'000u));
  EXPECT_EQ(writes[1], std::make_pair(0x1144u, 0x80000000u | 56u));
  EXPECT_EQ(writes.back().first, VERICAN_MB_CS_OFFSET(56));
  EXPECT_EQ(verican_send_at(&dev, &frame, 5000, &mb), VERICAN_ERR_BUSY);
  core.word(VERICAN_TTXMB_OFFSET) = 56;  // released
  writes.clear();
  EXPECT_EQ(verican_send_at(&dev, &frame, 1000, nullptr), VERICAN_OK);  // late: at once
  EXPECT_NE(writes.at(0).first, 0x1140u);
  for (int n = 0; n < 6; ++n) EXPECT_EQ(verican_send(&dev, &frame, nullptr), VERICAN_OK);
  writes.clear();
  EXPECT_EQ(verican_send_at(&dev, &frame, 5000, &mb), VERICAN_ERR_BUSY);
  EXPECT_THAT(writes, IsEmpty());
  EXPECT_EQ(verican_send_at(&dev, nullptr, 5000, &mb), VERICAN_ERR_NULL);
}

// TM-44, TM-91: a frame that is taken back leaves no launch behind, and that of another alone.
TEST_F(DriverClock, LaunchTakenBack) {
  up();
  const verican_frame_t frame = one_byte();
  std::uint8_t held = 0, other = 0;
  ASSERT_EQ(verican_send_at(&dev, &frame, 100'000, &held), VERICAN_OK);
  ASSERT_EQ(verican_send(&dev, &frame, &other), VERICAN_OK);
  writes.clear();
  EXPECT_EQ(verican_abort(&dev, other), VERICAN_OK);
  EXPECT_THAT(writes, Not(Contains(Pair(VERICAN_TTXMB_OFFSET, _))));
  EXPECT_EQ(verican_abort(&dev, held), VERICAN_OK);
  EXPECT_THAT(writes, Contains(Pair(VERICAN_TTXMB_OFFSET, held)));
}

// TM-40, TM-91: a callback of the handler stops the device while verican_send_at() is on its way.
TEST_F(DriverClock, NoLaunchOfADeviceThatWasStopped) {
  up();
  const verican_frame_t frame = one_byte();
  core.on_open = [this] {
    core.on_open = nullptr;
    EXPECT_EQ(verican_stop(&dev), VERICAN_OK);
  };
  EXPECT_EQ(verican_send_at(&dev, &frame, 100'000, nullptr), VERICAN_ERR_STATE);
  EXPECT_EQ(core.word(VERICAN_TTXMB_OFFSET), 0u);
}

// TM-40, TM-91: what a callback of the handler launches from the mailbox that verican_abort() has
// just freed is the next frame, whose time stays.
TEST_F(DriverClock, LaunchBehindOneTakenBack) {
  up();
  const verican_frame_t frame = one_byte();
  std::uint8_t mb = 0, next = 0;
  ASSERT_EQ(verican_send(&dev, &frame, &mb), VERICAN_OK);
  core.on_open = [&] {
    std::uint8_t waiting = 0;
    if (verican_tx_waiting(&dev, &waiting) == VERICAN_OK && waiting > 0) return;
    core.on_open = nullptr;
    ASSERT_EQ(verican_send_at(&dev, &frame, 100'000, &next), VERICAN_OK);
  };
  EXPECT_EQ(verican_abort(&dev, mb), VERICAN_OK);
  EXPECT_EQ(next, mb);
  EXPECT_EQ(core.word(VERICAN_TTXMB_OFFSET), VERICAN_TTXMB_HOLD_MASK | mb);
}

// TM-91: without the unit nothing of it is touched.
TEST_F(DriverClock, WithoutTheUnit) {
  up(false);
  EXPECT_EQ(received_at(5, VERICAN_MB_CS_CODE_RX_FULL, kTime), 0u);
  EXPECT_EQ(sent_at(VERICAN_MB_CS_CODE_TX_INACTIVE, kTime), 0u);
  const verican_frame_t frame{};
  std::uint64_t value = 0;
  EXPECT_EQ(verican_send_at(&dev, &frame, 5000, nullptr), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_get(&dev, &value), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_set(&dev, 0), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_shift(&dev, 0), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_slew(&dev, 0), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_rate(&dev, 0), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_increment(&dev, &value), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_pps(&dev, true), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_point(&dev, VERICAN_STAMP_SOF, true), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_on_event(&dev, 0, nullptr, nullptr), VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(verican_clock_irq_handler(&dev), VERICAN_ERR_UNSUPPORTED);
  for (const std::uint32_t offset : reads) EXPECT_LT(offset, 0x1100u);
}

TEST_F(DriverClock, Arguments) {
  up();
  std::uint64_t value = 0;
  EXPECT_EQ(verican_clock_get(nullptr, &value), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_clock_get(&dev, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_clock_increment(&dev, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_clock_rate(&dev, std::uint64_t{1} << 40), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_clock_on_event(&dev, VERICAN_CLOCK_RISING, nullptr, nullptr), VERICAN_ERR_NULL);
  const auto on_event = [](void *, verican_t *, std::uint32_t, std::uint64_t) {};
  EXPECT_EQ(verican_clock_on_event(&dev, 1, on_event, nullptr), VERICAN_ERR_RANGE);
  EXPECT_THAT(writes, IsEmpty());
}

}  // namespace
}  // namespace vericansim

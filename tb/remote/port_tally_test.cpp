// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The counters at FE8 where two things happen at once (RN-35, RN-54), and that of holds (RN-52).
#include <gtest/gtest.h>

#include <string>

#include "remote/frame_port.hpp"
#include "remote/model_node.hpp"

namespace vericansim {
namespace {

constexpr unsigned kLife = 0xF05, kRetry = 0xF07, kValue = 0xFE9, kDropped = 0xFEB, kDup = 0xFEC,
                   kHold = 0xFEF;

/// A node of profile full with an answer that waits for `ms` milliseconds already.
std::unique_ptr<FramePort> waiting(unsigned ms, unsigned retry = 8) {
  auto port = FramePort::create("full", 3, 0xCAFE1234, 3);
  port->user_write(kLife / 4, 0x0100, 2);             // 10 ms
  port->user_write(kRetry / 4, retry << 24, 1 << 3);  // attempts
  port->start();
  (void)port->drain();
  port->receive(frame_of("1A0#R1"));
  for (unsigned i = 0; i < ms; ++i) port->ms();
  return port;
}

/// Milliseconds until it is dropped.
unsigned life() {
  unsigned ms = 1;
  while (waiting(ms)->peek(kDropped) == 0 && ms < 100) ++ms;
  return ms;
}

// RN-35, RN-54: an answer whose life ends in any clock of a frame that is counted, too.
TEST(PortTally, NothingThatHappensTogetherIsForgotten) {
  const unsigned ms = life();
  ASSERT_LE(ms, 20U);
  for (const auto &[frame, counter] : {std::pair{"1A0#", kValue}, std::pair{"5A0#00", kDup}}) {
    for (unsigned clock = 1; clock < 220; ++clock) {
      SCOPED_TRACE(testing::Message() << frame << ", clock " << clock);
      const auto port = waiting(ms - 1);
      ASSERT_EQ(port->peek(kDropped), 0);
      port->pulse_ms_in(clock);
      port->receive(frame_of(frame));
      port->clocks(300);
      EXPECT_EQ(port->peek(kDropped), 1);
      EXPECT_EQ(port->peek(counter), 1);
    }
  }
}

// RN-15, RN-35: an answer whose only attempt fails near the end of its life, in any clock, is
// counted as dropped once.
TEST(PortTally, AnAnswerIsDroppedOnce) {
  const unsigned ms = life();
  for (unsigned clock = 1; clock < 600; ++clock) {
    SCOPED_TRACE(clock);
    const auto port = waiting(ms - 1, 1);
    ASSERT_EQ(port->peek(kDropped), 0);
    ASSERT_TRUE(port->asks());
    port->pulse_ms_in(clock);
    (void)port->send(FramePort::End::kError);
    port->clocks(300);
    ASSERT_FALSE(port->asks());
    EXPECT_EQ(port->peek(kDropped), 1);
  }
}

void bits(FramePort &port, unsigned count) {
  for (; count != 0; --count) port.bit();
}

// RN-35, RN-52: a hold is honoured for 64 clocks; then it is ignored, and counted.
TEST(PortTally, AHoldThatIsTooLongIsCounted) {
  const auto port = FramePort::create("full", 3, 0xCAFE1234, 3);
  port->start();
  (void)port->drain();
  for (unsigned n = 1; n <= 3; ++n) {
    port->hold(true);
    port->receive_until_valid(frame_of("1A0#0" + std::to_string(n)));
    bits(*port, 6);
    EXPECT_EQ(port->peek(0x20), n - 1);
    bits(*port, 14);
    EXPECT_EQ(port->peek(0x20), n);
    EXPECT_EQ(port->peek(kHold), n);
    port->hold(false);
  }
  port->hold(true);
  port->receive_until_valid(frame_of("1A0#09"));
  bits(*port, 6);
  port->hold(false);
  bits(*port, 14);
  EXPECT_EQ(port->peek(0x20), 9);
  EXPECT_EQ(port->peek(kHold), 3);
}

}  // namespace
}  // namespace vericansim

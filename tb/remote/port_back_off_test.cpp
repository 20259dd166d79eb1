// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bus-off over many seconds, at the engine's port: RN-72.
#include <gmock/gmock.h>

#include "remote/frame_port.hpp"

namespace vericansim {
namespace {

/// Milliseconds from bus-off until the engine may recover; then it does.
unsigned back_off(FramePort &port) {
  port.set_counters(0, 0, false, true);
  port.clocks(64);
  (void)port.take_release();
  unsigned ms = 0;
  for (; !port.take_release() && ms < 2000; ++ms) port.ms();
  port.set_counters(0, 0, false, false);
  port.clocks(64);
  (void)port.drain();
  return ms;
}

// Not before BOFF x 2^k ms; the steps are of 2^k ms, so it may be one of them later.
TEST(PortBackOff, DoublesUpTo128TimesAndIsShortAgainAfterTenSeconds) {
  const auto port = FramePort::create("small", 3, 1, 3);
  port->user_write(0xF04 / 4, 2, 1);
  port->start();
  (void)port->drain();
  for (unsigned k = 0; k < 10; ++k) {
    const unsigned step = 1U << std::min(k, 7U);
    EXPECT_THAT(back_off(*port), ::testing::AllOf(::testing::Ge(2 * step), ::testing::Le(3 * step)))
        << k;
  }
  for (unsigned i = 0; i < 10'000; ++i) port->ms();
  EXPECT_GE(back_off(*port), 256U);
  for (unsigned i = 0; i < 10'500; ++i) port->ms();
  EXPECT_LE(back_off(*port), 3U);
}

// RN-60: and after a reset, one during bus-off.
TEST(PortBackOff, IsShortAfterAReset) {
  const auto port = FramePort::create("small", 3, 1, 3);
  port->start();
  port->set_counters(0, 0, false, true);
  port->clocks(64);
  port->reset();
  port->user_write(0xF04 / 4, 4, 1);
  port->start();
  (void)port->drain();
  EXPECT_LE(back_off(*port), 5U);
}

}  // namespace
}  // namespace vericansim

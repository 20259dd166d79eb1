// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers that wait, at the engine's port: RN-54.
#include <gmock/gmock.h>

#include "remote/frame_port.hpp"
#include "remote/model_node.hpp"
#include "remote/remote_text.hpp"

namespace vericansim {
namespace {

constexpr unsigned kLife = 3;  // x 10 ms

class PortLife : public ::testing::Test {
 protected:
  PortLife() {
    set_life(kLife);
    port->start();
    (void)port->drain();
    port->receive(read());  // the new LIFE holds from the frame behind this one on
    (void)port->drain();
  }
  void set_life(unsigned steps) {
    port->user_write(remote_map::kLife / 4, steps << 8 * (remote_map::kLife % 4),
                     1U << remote_map::kLife % 4);
  }
  void set_retry(unsigned attempts) {
    port->user_write(remote_map::kRetry / 4, attempts << 8 * (remote_map::kRetry % 4),
                     1U << remote_map::kRetry % 4);
  }
  void wait(unsigned ms) {
    for (; ms != 0; --ms) port->ms();
  }
  static Frame read() {
    Frame frame;
    frame.id = 0x1A0;
    frame.remote = true;
    frame.dlc = 2;
    return frame;
  }
  std::unique_ptr<FramePort> port = FramePort::create("small", 3, 1, 3);
};

// RN-54: an answer that the bus does not take is dropped before it is older than LIFE, which is
// counted in steps of 10 ms.
TEST_F(PortLife, AnAnswerOlderThanLifeIsDropped) {
  port->receive(read());
  port->clocks(64);
  ASSERT_TRUE(port->asks());
  wait(10 * (kLife - 1) - 1);
  EXPECT_TRUE(port->asks());
  wait(1 + 10);
  EXPECT_FALSE(port->asks());
  port->receive(read());
  EXPECT_EQ(port->drain().size(), 1U) << "the next one is answered";
}

// RN-54: 0 is no limit.
TEST_F(PortLife, NoLimitIsNone) {
  set_life(0);
  for (unsigned i = 0; i < 2; ++i) {
    port->receive(read());
    EXPECT_EQ(port->drain().size(), 1U);
  }
  port->receive(read());
  wait(3000);
  EXPECT_TRUE(port->asks());
}

// RN-54: one that was sent is gone, whatever its age.
TEST_F(PortLife, TheQueueIsEmptyAfterTheAnswer) {
  port->receive(read());
  wait(10);
  EXPECT_EQ(port->drain().size(), 1U);
  wait(100);
  EXPECT_FALSE(port->asks());
}

// RN-54: each answer of the queue has its own age.
TEST_F(PortLife, AllOfTheQueueGrowsOld) {
  port = FramePort::create("standard", 3, 1, 3);
  set_life(kLife);
  port->start();
  (void)port->drain();
  port->receive(read());
  (void)port->drain();
  for (unsigned i = 0; i < 4; ++i) port->receive(read());
  wait(10 * (kLife - 1) - 1);
  EXPECT_EQ(port->drain().size(), 4U) << "they are young enough";
  for (unsigned i = 0; i < 4; ++i) port->receive(read());
  wait(10 * kLife + 10);
  EXPECT_TRUE(port->drain().empty());
  port->receive(read());
  wait(15);
  port->receive(read());
  wait(10 * kLife - 10);
  EXPECT_EQ(port->drain().size(), 1U);
}

// RN-15: 0 attempts is no limit, whatever a byte can count.
TEST_F(PortLife, NoLimitOfAttemptsIsNone) {
  set_retry(0);
  port->receive(read());
  (void)port->drain();
  port->receive(read());
  port->clocks(64);
  for (unsigned attempt = 0; attempt < 600; ++attempt) {
    ASSERT_TRUE(port->asks()) << attempt;
    (void)port->send(FramePort::End::kError);
    port->clocks(64);
  }
  EXPECT_EQ(port->drain().size(), 1U);
}

// RN-15, RN-26: a HERE that is taken back leaves none of its failures to the frame behind it.
TEST_F(PortLife, AttemptsBeginAnewBehindWhatIsTakenBack) {
  set_retry(2);
  port->receive(read());
  (void)port->drain();
  port->receive(frame_of("002#0000000000000000"));
  port->clocks(64);
  ASSERT_EQ(port->send(FramePort::End::kError).id, 0x402U);
  port->receive(frame_of("002#FFFFFFFFFFFFFFFF"));
  port->receive(frame_of("1A0#"));  // of no length: STATUS tells that it is refused
  port->clocks(64);
  for (unsigned attempt = 0; attempt < 2; ++attempt) {
    ASSERT_TRUE(port->asks()) << attempt;
    EXPECT_EQ(port->send(FramePort::End::kError).id, 0x5FEU);
    port->clocks(64);
  }
  EXPECT_FALSE(port->asks());
}

// RN-15: an answer that dies of age gives no attempts back to the STATUS before it.
TEST_F(PortLife, AttemptsGoOnWhereAnotherDies) {
  set_retry(2);
  port->receive(read());
  (void)port->drain();
  port->receive(frame_of("1A0#"));  // of no length: STATUS tells that it is refused
  port->receive(read());
  port->clocks(64);
  ASSERT_EQ(port->send(FramePort::End::kError).id, 0x5FEU);
  wait(10 * kLife + 10);
  ASSERT_TRUE(port->asks());
  EXPECT_EQ(port->send(FramePort::End::kError).id, 0x5FEU);
  port->clocks(64);
  EXPECT_FALSE(port->asks());
}

// RN-54: LIFE of an answer does not depend on the one before it, in whatever clock that goes.
class PortLifeAfter : public ::testing::TestWithParam<const char *> {};

TEST_P(PortLifeAfter, AnAnswerDoesNotInheritTheAgeOfOneThatGoes) {
  constexpr unsigned kSteps = 5;
  const bool queue = GetParam() != std::string{"small"};
  for (unsigned clock = 1; clock < 300; ++clock) {
    SCOPED_TRACE(clock);
    const auto port = FramePort::create(GetParam(), 3, 1, 3);
    port->user_write(remote_map::kLife / 4, kSteps << 8 * (remote_map::kLife % 4),
                     1U << remote_map::kLife % 4);
    port->start();
    (void)port->drain();
    port->receive(frame_of("1A0#R2"));
    for (unsigned ms = 0; ms < 30; ++ms) port->ms();  // LIFE counts the next one
    if (queue) port->receive(frame_of("1A0#R2"));
    ASSERT_TRUE(port->asks());
    port->pulse_ms_in(clock);
    (void)port->send();
    port->clocks(160);
    if (!queue) port->receive(frame_of("1A0#R2"));
    for (unsigned ms = 0; ms < 10 * (kSteps - 2); ++ms) port->ms();
    EXPECT_TRUE(port->asks());
    for (unsigned ms = 0; ms < 20; ++ms) port->ms();
    EXPECT_FALSE(port->asks());
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, PortLifeAfter, ::testing::Values("small", "standard"));

}  // namespace
}  // namespace vericansim

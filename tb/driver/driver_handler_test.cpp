// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The interrupt handler on a core of plain memory: the order of its accesses, and flags that come
// at awkward moments or for nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "driver/driver_node.hpp"
#include "driver/fake_core.hpp"

namespace vericansim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

class DriverHandler : public ::testing::Test {
 protected:
  void up() {
    config_.callbacks.user = this;
    config_.callbacks.on_receive = [](void *self, verican_t *) {
      ++static_cast<DriverHandler *>(self)->notified_;
    };
    config_.callbacks.on_sent = [](void *self, verican_t *, const verican_tx_event_t *event) {
      static_cast<DriverHandler *>(self)->events_.push_back(*event);
    };
    ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
    ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  }
  // A frame in a mailbox, as the core leaves it.
  void arrive(unsigned mb, std::uint32_t id, std::uint32_t stamp, std::uint32_t code = 2) {
    core_.word(VERICAN_MB_CS_OFFSET(mb)) = code << 24 | 1u << 16 | stamp;
    core_.word(VERICAN_MB_ID_OFFSET(mb)) = id << 18;
    flag(mb);
  }
  void flag(unsigned mb) {
    core_.word(mb < 32 ? VERICAN_IFLAG1_OFFSET : VERICAN_IFLAG2_OFFSET) |= 1u << (mb % 32);
  }
  std::vector<std::uint32_t> ids() {
    std::vector<std::uint32_t> ids;
    verican_frame_t frame;
    while (verican_receive(&dev_, &frame) == VERICAN_OK) ids.push_back(frame.id);
    return ids;
  }

  FakeCore core_;
  verican_config_t config_ = core_.config();
  verican_t dev_{};
  unsigned notified_ = 0;
  std::vector<verican_tx_event_t> events_;
};

// verican_recover() asks for what has just happened by itself: the handler, which comes between the
// look at the state and the lock, has seen the end of bus-off. Nothing is under way then, and no
// error interrupts without anybody who listens.
TEST_F(DriverHandler, RecoverBehindTheEndOfBusOff) {
  up();
  constexpr std::uint32_t kBusOff = 2u << VERICAN_ESR1_FLT_CONF_SHIFT;
  core_.word(VERICAN_ESR1_OFFSET) = kBusOff | VERICAN_ESR1_BOFF_INT_MASK;
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  unsigned places = 0;
  for (unsigned place = 0; place < 8; ++place) {
    core_.word(VERICAN_ESR1_OFFSET) = kBusOff;
    (void)verican_irq_handler(&dev_);
    unsigned left = place;
    core_.on_open = [&] {
      if (left-- > 0) return;
      core_.on_open = nullptr;
      core_.word(VERICAN_ESR1_OFFSET) = 0;
      ++places;
      (void)verican_irq_handler(&dev_);
    };
    (void)verican_recover(&dev_);
    core_.on_open = nullptr;
    const bool off = core_.word(VERICAN_ESR1_OFFSET) != 0;
    EXPECT_EQ((core_.word(VERICAN_CTRL1_OFFSET) & VERICAN_CTRL1_ERR_MSK_MASK) != 0, off) << place;
  }
  EXPECT_GT(places, 4u);
}

TEST_F(DriverHandler, NothingToDoIsTold) {
  up();
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY);
  arrive(3, 0x123, 10);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_EQ(notified_, 1u);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY);
}

// flexcan.md 3.6: C/S locks; the flag is cleared before TIMER unlocks.
TEST_F(DriverHandler, AMailboxIsReadInTheOrderOfTheManual) {
  up();
  arrive(3, 0x123, 10);
  std::vector<std::uint32_t> accesses;
  core_.on_read = [&](std::uint32_t offset) {
    if (offset == VERICAN_TIMER_OFFSET || offset / 16 == VERICAN_MB_CS_OFFSET(3) / 16)
      accesses.push_back(offset);
  };
  core_.on_write = [&](std::uint32_t offset, std::uint32_t value) {
    EXPECT_TRUE(offset != VERICAN_IFLAG1_OFFSET || value == 8);
    accesses.push_back(offset);
  };
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_THAT(accesses,
              ElementsAre(VERICAN_MB_CS_OFFSET(3), VERICAN_MB_ID_OFFSET(3),
                          VERICAN_MB_DATA0_OFFSET(3), VERICAN_IFLAG1_OFFSET, VERICAN_TIMER_OFFSET));
}

TEST_F(DriverHandler, FramesLeaveInTheOrderOfTheirStampsAcrossTheWrap) {
  up();
  for (const std::uint32_t timer : {0x7000u, 0xE000u, 0xFFF0u}) {
    core_.word(VERICAN_TIMER_OFFSET) = timer;
    ASSERT_EQ(verican_poll(&dev_, 0), VERICAN_OK);
  }
  core_.word(VERICAN_TIMER_OFFSET) = 0x0100;
  arrive(0, 5, 0x0040);
  arrive(1, 2, 0xFFF8);
  arrive(31, 4, 0x0004);
  arrive(32, 1, 0xFFF1);
  arrive(55, 3, 0xFFFF);
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_THAT(ids(), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(notified_, 1u);
}

// Of two frames that come while the flags are read, the younger in the upper half must not be
// served a round before the older in the lower half.
TEST_F(DriverHandler, FlagsAreTakenOfOneMoment) {
  up();
  core_.word(VERICAN_TIMER_OFFSET) = 0x40;
  bool first = true;
  core_.on_read = [&](std::uint32_t offset) {
    if (offset != VERICAN_IFLAG2_OFFSET || !first) return;
    first = false;  // between the reads of IFLAG1 and IFLAG2
    arrive(2, 1, 0x10);
    arrive(40, 2, 0x20);
  };
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_THAT(ids(), ElementsAre(1, 2));
  EXPECT_EQ(notified_, 1u);
}

TEST_F(DriverHandler, WithoutRoomTheOldestOfABatchStay) {
  config_.rx_ring_size = 4;
  up();
  core_.word(VERICAN_TIMER_OFFSET) = 0x80;
  arrive(0, 6, 0x60);
  arrive(1, 1, 0x10);
  arrive(2, 4, 0x40);
  arrive(3, 2, 0x20);
  arrive(4, 5, 0x50);
  arrive(5, 3, 0x30);
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_THAT(ids(), ElementsAre(1, 2, 3));
  EXPECT_EQ(dev_.stats.rx_dropped, 3u);
}

TEST_F(DriverHandler, AMailboxThatStaysBusyDoesNotHangTheHandler) {
  up();
  arrive(3, 0x123, 10, 3);
  const unsigned reads = core_.reads;
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_LT(core_.reads - reads, 100u);
  // BUSY with a frame in it: by then the move is over for any core that works.
  EXPECT_TRUE(ids().empty());
}

TEST_F(DriverHandler, AFlagForNothingIsCleared) {
  up();
  core_.word(VERICAN_MB_CS_OFFSET(7)) = 0x04000000;
  flag(7);   // receives, is empty
  flag(60);  // transmits, holds nothing
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_EQ(core_.word(VERICAN_IFLAG1_OFFSET) | core_.word(VERICAN_IFLAG2_OFFSET), 0u);
  EXPECT_TRUE(ids().empty());
  EXPECT_TRUE(events_.empty());
  EXPECT_EQ(notified_, 0u);
}

// A line that never falls: others get their turn.
TEST_F(DriverHandler, TheHandlerComesToAnEnd) {
  up();
  core_.on_read = [this](std::uint32_t offset) {
    if (offset == VERICAN_IFLAG1_OFFSET) flag(7);
  };
  core_.word(VERICAN_MB_CS_OFFSET(7)) = 0x02010010;
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_LE(core_.reads, 2000u);
  EXPECT_EQ(ids().size(), 8u);
}

// FlexCAN2 raises no flag for an abort of a frame that still waits.
TEST_F(DriverHandler, AnAbortWithoutAFlagIsToldToo) {
  config_.abort = true;
  up();
  const verican_frame_t frame = driver_frame(0x123);
  std::uint8_t mailbox = 0;
  ASSERT_EQ(verican_send(&dev_, &frame, &mailbox), VERICAN_OK);
  ASSERT_EQ(verican_abort(&dev_, mailbox), VERICAN_OK);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].outcome, VERICAN_TX_ABORTED);
  EXPECT_EQ(verican_abort(&dev_, mailbox), VERICAN_ERR_EMPTY);
}

// Sent in the very moment in which it is withdrawn.
TEST_F(DriverHandler, AFrameThatIsOutAlreadyIsToldAsSent) {
  up();
  const verican_frame_t frame = driver_frame(0x123);
  std::uint8_t mailbox = 0;
  for (const bool late : {false, true}) {
    events_.clear();
    ASSERT_EQ(verican_send(&dev_, &frame, &mailbox), VERICAN_OK);
    if (late) {
      core_.on_write = [&](std::uint32_t offset, std::uint32_t) {
        if (offset == VERICAN_MB_CS_OFFSET(mailbox)) flag(mailbox);
      };
    } else {
      core_.word(VERICAN_MB_CS_OFFSET(mailbox)) = 0x08080020;
      flag(mailbox);
    }
    ASSERT_EQ(verican_abort(&dev_, mailbox), VERICAN_OK);
    core_.on_write = nullptr;
    EXPECT_TRUE(events_.empty());
    core_.word(VERICAN_TIMER_OFFSET) = 0x90;
    ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
    ASSERT_EQ(events_.size(), 1u);
    EXPECT_EQ(events_[0].outcome, VERICAN_TX_SENT);
    EXPECT_EQ(events_[0].timestamp, late ? 0x90u : 0x20u) << "the late write goes over the stamp";
  }
}

// The same of a one-shot, by its own flag or by the mode of all: it may as well have failed.
TEST_F(DriverHandler, AOneShotThatEndsAsItIsWithdrawnIsToldAsWithdrawn) {
  up();
  for (const unsigned flags : {0u, unsigned{VERICAN_FRAME_ONE_SHOT}}) {
    ASSERT_EQ(verican_set_one_shot(&dev_, flags == 0), VERICAN_OK);
    events_.clear();
    const verican_frame_t frame = driver_frame(0x123, 1, flags);
    std::uint8_t mailbox = 0;
    ASSERT_EQ(verican_send(&dev_, &frame, &mailbox), VERICAN_OK);
    core_.on_write = [&](std::uint32_t offset, std::uint32_t) {
      if (offset == VERICAN_MB_CS_OFFSET(mailbox)) flag(mailbox);
    };
    ASSERT_EQ(verican_abort(&dev_, mailbox), VERICAN_OK);
    core_.on_write = nullptr;
    (void)verican_irq_handler(&dev_);
    ASSERT_EQ(events_.size(), 1u);
    EXPECT_EQ(events_[0].outcome, VERICAN_TX_WITHDRAWN);
    // The next one in this mailbox is another matter.
    ASSERT_EQ(verican_set_one_shot(&dev_, false), VERICAN_OK);
    const verican_frame_t next = driver_frame(0x124, 1);
    ASSERT_EQ(verican_send_in(&dev_, &next, mailbox), VERICAN_OK);
    EXPECT_EQ(dev_.tx_once[0] | dev_.tx_once[1], 0u);
    core_.word(VERICAN_MB_CS_OFFSET(mailbox)) = 0x08080020;
    flag(mailbox);
    ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  }
}

// A frame in a mailbox is that of the last call that named it: the handler, which comes when the
// lock opens, finds the mailbox free and fills it, but the end of the frame before has been told by
// then.
TEST_F(DriverHandler, TheEndOfAFrameIsToldBeforeItsMailboxHasAnother) {
  config_.tx_mailboxes = 2;
  up();
  struct User {
    std::vector<std::string> told;
  } user;
  dev_.callbacks.user = &user;
  dev_.callbacks.on_sent = [](void *self, verican_t *dev, const verican_tx_event_t *event) {
    User &to = *static_cast<User *>(self);
    to.told.push_back("end in " + std::to_string(event->mailbox));
    if (event->outcome != VERICAN_TX_SENT) return;
    const verican_frame_t next = driver_frame(0x222);
    std::uint8_t mailbox = 0;
    EXPECT_EQ(verican_send(dev, &next, &mailbox), VERICAN_OK);
    to.told.push_back("next in " + std::to_string(mailbox));
  };
  const verican_frame_t frame = driver_frame(0x111);
  for (int i = 0; i < 2; ++i) ASSERT_EQ(verican_send(&dev_, &frame, nullptr), VERICAN_OK);
  core_.on_write = [&](std::uint32_t offset, std::uint32_t) {
    if (offset != VERICAN_MB_CS_OFFSET(62)) return;
    core_.on_write = nullptr;  // the other frame is out while this one is taken back
    core_.word(VERICAN_MB_CS_OFFSET(63)) = 0x08080020;
    flag(63);
    core_.on_open = [&] {
      core_.on_open = nullptr;
      EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
    };
  };
  ASSERT_EQ(verican_abort(&dev_, 62), VERICAN_OK);
  EXPECT_THAT(user.told, ElementsAre("end in 62", "end in 63", "next in 62"));
}

TEST_F(DriverHandler, StampsBeforeTheBeginningAreZero) {
  up();
  core_.word(VERICAN_TIMER_OFFSET) = 5;
  arrive(3, 0x123, 0xFFF0);
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  verican_frame_t frame;
  ASSERT_EQ(verican_receive(&dev_, &frame), VERICAN_OK);
  EXPECT_EQ(frame.timestamp, 0u);
}

TEST_F(DriverHandler, TheFifoIsEmptiedAndItsFlagsCleared) {  // FX-4.n, FX-4.r
  config_.rx_mode = VERICAN_RX_FIFO;
  up();
  unsigned left = 3;
  core_.word(VERICAN_MB_CS_OFFSET(0)) = 0x00010020;
  core_.word(VERICAN_MB_ID_OFFSET(0)) = 0x100u << 18;
  core_.word(VERICAN_IFLAG1_OFFSET) = 0xE0;
  core_.on_write = [&](std::uint32_t offset, std::uint32_t value) {
    if (offset != VERICAN_IFLAG1_OFFSET || (value & 0x20) == 0) return;
    EXPECT_EQ(value, 0x20u) << "a pop and nothing else";
    if (--left > 0) core_.word(VERICAN_IFLAG1_OFFSET) |= 0x20;
  };
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_EQ(ids().size(), 3u);
  EXPECT_EQ(core_.word(VERICAN_IFLAG1_OFFSET), 0u);
  EXPECT_EQ(dev_.stats.rx_overruns, 1u);
}

// The guide has on_sent send the next frame: in verican_stop() nothing is sent any more.
TEST_F(DriverHandler, StoppingLetsNoCallbackSend) {
  verican_result_t sent_on = VERICAN_OK, started = VERICAN_OK, ended = VERICAN_OK;
  up();
  struct User {
    verican_result_t &sent_on, &started, &ended;
  } user{sent_on, started, ended};
  dev_.callbacks.user = &user;
  dev_.callbacks.on_sent = [](void *self, verican_t *dev, const verican_tx_event_t *) {
    const User &to = *static_cast<User *>(self);
    const verican_frame_t next = driver_frame(0x222);
    to.sent_on = verican_send(dev, &next, nullptr);
    to.started = verican_start(dev);
    to.ended = verican_deinit(dev);
  };
  const verican_frame_t frame = driver_frame(0x111);
  for (int i = 0; i < 2; ++i) ASSERT_EQ(verican_send(&dev_, &frame, nullptr), VERICAN_OK);
  ASSERT_EQ(verican_stop(&dev_), VERICAN_OK);
  EXPECT_EQ(sent_on, VERICAN_ERR_STATE);
  EXPECT_EQ(started, VERICAN_ERR_STATE);
  EXPECT_EQ(ended, VERICAN_ERR_STATE);
  std::uint8_t waiting = 1;
  EXPECT_EQ(verican_tx_waiting(&dev_, &waiting), VERICAN_OK);
  EXPECT_EQ(waiting, 0u);
  for (unsigned mb = dev_.first_tx; mb < 64; ++mb)
    EXPECT_NE(VERICAN_MB_CS_CODE_GET(core_.word(VERICAN_MB_CS_OFFSET(mb))),
              static_cast<unsigned>(VERICAN_MB_CS_CODE_TX_DATA))
        << mb;
  EXPECT_EQ(verican_start(&dev_), VERICAN_OK) << "it is stopped now";
}

// The line is high until the handler has served the core, which it does for no device that it does
// not know: the processor would never come back to verican_init().
TEST_F(DriverHandler, InitialisedAnewTheCoreInterruptsNobody) {
  up();
  unsigned served = 0;
  bool inside = false;
  const auto interrupt = [&] {
    const std::uint32_t line =
        core_.word(VERICAN_IFLAG1_OFFSET) & core_.word(VERICAN_IMASK1_OFFSET);
    if (line == 0 || inside || core_.depth > 0) return;
    inside = true;
    EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
    ++served;
    inside = false;
  };
  core_.on_open = interrupt;
  core_.on_write = [&](std::uint32_t, std::uint32_t) {
    arrive(3, 0x123, 10);
    interrupt();
  };
  arrive(3, 0x123, 10);
  EXPECT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
  EXPECT_EQ(served, 1u) << "before it began";
  EXPECT_EQ(core_.depth, 0u);
}

// The flags of the handler are of before: after a new start they say nothing of what is sent now.
TEST_F(DriverHandler, AfterARestartInACallbackTheNewFramesAreNotOut) {
  up();
  const verican_frame_t frame = driver_frame(0x111);
  std::uint8_t mailbox[2] = {};
  for (std::uint8_t &mb : mailbox) {
    ASSERT_EQ(verican_send(&dev_, &frame, &mb), VERICAN_OK);
    core_.word(VERICAN_MB_CS_OFFSET(mb)) = VERICAN_MB_CS_CODE_SET(VERICAN_MB_CS_CODE_TX_INACTIVE);
    flag(mb);
  }
  unsigned told = 0;
  dev_.callbacks.user = &told;
  dev_.callbacks.on_sent = [](void *self, verican_t *dev, const verican_tx_event_t *) {
    if (++*static_cast<unsigned *>(self) > 1) return;
    const verican_frame_t next = driver_frame(0x222);
    EXPECT_EQ(verican_stop(dev), VERICAN_OK);
    EXPECT_EQ(verican_start(dev), VERICAN_OK);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(verican_send(dev, &next, nullptr), VERICAN_OK);
  };
  ASSERT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
  EXPECT_EQ(told, 2u) << "the old frames";
  std::uint8_t waiting = 0;
  EXPECT_EQ(verican_tx_waiting(&dev_, &waiting), VERICAN_OK);
  EXPECT_EQ(waiting, 2u);
  for (const std::uint8_t mb : mailbox)
    EXPECT_EQ(VERICAN_MB_CS_CODE_GET(core_.word(VERICAN_MB_CS_OFFSET(mb))),
              static_cast<unsigned>(VERICAN_MB_CS_CODE_TX_DATA));
}

// verican_init() is allowed at any time, as a way out of trouble, and so is what follows it: the
// call whose callback it was leaves the new device alone.
TEST_F(DriverHandler, InitialisedAnewInACallbackTheDeviceIsTheNewOne) {
  const verican_frame_t frame = driver_frame(0x111);
  const std::vector<std::function<verican_result_t()>> calls{
      [&] { return verican_stop(&dev_); }, [&] { return verican_abort(&dev_, 56); },
      [&] {
        core_.word(VERICAN_MB_CS_OFFSET(56)) = 0x08080020;
        flag(56);
        return verican_irq_handler(&dev_);
      }};
  for (const auto &call : calls) {
    up();
    struct User {
      verican_config_t config;
      unsigned told = 0;
    } user{config_};
    user.config.callbacks.user = &user;
    user.config.callbacks.on_sent = [](void *self, verican_t *dev, const verican_tx_event_t *) {
      User &to = *static_cast<User *>(self);
      if (++to.told > 1) return;
      EXPECT_EQ(verican_init(dev, &to.config), VERICAN_OK);
      EXPECT_EQ(verican_start(dev), VERICAN_OK);
      const verican_frame_t next = driver_frame(0x222);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(verican_send(dev, &next, nullptr), VERICAN_OK);
    };
    dev_.callbacks = user.config.callbacks;
    for (int i = 0; i < 2; ++i) ASSERT_EQ(verican_send(&dev_, &frame, nullptr), VERICAN_OK);
    EXPECT_EQ(call(), VERICAN_OK);
    EXPECT_EQ(user.told, 1u) << "frames of before are gone without a word";
    std::uint8_t waiting = 0;
    EXPECT_EQ(verican_tx_waiting(&dev_, &waiting), VERICAN_OK);
    EXPECT_EQ(waiting, 3u);
    EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY) << "it is started";
  }
}

// A device that a callback has started anew while it was to end interrupts nobody any more.
TEST_F(DriverHandler, StartedAnewWhileItEndsItInterruptsNobody) {
  up();
  dev_.callbacks.on_state = [](void *, verican_t *dev, verican_state_t state) {
    if (state == VERICAN_STATE_STOPPED) EXPECT_EQ(verican_start(dev), VERICAN_OK);
  };
  EXPECT_EQ(verican_deinit(&dev_), VERICAN_OK);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(core_.word(VERICAN_IMASK1_OFFSET) | core_.word(VERICAN_IMASK2_OFFSET), 0u);
  EXPECT_EQ(core_.word(VERICAN_CTRL1_OFFSET) & VERICAN_CTRL1_BOFF_MSK_MASK, 0u);
}

// A callback of the handler stops the device while verican_send() is on its way to the mailbox.
TEST_F(DriverHandler, StoppedBeforeItHasTheFrameItTakesNone) {
  up();
  const verican_frame_t frame = driver_frame(0x111);
  const std::vector<std::function<verican_result_t()>> sends{
      [&] { return verican_send(&dev_, &frame, nullptr); },
      [&] { return verican_send_in(&dev_, &frame, 60); }};
  for (const auto &send : sends) {
    core_.on_open = [this] {
      core_.on_open = nullptr;
      EXPECT_EQ(verican_stop(&dev_), VERICAN_OK);
    };
    EXPECT_EQ(send(), VERICAN_ERR_STATE);
    std::uint8_t waiting = 1;
    EXPECT_EQ(verican_tx_waiting(&dev_, &waiting), VERICAN_OK);
    EXPECT_EQ(waiting, 0u);
    ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  }
}

// The core interrupts as soon as it may, and a callback stops the device again: it stays stopped,
// and nothing of the core interrupts any more.
TEST_F(DriverHandler, StoppedWhileItStartsItIsStopped) {
  up();
  ASSERT_EQ(verican_stop(&dev_), VERICAN_OK);
  dev_.callbacks.on_state = [](void *, verican_t *dev, verican_state_t state) {
    if (state == VERICAN_STATE_BUS_OFF) EXPECT_EQ(verican_stop(dev), VERICAN_OK);
  };
  const std::uint32_t masks = VERICAN_CTRL1_BOFF_MSK_MASK;
  bool inside = false;
  core_.on_open = [&] {
    const bool line = (core_.word(VERICAN_CTRL1_OFFSET) & masks) != 0 &&
                      (core_.word(VERICAN_ESR1_OFFSET) & VERICAN_ESR1_BOFF_INT_MASK) != 0;
    if (!line || std::exchange(inside, true)) return;
    EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_OK);
    inside = false;
  };
  core_.on_write = [&](std::uint32_t, std::uint32_t) {
    if (core_.depth == 0) core_.on_open();
  };
  core_.word(VERICAN_ESR1_OFFSET) = VERICAN_ESR1_FLT_CONF_SET(2) | VERICAN_ESR1_BOFF_INT_MASK;
  EXPECT_EQ(verican_start(&dev_), VERICAN_OK);
  EXPECT_EQ(core_.word(VERICAN_ESR1_OFFSET) & VERICAN_ESR1_BOFF_INT_MASK, 0u) << "it came";
  EXPECT_EQ(verican_stop(&dev_), VERICAN_ERR_STATE) << "it is stopped";
  EXPECT_EQ(core_.word(VERICAN_IMASK1_OFFSET) | core_.word(VERICAN_IMASK2_OFFSET), 0u);
  EXPECT_EQ(core_.word(VERICAN_CTRL1_OFFSET) & masks, 0u);
}

// States that come one upon the other are told one after the other.
class DriverStates : public DriverHandler {
 protected:
  void SetUp() override {
    config_.callbacks.on_state = [](void *self, verican_t *, verican_state_t state) {
      auto &test = *static_cast<DriverStates *>(self);
      ++test.depth_;
      test.told_.push_back(state);
      EXPECT_EQ(test.depth_, 1u) << "the one before has not returned";
      if (const auto once = std::exchange(test.on_state_, nullptr)) once();
      --test.depth_;
    };
    up();
  }
  static constexpr std::uint32_t kPassive = VERICAN_ESR1_FLT_CONF_SET(1);
  static constexpr std::uint32_t kOff = VERICAN_ESR1_FLT_CONF_SET(2);
  static constexpr std::uint32_t kWentOff = kOff | VERICAN_ESR1_BOFF_INT_MASK;
  void set_state(std::uint32_t esr) { core_.word(VERICAN_ESR1_OFFSET) = esr; }
  // verican_poll() sees `now`, and at the given place where the lock is open behind that an
  // interrupt comes for each of the others.
  void poll(std::uint32_t now, unsigned place, const std::vector<std::uint32_t> &states) {
    bool looked = false;
    told_.clear();
    set_state(now);
    core_.on_read = [&](std::uint32_t offset) { looked |= offset == VERICAN_ESR1_OFFSET; };
    core_.on_open = [&] {
      if (!looked || place-- > 0) return;
      core_.on_open = nullptr;
      for (const std::uint32_t esr : states) {
        set_state(esr);
        verican_irq_handler(&dev_);
      }
    };
    EXPECT_EQ(verican_poll(&dev_, 0), VERICAN_OK);
    EXPECT_EQ(core_.on_open, nullptr) << "there is such a place";
    core_.on_read = nullptr;
  }

  std::vector<verican_state_t> told_;
  std::function<void()> on_state_;  ///< called once

 private:
  unsigned depth_ = 0;
};

TEST_F(DriverStates, WhatAnInterruptFindsIsToldLast) {
  for (unsigned place = 0; place < 5; ++place) {
    SCOPED_TRACE(place);
    poll(kPassive, place, {kWentOff});
    EXPECT_EQ(told_.back(), VERICAN_STATE_BUS_OFF);
    poll(0, place, {kWentOff, kOff, 0});
    EXPECT_THAT(told_, Contains(VERICAN_STATE_BUS_OFF)) << "however short";
    EXPECT_EQ(told_.back(), VERICAN_STATE_ACTIVE);
  }
}

TEST_F(DriverStates, WhatOnStateFindsIsToldWhenItReturns) {
  on_state_ = [this] {
    set_state(kWentOff);
    verican_status_t status{};
    EXPECT_EQ(verican_get_status(&dev_, &status), VERICAN_OK);
    EXPECT_EQ(status.state, VERICAN_STATE_BUS_OFF);
  };
  set_state(kPassive);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY);
  EXPECT_THAT(told_, ElementsAre(VERICAN_STATE_PASSIVE, VERICAN_STATE_BUS_OFF));
}

TEST_F(DriverStates, StoppedInOnStateIsToldWhenItReturns) {
  on_state_ = [this] { EXPECT_EQ(verican_stop(&dev_), VERICAN_OK); };
  set_state(kPassive);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY);
  EXPECT_THAT(told_, ElementsAre(VERICAN_STATE_PASSIVE, VERICAN_STATE_STOPPED));
}

TEST_F(DriverStates, StoppedBeforeItLooksItTellsNoOther) {
  core_.on_open = [this] {
    core_.on_open = nullptr;
    EXPECT_EQ(verican_stop(&dev_), VERICAN_OK);
  };
  EXPECT_EQ(verican_poll(&dev_, 0), VERICAN_OK);
  EXPECT_THAT(told_, ElementsAre(VERICAN_STATE_STOPPED));
  verican_status_t status{};
  EXPECT_EQ(verican_get_status(&dev_, &status), VERICAN_OK);
  EXPECT_EQ(status.state, VERICAN_STATE_STOPPED);
}

// Another device on the line interrupts verican_stop(), which reads the last frames itself.
TEST_F(DriverHandler, StoppingKeepsTheHandlerOut) {
  up();
  arrive(3, 0x123, 10);
  unsigned calls = 0;
  core_.on_read = [&](std::uint32_t offset) {
    if (offset / 16 != VERICAN_MB_CS_OFFSET(3) / 16 || calls != 0) return;
    ++calls;
    EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_STATE);
  };
  // A change of state at the end, which would unmask: the core's line is not to rise any more.
  core_.word(VERICAN_ESR1_OFFSET) = 1u << VERICAN_ESR1_FLT_CONF_SHIFT;
  ASSERT_EQ(verican_stop(&dev_), VERICAN_OK);
  EXPECT_EQ(calls, 1u);
  EXPECT_THAT(ids(), ElementsAre(0x123u));
  EXPECT_EQ(
      core_.word(VERICAN_CTRL1_OFFSET) &
          (VERICAN_CTRL1_BOFF_MSK_MASK | VERICAN_CTRL1_ERR_MSK_MASK | VERICAN_CTRL1_TWRN_MSK_MASK),
      0u);
}

}  // namespace
}  // namespace vericansim

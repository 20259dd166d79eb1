// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A saturated bus at 1 Mbit/s: two nodes send as fast as the bus goes and hear each other, a third
// receives and is served late and irregularly. Nothing is lost, nothing is out of order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>

#include "bus/trace.hpp"
#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;  // at 1 Mbit/s

struct Load {
  const char *name;
  verican_rx_mode_t rx_mode;
  unsigned num_mb;
  unsigned latency;  ///< of the receiver's interrupt, up to so many bit times
  unsigned dlc;      ///< of the frames; 0: the shortest, hardest ones
};

// Bits between the end of a frame and the next identifier, as a receiver sees them: intermission
// and SOF, which is the first bit that is not idle.
class Gaps : public BusObserver {
 public:
  unsigned interests() const override { return kBits; }
  void on_bit(NodeId id, const BitRecord &bit) override {
    if (id != 2) return;
    const Field field = bit.at.field;
    if (field == Field::kInt || field == Field::kIdle || field == Field::kSuspend) {
      ++gap_;
    } else {
      if (gap_ != 0) ++gaps[gap_];
      gap_ = 0;
    }
  }
  std::map<unsigned, unsigned> gaps;

 private:
  unsigned gap_ = 0;
};

class DriverLoad : public ::testing::TestWithParam<Load> {
 protected:
  static constexpr unsigned kSenders = 2, kReceiver = 2;

  // Identifier tells the sender, format alternates, the number of the frame is in its identifier
  // and, where there is room, in its data.
  void send(unsigned n) {
    const unsigned k = queued_[n]++;
    verican_frame_t frame = driver_frame((n << 10) + (k & 0x3FF), GetParam().dlc,
                                         k % 3 == 2 ? unsigned{VERICAN_FRAME_EXTENDED} : 0u, k);
    if ((frame.flags & VERICAN_FRAME_EXTENDED) != 0) frame.id = (n << 28) + k;
    std::uint8_t mailbox = 0;
    ASSERT_EQ(verican_send(&bus_[n].dev, &frame, &mailbox), VERICAN_OK);
    waiting_[n][mailbox] = frame;
  }

  void set_up() {
    for (unsigned n = 0; n < 3; ++n) {
      bus_[n].config.tx_mailboxes = 4;
      if (n == kReceiver) bus_[n].config.rx_mode = GetParam().rx_mode;
      ASSERT_EQ(bus_[n].up(), VERICAN_OK);
    }
    for (unsigned n = 0; n < kSenders; ++n) {
      bus_[n].when_sent = [this, n](const verican_tx_event_t &event) {
        ASSERT_EQ(event.outcome, VERICAN_TX_SENT);
        sent_[n].push_back({event.timestamp, waiting_[n][event.mailbox]});
        if (!ending_) send(n);
      };
    }
  }

  void run(Time duration) {
    std::mt19937 random{7};
    const Time end = bus_.bus.now() + duration;
    while (bus_.bus.now() < end) {
      bus_[kReceiver].interrupts = false;
      bus_.run(GetParam().latency == 0 ? kBit : random() % GetParam().latency * kBit);
      bus_[kReceiver].interrupts = true;
      bus_.run(kBit);
      for (const verican_frame_t &frame : bus_[kReceiver].received()) received_.push_back(frame);
      for (unsigned n = 0; n < kSenders; ++n)
        for (const verican_frame_t &frame : bus_[n].received()) exchanged_[n].push_back(frame.id);
    }
  }

  struct Sent {
    std::uint64_t timestamp;
    verican_frame_t frame;
  };

  DriverBus bus_{3, GetParam().num_mb};
  std::array<unsigned, kSenders> queued_{};
  std::array<std::map<unsigned, verican_frame_t>, kSenders> waiting_;
  std::array<std::vector<Sent>, kSenders> sent_;
  std::vector<verican_frame_t> received_;
  std::array<std::vector<std::uint32_t>, kSenders> exchanged_;  // from the other sender
  bool ending_ = false;
};

TEST_P(DriverLoad, NothingIsLostAndTheOrderIsThatOfTheBus) {  // FX-3.5.l, FX-3.6.d, FX-6.c
  set_up();
  bus_.run(20 * kBit);  // all have integrated
  Gaps gaps;
  bus_.bus.add(gaps);
  for (unsigned k = 0; k < 4; ++k)
    for (unsigned n = 0; n < kSenders; ++n) send(n);
  run(60 * kMillisecond);
  // Between the first frame and the last there was no free bit.
  ASSERT_FALSE(gaps.gaps.empty());
  EXPECT_GT(gaps.gaps[4], 450u);
  unsigned others = 0;
  for (const auto &[bits, count] : gaps.gaps) others += bits == 4 ? 0 : count;
  EXPECT_LE(others, 1u);  // the one before the first frame
  ending_ = true;
  run(5 * kMillisecond);
  bus_.bus.remove(gaps);

  // What was sent, in the order of the bus.
  std::vector<verican_frame_t> expected;
  for (auto &list : sent_)
    std::sort(list.begin(), list.end(),
              [](const Sent &a, const Sent &b) { return a.timestamp < b.timestamp; });
  ASSERT_EQ(received_.size(), sent_[0].size() + sent_[1].size());
  std::array<std::size_t, kSenders> next{};
  for (const verican_frame_t &got : received_) {
    const unsigned n = (got.flags & VERICAN_FRAME_EXTENDED) != 0 ? got.id >> 28 : got.id >> 10;
    ASSERT_LT(next[n], sent_[n].size());
    const verican_frame_t &want = sent_[n][next[n]++].frame;
    ASSERT_EQ(got.id, want.id);
    ASSERT_EQ(got.flags, want.flags);
    ASSERT_EQ(got.dlc, want.dlc);
    if (want.dlc == 8) {
      ASSERT_TRUE(std::equal(got.data, got.data + 8, want.data));
    }
  }
  for (std::size_t i = 1; i < received_.size(); ++i)
    ASSERT_GE(received_[i].timestamp, received_[i - 1].timestamp + 47) << i;
  // The senders, too, had everything from each other while they sent.
  for (unsigned n = 0; n < kSenders; ++n) {
    ASSERT_EQ(exchanged_[n].size(), sent_[1 - n].size());
    for (std::size_t k = 0; k < exchanged_[n].size(); ++k)
      ASSERT_EQ(exchanged_[n][k], sent_[1 - n][k].frame.id);
    EXPECT_EQ(bus_[n].status().stats.rx_overruns, 0u);
  }
  const verican_stats_t stats = bus_[kReceiver].status().stats;
  EXPECT_EQ(stats.received, received_.size());
  EXPECT_EQ(stats.rx_dropped, 0u);
  EXPECT_EQ(stats.rx_overruns, 0u);
  EXPECT_TRUE(bus_[0].rtl().master().report().violations.empty());
}

// The shortest frame and its intermission take 47 bits, the longest 8-byte one at least 111.
INSTANTIATE_TEST_SUITE_P(
    Loads, DriverLoad,
    ::testing::Values(Load{"MailboxesServedAtOnce", VERICAN_RX_MAILBOXES, 64, 0, 0},
                      Load{"MailboxesServedLate", VERICAN_RX_MAILBOXES, 64, 45 * 47, 0},
                      Load{"LongFramesServedLate", VERICAN_RX_MAILBOXES, 64, 45 * 111, 8},
                      Load{"MailboxesOf32", VERICAN_RX_MAILBOXES, 32, 20 * 47, 0},
                      Load{"MailboxesOf16", VERICAN_RX_MAILBOXES, 16, 8 * 47, 8},
                      Load{"FifoServedAtOnce", VERICAN_RX_FIFO, 64, 0, 0},
                      Load{"FifoServedLate", VERICAN_RX_FIFO, 64, 5 * 47, 0},
                      Load{"FifoOf16", VERICAN_RX_FIFO, 16, 5 * 111, 8}),
    [](const auto &load) { return load.param.name; });

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Order of transmission on the wire (flexcan.md 3.3): identifier, PRIO, index, MAXMB, Rx FIFO.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mailbox/tx_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kPrioShift = 29;

struct Item {
  unsigned mb = 0, prio = 0;
  Frame frame;
};

// What the standard says of two frames that begin together: the first differing bit decides, and
// dominant (0) wins.
std::vector<bool> arbitration_bits(const Frame &frame) {
  std::vector<bool> bits;
  const auto add = [&](std::uint32_t value, unsigned width) {
    while (width-- > 0) bits.push_back(((value >> width) & 1) != 0);
  };
  add(frame.extended ? frame.id >> 18 : frame.id, 11);
  if (frame.extended) {
    add(3, 2);
    add(frame.id & 0x3FFFF, 18);
  }
  add(frame.remote, 1);
  if (!frame.extended) add(0, 1);
  return bits;
}

class Order : public ::testing::Test {
 protected:
  void start(std::uint32_t mcr, std::uint32_t ctrl) {
    RigConfig config;
    config.mcr |= mcr;
    config.ctrl |= ctrl;
    rig_ = std::make_unique<TxRig>(2, config);
  }
  void put(const Item &item) {
    MbWords words = mb_words(item.frame, 0xC);
    words.id |= item.prio << kPrioShift;
    rig_->put(0, item.mb, words);
  }
  // Buffers in the order in which their IFLAG comes; none comes twice.
  std::vector<unsigned> sent_order(std::size_t count) {
    std::vector<unsigned> order;
    std::uint64_t seen = 0;
    for (unsigned i = 0; i < 200 * count && order.size() < count; ++i) {
      rig_->run(8);
      const std::uint64_t now = rig_->flags(0);
      for (unsigned mb = 0; mb < 64; ++mb)
        if ((((now & ~seen) >> mb) & 1) != 0) order.push_back(mb);
      seen = now;
    }
    return order;
  }
  std::vector<Item> random_items(unsigned count, std::mt19937 &rng) {
    std::vector<unsigned> mbs(64);
    for (unsigned i = 0; i < 64; ++i) mbs[i] = i;
    std::shuffle(mbs.begin(), mbs.end(), rng);
    std::vector<Item> items;
    for (unsigned i = 0; i < count; ++i) {
      Item item{mbs[i], static_cast<unsigned>(rng() % 4), {}};
      item.frame.extended = rng() % 2 != 0;
      item.frame.remote = rng() % 2 != 0;
      item.frame.id = item.frame.extended ? ((rng() % 3) << 18) | (rng() % 2) : rng() % 3;
      items.push_back(item);
    }
    return items;
  }
  // Everything is pending when the node joins.
  void expect_order(std::vector<Item> items, bool prio, bool lbuf) {
    for (const Item &item : items) put(item);
    rig_->join();
    std::sort(items.begin(), items.end(), [&](const Item &a, const Item &b) {
      if (lbuf) return a.mb < b.mb;
      if (prio && a.prio != b.prio) return a.prio < b.prio;
      const auto x = arbitration_bits(a.frame), y = arbitration_bits(b.frame);
      return x != y ? x < y : a.mb < b.mb;
    });
    std::vector<unsigned> want;
    for (const Item &item : items) want.push_back(item.mb);
    EXPECT_EQ(sent_order(items.size()), want);
  }
  std::unique_ptr<TxRig> rig_;
};

TEST_F(Order, ByIdentifier) {  // FX-CTRL1.LBUF, FX-3.3.c, FX-3.3.e: PRIO bits do not count
  std::mt19937 rng{1};
  for (unsigned round = 0; round < 6; ++round) {
    start(0, 0);
    expect_order(random_items(12, rng), false, false);
  }
}

TEST_F(Order, ByPrioThenIdentifier) {  // FX-MCR.LPRIO_EN, FX-3.3.d, FX-3.3.e
  std::mt19937 rng{2};
  for (unsigned round = 0; round < 6; ++round) {
    start(kMcrLprioEn, 0);
    expect_order(random_items(12, rng), true, false);
  }
}

TEST_F(Order,
       ByIndexWhateverPrioSays) {  // FX-CTRL1.LBUF, FX-3.3.b: LPRIO_EN acts only with LBUF = 0
  std::mt19937 rng{3};
  for (std::uint32_t mcr : {0u, kMcrLprioEn}) {
    start(mcr, reg::kCtrlLbuf);
    expect_order(random_items(12, rng), false, true);
  }
}

TEST_F(Order, PrioIsNotSent) {  // flexcan.md 3.1
  start(kMcrLprioEn, 0);
  rig_->join();
  put({9, 7, {.id = 0x1555, .extended = true, .dlc = 1, .data = {7}}});
  ASSERT_TRUE(rig_->wait_flag(0, 9));
  EXPECT_EQ(mb_frame(rig_->received()), (Frame{0x1555, true, false, 1, {7}}));
}

// FX-3.3.f, FX-3.3.g: a better frame that is written while another waits for the bus goes first.
TEST_F(Order, LateWinnerIsSentFirst) {
  start(kMcrLprioEn, 0);
  rig_->join();
  rig_->occupy(true);
  rig_->watch(1000);
  put({20, 3, {.id = 0x100}});
  rig_->watch(300);
  put({30, 2, {.id = 0x700}});
  rig_->watch(300);
  rig_->occupy(false);
  EXPECT_EQ(sent_order(2), (std::vector<unsigned>{30, 20}));
}

// FX-3.3.f, FX-3.3.g: the CPU activates a buffer that would be next, changes its mind about the
// identifier and activates it again, a transfer later or some. What has stood all the time is
// better now and goes first, at every moment before the start.
TEST(OrderOfTwo, ActivatedAgainWithAWorseIdentifier) {
  TxRig rig{2, RigConfig{}};
  rig.join();
  constexpr unsigned kRewritten = 2, kStands = 40, kPeer = 30;
  for (unsigned pause = 0; pause < 4; ++pause) {
    for (unsigned wait = 0; wait < 80; ++wait) {
      rig.put_tx(1, kPeer, {.id = 0});
      ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kDlc; }, 400));
      rig.put_tx(0, kStands, {.id = 0x200});
      ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kEof; }, 400));
      rig.run(wait);
      const std::uint32_t active = mb_words({.id = 0x300}, 0xC).cs;
      rig.put(0, kRewritten, mb_words({.id = 0x100}, 0x8));
      rig.burst(0,
                {{.address = reg::mb(kRewritten), .write = true, .data = active},
                 {.address = reg::mb(kRewritten, 1), .write = true, .data = 0x300u << 18},
                 {.address = reg::mb(kRewritten), .write = true, .data = active, .pause = pause}});
      ASSERT_TRUE(rig.run_until([&] { return rig.flags(0) != 0; }, 2000));
      ASSERT_EQ(rig.flags(0), 1ull << kStands) << "pause " << pause << ", " << wait << " into EOF";
      ASSERT_TRUE(rig.wait_flag(0, kRewritten));
      for (const unsigned mb : {kStands, kRewritten}) rig.clear_flag(0, mb);
      rig.clear_flag(1, kPeer);
      rig.run(30);
    }
  }
}

// FX-MCR.FEN, FX-3.3.a, flexcan.md section 4: the FIFO and its filters are no buffers, whatever
// they hold.
TEST_F(Order, BuffersOfTheRxFifoAreNotSent) {
  start(reg::kMcrFen, 0);
  rig_->write(0, reg::kCtrl2, reg::ctrl2_rffn(2));
  for (unsigned mb = 6; mb < 16; ++mb) put({mb, 0, {.id = mb}});
  rig_->join();
  EXPECT_EQ(sent_order(10), (std::vector<unsigned>{12, 13, 14, 15}));
}

}  // namespace
}  // namespace vericansim

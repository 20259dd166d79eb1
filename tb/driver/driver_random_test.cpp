// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random calls of the driver on whole cores. The handler comes between any two accesses that no
// lock keeps together, callbacks send, and writes may go out back to back. Each frame has one end,
// and what is told of it is what was on the bus; whatever others send is received once.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>

#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;  // at 1 Mbit/s

struct Way {
  const char *name, *profile;
  verican_tx_order_t order;
  bool abort, fifo, posted;
};

void PrintTo(const Way &way, std::ostream *out) { *out << way.name; }

/// Node 0 is the one that is called; node 1 hears all of it, and both others send. The last two
/// bits of an identifier are those of its node.
class RandomUser {
 public:
  RandomUser(const Way &way, std::uint64_t seed) : bus_{3, core_build(way.profile)}, dice_{seed} {
    verican_config_t &config = bus_[0].config;
    if (way.posted) bus_[0].post_writes();
    behind_ = config.port;
    config.port = {nullptr, &read, &write, &lock, &unlock, this, 0};
    config.callbacks = {&on_sent, nullptr, &on_receive, nullptr, this};
    config.abort = way.abort;
    config.tx_order = way.order;
    config.rx_mode = way.fifo ? VERICAN_RX_FIFO : VERICAN_RX_MAILBOXES;
    config.tx_mailboxes = static_cast<std::uint8_t>(1 + pick(8));
    bus_[0].interrupts = false;  // they come where this says
    for (unsigned n = 0; n < 3; ++n) EXPECT_EQ(bus_[n].up(), VERICAN_OK);
    bus_.run(20 * kBit);
  }
  RandomUser(const RandomUser &) = delete;
  RandomUser &operator=(const RandomUser &) = delete;

  void live(unsigned steps) {
    for (unsigned n = 0; n < steps; ++n) {
      let_others_send();
      act();
      hear();
    }
    pass(30'000 * kBit);
    hear();
  }
  void check() {
    EXPECT_TRUE(in_mailbox_.empty());
    EXPECT_TRUE(early_.empty()) << "an end of no frame";
    EXPECT_GT(ends_.size(), 30u);
    for (const auto &[number, outcome] : ends_) {
      const std::size_t heard = heard_.count(number);
      EXPECT_LE(heard, 1u) << number;
      if (outcome == VERICAN_TX_WITHDRAWN) continue;
      EXPECT_EQ(heard, outcome == VERICAN_TX_SENT ? 1u : 0u) << number << " told as " << outcome;
    }
    for (const std::uint32_t number : expected_) EXPECT_EQ(received_.count(number), 1u) << number;
    EXPECT_EQ(bus_[0].status().stats.rx_overruns, 0u);
  }

 private:
  static RandomUser &self(void *context) { return *static_cast<RandomUser *>(context); }
  static std::uint32_t read(void *context, std::uint32_t offset) {
    self(context).interrupt();
    return self(context).behind_.read32(self(context).behind_.context, offset);
  }
  static void write(void *context, std::uint32_t offset, std::uint32_t value) {
    self(context).interrupt();
    self(context).behind_.write32(self(context).behind_.context, offset, value);
  }
  static std::uint32_t lock(void *context) {
    self(context).interrupt();
    return ++self(context).depth_;
  }
  static void unlock(void *context, std::uint32_t token) {
    EXPECT_EQ(token, self(context).depth_--);
    self(context).interrupt();
  }
  static void on_sent(void *context, verican_t *, const verican_tx_event_t *event) {
    RandomUser &user = self(context);
    const auto of = user.in_mailbox_.find(event->mailbox);
    if (of != user.in_mailbox_.end()) {
      user.ends_[of->second] = event->outcome;
      user.in_mailbox_.erase(of);
    } else {
      user.early_[event->mailbox] = event->outcome;
    }
    if (user.pick(3) == 0) user.send();
  }
  static void on_receive(void *context, verican_t *) {
    if (self(context).pick(8) == 0) self(context).send();
  }

  unsigned pick(unsigned n) { return static_cast<unsigned>(dice_() % n); }
  void interrupt() {
    for (unsigned n = 1; n < 3; ++n) bus_[n].serve();
    if (inside_ || depth_ != 0 || !bus_[0].rtl().irq() || pick(2) == 0) return;
    inside_ = true;
    (void)verican_irq_handler(&bus_[0].dev);
    inside_ = false;
  }
  void pass(Time duration) {
    for (const Time end = bus_.bus.now() + duration; bus_.bus.now() < end; bus_.bus.step())
      interrupt();
  }
  verican_frame_t frame_of(unsigned node) {
    const std::uint32_t number = ++number_ * 4 + node;
    const bool extended = pick(2) == 0;
    verican_frame_t frame = driver_frame((pick(0x1FF) << 2) | node, 8, 0, std::uint64_t{number});
    if (extended) frame.id = (pick(0x7FFFFF) << 2) | node;
    if (extended) frame.flags = VERICAN_FRAME_EXTENDED;
    frame.priority = static_cast<std::uint8_t>(pick(8));
    return frame;
  }
  static std::uint32_t number_of(const verican_frame_t &frame) {
    std::uint32_t number = 0;
    for (unsigned i = 4; i < 8; ++i) number = number << 8 | frame.data[i];
    return number;
  }
  void send() {
    verican_frame_t frame = frame_of(0);
    if (bus_[0].dev.frame_one_shot && pick(5) == 0) frame.flags |= VERICAN_FRAME_ONE_SHOT;
    std::uint8_t mailbox = 0;
    if (verican_send(&bus_[0].dev, &frame, &mailbox) == VERICAN_OK) note(mailbox, number_of(frame));
  }
  // Its end may have been told before the call that sends has returned.
  void note(std::uint8_t mailbox, std::uint32_t number) {
    const auto end = early_.find(mailbox);
    if (end != early_.end()) {
      ends_[number] = end->second;
      early_.erase(end);
      return;
    }
    EXPECT_EQ(in_mailbox_.count(mailbox), 0u) << "two frames in a mailbox";
    in_mailbox_[mailbox] = number;
  }
  void take_back() {
    if (in_mailbox_.empty()) return;
    auto of = in_mailbox_.begin();
    std::advance(of, pick(static_cast<unsigned>(in_mailbox_.size())));
    (void)verican_abort(&bus_[0].dev, of->first);
  }
  [[nodiscard]] bool others_send() {
    std::uint8_t waiting[3] = {};
    for (unsigned n = 1; n < 3; ++n) (void)verican_tx_waiting(&bus_[n].dev, &waiting[n]);
    return waiting[1] + waiting[2] != 0;
  }
  // When the others send nothing that node 0 could miss.
  void restart() {
    while (others_send()) pass(100 * kBit);
    pass(pick(200) * kBit);
    EXPECT_EQ(verican_stop(&bus_[0].dev), VERICAN_OK);
    EXPECT_TRUE(in_mailbox_.empty());
    if (pick(2) == 0) {
      EXPECT_EQ(verican_self_test(&bus_[0].dev, nullptr), VERICAN_OK);
    }
    EXPECT_EQ(verican_start(&bus_[0].dev), VERICAN_OK);
    pass(20 * kBit);
  }
  void act() {
    verican_t *dev = &bus_[0].dev;
    std::uint64_t bits = 0;
    switch (pick(10)) {
      case 0:
      case 1:
      case 2:
      case 3: send(); break;
      case 4:
      case 5: take_back(); break;
      case 6: EXPECT_EQ(verican_poll(dev, 0), VERICAN_OK); break;
      case 7: EXPECT_EQ(verican_time(dev, &bits), VERICAN_OK); break;
      case 8:
        if (pick(8) == 0) restart();
        break;
      default: pass(pick(300) * kBit);
    }
  }
  void let_others_send() {
    for (unsigned n = 1; n < 3; ++n) {
      if (pick(4) != 0) continue;
      const verican_frame_t frame = frame_of(n);
      if (verican_send(&bus_[n].dev, &frame, nullptr) == VERICAN_OK)
        expected_.insert(number_of(frame));
    }
  }
  void hear() {
    for (const verican_frame_t &frame : bus_[0].received()) received_.insert(number_of(frame));
    for (const verican_frame_t &frame : bus_[1].received())
      if (number_of(frame) % 4 == 0) heard_.insert(number_of(frame));
    (void)bus_[2].received();
  }

  DriverBus bus_;
  verican_port_t behind_{};
  std::mt19937_64 dice_;
  std::uint32_t number_ = 0, depth_ = 0;
  bool inside_ = false;
  std::map<std::uint8_t, std::uint32_t> in_mailbox_;  ///< numbers of the frames there
  std::map<std::uint8_t, verican_tx_outcome_t> early_;
  std::map<std::uint32_t, verican_tx_outcome_t> ends_;  ///< by number
  std::multiset<std::uint32_t> heard_, received_;       ///< by node 1; by node 0
  std::set<std::uint32_t> expected_;                    ///< sent by the others
};

class DriverRandom : public ::testing::TestWithParam<Way> {};

TEST_P(DriverRandom, EachFrameHasOneEndAndItIsTrue) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomUser user{GetParam(), seed};
    user.live(250);
    user.check();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, DriverRandom,
    ::testing::Values(Way{"Standard", "standard", VERICAN_TX_BY_ID, false, false, false},
                      Way{"InOrderBackToBack", "standard", VERICAN_TX_IN_ORDER, false, false, true},
                      Way{"AbortByPriority", "standard", VERICAN_TX_BY_PRIORITY, true, false,
                          false},
                      Way{"AbortBackToBack", "full", VERICAN_TX_BY_ID, true, false, true},
                      Way{"Fifo", "full", VERICAN_TX_BY_ID, false, true, false},
                      Way{"FifoAbortInOrder", "full", VERICAN_TX_IN_ORDER, true, true, true}),
    [](const auto &way) { return std::string{way.param.name}; });

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Hard reset at any moment (flexcan.md section 2): what comes after it is, clock by clock, what a
// new core does. The judge is a core that has never done anything.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kWakMsk = 1u << 26, kSlfWak = 1u << 22, kWakSrc = 1u << 19;
constexpr std::uint32_t kLprioEn = 1u << 13, kAen = 1u << 12, kTsyn = 1u << 5;

Frame frame_of(std::mt19937 &random) {
  Frame frame;
  frame.extended = random() % 2 != 0;
  frame.id = static_cast<std::uint32_t>(random()) & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
  frame.dlc = static_cast<std::uint8_t>(random() % 9);
  for (std::uint8_t &byte : frame.data) byte = static_cast<std::uint8_t>(random());
  return frame;
}

/// Configuration of both nodes: with the Rx FIFO, its table and masks open, or without.
RigConfig config_of(bool fifo, std::mt19937 &random) {
  RigConfig config;
  config.mcr |= fifo ? reg::kMcrFen : 0;
  config.mcr |= static_cast<std::uint32_t>(random()) & (kWakMsk | kSlfWak | kWakSrc);
  config.mcr |= static_cast<std::uint32_t>(random()) & (kLprioEn | kAen);
  config.ctrl |= static_cast<std::uint32_t>(random()) & (kTsyn | reg::kCtrlLbuf | 0xCC00u);
  return config;
}

void bring_up(MailboxRig &rig, bool fifo, std::mt19937 &random) {
  for (unsigned n = 0; n < 2; ++n) {
    rig.configure(n, config_of(fifo, random));
    rig.write(n, reg::kCtrl2, static_cast<std::uint32_t>(random()) & (7u << 16));
    rig.write(n, reg::kRxfgmask, 0);
    for (unsigned mb = 0; mb < 16; ++mb) rig.write(n, reg::rximr(mb), 0);
    for (std::uint32_t mask : {reg::kImask1, reg::kImask2}) rig.write(n, mask, 0xFFFFFFFF);
    for (unsigned mb = 8; mb < 11; ++mb) rig.put_rx(n, mb, frame_of(random));
  }
}

/// Some life: frames both ways, errors for want of an acknowledge, buffers locked, reads and writes
/// under way, sleep. It stops anywhere.
void live(MailboxRig &rig, bool fifo, std::mt19937 &random) {
  bring_up(rig, fifo, random);
  rig.go(0);
  if (random() % 4 != 0) rig.go(1);  // else nobody acknowledges
  for (unsigned i = 0, actions = random() % 24; i < actions; ++i) {
    const unsigned n = random() % 2, mb = 8 + random() % 8;
    switch (random() % 8) {
      case 0: rig.read(n, reg::mb(8 + random() % 3)); break;  // locks
      case 1: rig.write(n, reg::mb(mb), 0x9u << 24); break;   // abort, or away
      case 2: rig.run(random() % 1500); break;
      case 3: rig.write(n, reg::kIflag1, 0xFFFFFFFF); break;
      case 4: rig.node(n).request_stop(random() % 2 != 0); break;
      default: rig.put_tx(n, 11 + random() % 5, frame_of(random));
    }
    rig.run(random() % 300);
  }
  for (unsigned n = 0; n < 2; ++n) {
    for (unsigned i = 0, pending = random() % 4; i < pending; ++i)
      rig.node(n).ahb().submit({.address = reg::mb(8 + random() % 8),
                                .write = random() % 2 != 0,
                                .data = static_cast<std::uint32_t>(random())});
  }
  rig.run(random() % 8);
}

/// All that can be seen of the cores in the clocks to come.
class Witness {
 public:
  explicit Witness(MailboxRig &rig) : rig_{rig} {}
  void read(unsigned n, std::uint32_t address) { seen_.push_back(rig_.read(n, address)); }
  void registers() {
    for (unsigned n = 0; n < 2; ++n) {
      for (std::uint32_t address = 0; address < 0x50; address += 4) read(n, address);
      for (std::uint32_t address = 0x1000; address < 0x1010; address += 4) read(n, address);
      for (std::uint32_t address = 0x80; address < 0x180; address += 4) read(n, address);
    }
  }
  void run(unsigned clocks) {
    for (unsigned i = 0; i < clocks; ++i) {
      rig_.run(1);
      for (unsigned n = 0; n < 2; ++n) {
        seen_.push_back(rig_.node(n).trace());
        seen_.push_back(rig_.node(n).irq_lines());
      }
    }
  }
  [[nodiscard]] const std::vector<std::uint64_t> &seen() const { return seen_; }

 private:
  MailboxRig &rig_;
  std::vector<std::uint64_t> seen_;
};

/// Both at once. A dominant level from before stays on the bus for a clock more: no matter of the
/// core's, so it is reset again then.
void reset(MailboxRig &rig) {
  const bool dominant =
      rig.node(0).tx() == Level::kDominant || rig.node(1).tx() == Level::kDominant;
  for (unsigned times = dominant ? 2 : 1; times > 0; --times) {
    for (unsigned n = 0; n < 2; ++n) {
      rig.node(n).request_stop(false);
      rig.node(n).reset();
    }
    if (times > 1) rig.run(1);
  }
}

/// What both cores do after a reset: the same calls, whatever was before.
std::vector<std::uint64_t> afterwards(MailboxRig &rig, bool fifo, unsigned seed) {
  std::mt19937 random{seed};
  Witness witness{rig};
  reset(rig);
  if (random() % 2 != 0) witness.registers();  // before the RAM is cleared
  witness.run(300);                            // behind it
  bring_up(rig, fifo, random);
  for (unsigned n = 0; n < 2; ++n) rig.put_tx(n, 11 + random() % 5, frame_of(random));
  for (unsigned n = 0; n < 2; ++n)
    rig.write(n, reg::kMcr, rig.read(n, reg::kMcr) & ~(reg::kMcrFrz | reg::kMcrHalt));
  witness.run(2500);
  for (unsigned n = 0; n < 2; ++n) rig.node(n).request_stop(true);
  witness.run(100);
  for (unsigned n = 0; n < 2; ++n) rig.node(n).request_stop(false);
  witness.run(20);
  witness.registers();
  return witness.seen();
}

class HardReset : public ::testing::TestWithParam<unsigned> {};

TEST_P(HardReset, CoreIsLikeNewWhateverItWasDoing) {
  const unsigned block = GetParam();
  for (unsigned seed = 12 * block; seed < 12 * block + 12; ++seed) {
    std::mt19937 random{seed};
    const bool fifo = random() % 2 != 0;
    MailboxRig used{2, 16}, fresh{2, 16};
    live(used, random() % 2 != 0, random);
    const auto now = afterwards(used, fifo, seed), expected = afterwards(fresh, fifo, seed);
    ASSERT_EQ(now.size(), expected.size()) << "seed " << seed;
    for (std::size_t i = 0; i < now.size(); ++i)
      ASSERT_EQ(now[i], expected[i]) << "seed " << seed << ", observation " << i;
  }
}

// Pulses that last for a clock, RO-05: none of them is left over.
TEST(HardResetMoment, InTheClockInWhichAFrameIsAccepted) {
  std::mt19937 random{3};
  MailboxRig used{2, 16}, fresh{2, 16};
  bring_up(used, false, random);
  for (unsigned n = 0; n < 2; ++n) used.go(n);
  used.put_tx(0, 12, {.id = 0x123});
  ASSERT_TRUE(used.run_until([&] { return decode_trace(used.node(1).trace()).rx_valid; }, 4000));
  EXPECT_EQ(afterwards(used, false, 5), afterwards(fresh, false, 5));
}

INSTANTIATE_TEST_SUITE_P(Lives, HardReset, ::testing::Range(0u, 8u));

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_time_regs alone against the register table (docs/time-spec.md, section 6), clock by clock:
// TM-03, TM-11 to TM-16, TM-30 to TM-32, TM-40.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "Vcan_time_regs.h"
#include "Vcan_time_regs___024root.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

// Registers, as words of the page; bits of TSTAT and TCTRL.
constexpr unsigned kTcap = 0, kTctrl = 1, kTstat = 2, kTimelo = 4, kTimehi = 5, kTincn = 6,
                   kTincf = 7, kTshlo = 8, kTshhi = 9, kTslew = 10, kTcmp = 12, kTcmph = 13,
                   kTtx = 16, kTtxmb = 17, kTextlo = 20, kTexthi = 21;
constexpr std::uint32_t kTctrlBits = 0x001F3337;
constexpr unsigned kExt = 0, kExtovr = 1, kCmp = 2, kSlewd = 3, kTxrel = 4, kSync = 5;
constexpr unsigned kCmpen = 13, kOuten = 12, kExtr = 8, kExtf = 9;
// Commands to can_time and what it tells (rtl/can_pkg.sv).
constexpr unsigned kDoSet = 0, kDoShift = 1, kDoRate = 2, kDoSlew = 3, kDoArm = 4, kDoHold = 5,
                   kDoRelease = 6, kDoExt = 7, kDoRead = 8;
constexpr unsigned kSlewing = 0, kHeld = 1, kOut = 2, kArmed = 3, kMatch = 4, kSlewed = 5,
                   kLaunch = 6, kChanged = 7;

constexpr unsigned bit(std::uint32_t word, unsigned n) { return (word >> n) & 1; }

/// Inputs of one clock.
struct Inputs {
  bool ask = false, rd = false, wr = false, pin = false;
  unsigned address = 0, lanes = 15, stat = 0;
  std::uint32_t data = 0, left = 0;
  std::uint64_t now = 0, ext = 0;
};

/// The registers by their table.
class RegisterModel {
 public:
  std::uint32_t tctrl = 0x31, tcmph = 0, ttx = 0;
  unsigned mb = 0, flags = 0, command = 0;
  std::uint64_t data = 0;

  /// What a read returns.
  [[nodiscard]] std::uint32_t read(const Inputs &in) const {
    switch (in.address) {
      case kTcap: return 0x00020003;
      case kTctrl: return tctrl;
      case kTstat:
        return flags | slewing(in) << 16 | held(in) << 17 | out(in) << 18 | armed(in) << 19;
      case kTimelo: return static_cast<std::uint32_t>(in.now);
      case kTimehi: return static_cast<std::uint32_t>(in.now >> 32);
      case kTslew: return in.left;
      case kTtxmb: return held(in) << 31 | mb;
      case kTextlo: return static_cast<std::uint32_t>(in.ext);
      case kTexthi: return static_cast<std::uint32_t>(in.ext >> 32);
      default: return 0;
    }
  }
  /// HOLD reads as written, although what holds and releases hears of it a clock later.
  [[nodiscard]] unsigned held(const Inputs &in) const {
    if (bit(command, kDoHold) != 0) return 1;
    return bit(command, kDoRelease) != 0 ? 0 : bit(in.stat, kHeld);
  }
  /// So do SLEWING, which is told two clocks behind the command, OUT and CMPON.
  [[nodiscard]] unsigned slewing(const Inputs &in) const {
    return bit(in.stat, kSlewing) | bit(command, kDoSlew) | bit(before_, kDoSlew);
  }
  [[nodiscard]] unsigned armed(const Inputs &in) const {
    return (bit(in.stat, kArmed) | bit(command, kDoArm)) & bit(tctrl, kCmpen);
  }
  [[nodiscard]] unsigned out(const Inputs &in) const {
    return bit(in.stat, kOut) & ~(bit(command, kDoArm) & bit(tctrl, kCmpen));
  }
  /// An edge of the pin that is asked for, at the output of the synchroniser.
  [[nodiscard]] bool edge() const {
    return (pin_[1] && !pin_[2] && bit(tctrl, kExtr)) || (!pin_[1] && pin_[2] && bit(tctrl, kExtf));
  }
  [[nodiscard]] bool capture() const { return edge() && bit(flags, kExt) == 0; }
  [[nodiscard]] bool interrupt() const {
    const unsigned enables = tctrl >> 16;  // EXTIE, CMPIE, SLEWIE, TXIE, SYNCIE
    const unsigned events = bit(flags, kExt) | bit(flags, kCmp) << 1 | bit(flags, kSlewd) << 2 |
                            bit(flags, kTxrel) << 3 | bit(flags, kSync) << 4;
    return (enables & events & 0x1F) != 0;
  }
  void clock(const Inputs &in) {
    const bool event = edge(), taken = capture();
    const std::uint32_t told = bit(in.stat, kMatch) << kCmp | bit(in.stat, kSlewed) << kSlewd |
                               bit(in.stat, kLaunch) << kTxrel | bit(in.stat, kChanged) << kSync;
    if (in.wr && in.address == kTstat && (in.lanes & 1) != 0) flags &= ~in.data;
    flags |= told | (taken ? 1U << kExt : 0) | (event && !taken ? 1U << kExtovr : 0);
    pin_[2] = pin_[1];
    pin_[1] = pin_[0];
    pin_[0] = in.pin;
    before_ = command;
    command = 0;
    if (!in.wr) return;
    if (in.address == kTctrl)
      for (unsigned lane = 0; lane < 4; ++lane)
        if (bit(in.lanes, lane)) write_byte(lane, in.data);
    if (in.lanes == 15) write_word(in);
  }

 private:
  void write_byte(unsigned lane, std::uint32_t value) {
    const std::uint32_t mask = 0xFFU << (8 * lane);
    tctrl = (tctrl & ~mask) | (value & mask & kTctrlBits);
  }
  void write_word(const Inputs &in) {
    switch (in.address) {
      case kTimelo:
      case kTincn:
      case kTshlo: first_ = in.data; break;
      case kTimehi: give(kDoSet, in.data); break;
      case kTincf: give(kDoRate, in.data); break;
      case kTshhi: give(kDoShift, in.data); break;
      case kTslew: give(kDoSlew, in.data); break;
      case kTcmp: give(kDoArm, in.data); break;
      case kTcmph: tcmph = in.data & 0x7FFFFFFF; break;
      case kTtx: ttx = in.data; break;
      case kTtxmb:
        mb = in.data & 0x3F;
        give(bit(in.data, 31) != 0 ? kDoHold : kDoRelease, in.data);
        break;
      default: break;
    }
  }
  void give(unsigned what, std::uint32_t second) {
    command = 1U << what;
    data = std::uint64_t{second} << 32 | first_;
  }

  std::uint32_t first_ = 0;
  unsigned before_ = 0;  // command of the clock before
  bool pin_[3] = {};
};

/// The module and the model side by side.
class CanTimeRegs : public testing::Test {
 protected:
  void SetUp() override { rtl_.reset(); }
  void clock(const Inputs &in) {
    rtl_->ask_i = in.ask;
    rtl_->rd_i = in.rd;
    rtl_->wr_i = in.wr;
    rtl_->pin_i = in.pin;
    rtl_->addr_i = static_cast<std::uint8_t>(in.address);
    rtl_->be_i = static_cast<std::uint8_t>(in.lanes);
    rtl_->stat_i = static_cast<std::uint8_t>(in.stat);
    rtl_->wdata_i = in.data;
    rtl_->left_i = in.left;
    rtl_->now_i = in.now;
    rtl_->ext_i = in.ext;
    rtl_.settle();
    compare(in);
    rtl_.clock();
    model_.clock(in);
  }
  void compare(const Inputs &in) {
    const unsigned commands =
        model_.command | (in.ask ? 1U << kDoRead : 0) | (model_.capture() ? 1U << kDoExt : 0);
    ASSERT_EQ(rtl_->cmd_o, commands);
    if (model_.command != 0) {
      ASSERT_EQ(rtl_->data_o >> 32, model_.data >> 32);
      // The second word alone where there is no first.
      const bool pair = (model_.command & (1U << kDoSet | 1U << kDoRate | 1U << kDoShift)) != 0;
      if (pair) {
        ASSERT_EQ(rtl_->data_o, model_.data);
      }
    }
    ASSERT_EQ(rtl_->rdata_o, in.rd ? model_.read(in) : 0u) << in.address;
    ASSERT_EQ(rtl_->tctrl_o, model_.tctrl);
    ASSERT_EQ(rtl_->tcmph_o, model_.tcmph);
    ASSERT_EQ(rtl_->ttx_o, model_.ttx);
    ASSERT_EQ(rtl_->mb_o, model_.mb);
    ASSERT_EQ(rtl_->irq_o, model_.interrupt());
    ASSERT_EQ(rtl_->time_out_o, bit(in.stat, kOut) != 0 && bit(model_.tctrl, kOuten) != 0);
  }
  Inputs some() {
    Inputs in{.pin = pin_, .left = word(), .now = wide(), .ext = wide()};
    if (random_() % 8 == 0) pin_ = !pin_;
    in.stat = static_cast<unsigned>(random_()) & 0x0F;
    if (random_() % 16 == 0) in.stat |= 1U << (kMatch + random_() % 4);
    in.ask = random_() % 4 == 0;
    in.address = static_cast<unsigned>(random_() % 32);
    in.data = word();
    if (random_() % 3 == 0) in.lanes = static_cast<unsigned>(random_() % 16);
    if (random_() % 4 == 0) in.address = random_() % 2 == 0 ? kTstat : kTctrl;
    in.wr = random_() % 3 == 0;
    in.rd = !in.wr && random_() % 2 == 0;
    ++(in.wr ? writes_ : in.rd ? reads_ : idle_);
    return in;
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(random_()); }
  std::uint64_t wide() { return std::uint64_t{word()} << 32 | word(); }

  LeafModel<Vcan_time_regs> rtl_;
  RegisterModel model_;
  std::mt19937 random_{32};
  bool pin_ = false;
  unsigned writes_ = 0, reads_ = 0, idle_ = 0;
};

// Random reads and writes of all widths, events and edges of the pin: what is read, the commands,
// flags and interrupt in every clock.
TEST_F(CanTimeRegs, AgainstTheTable) {
  for (unsigned i = 0; i < 300000 && !HasFatalFailure(); ++i) clock(some());
  EXPECT_GT(writes_, 50000u);
  EXPECT_GT(reads_, 50000u);
}

// TM-32: an edge that is not asked for is none, at either level.
TEST_F(CanTimeRegs, EdgesThatAreAskedFor) {
  for (unsigned edges = 0; edges < 4; ++edges) {
    clock({.wr = true, .address = kTctrl, .data = edges << kExtr});
    for (unsigned i = 0; i < 40 && !HasFatalFailure(); ++i) {
      clock({.rd = true, .pin = i >= 10 && i < 25, .address = kTstat});
      if (i % 5 == 4) clock({.wr = true, .pin = i >= 10 && i < 25, .address = kTstat, .data = 3});
    }
  }
}

// TM-03: a hard reset brings back every register, whatever was in them.
TEST_F(CanTimeRegs, HardReset) {
  for (unsigned again = 0; again < 200 && !HasFatalFailure(); ++again) {
    for (unsigned i = 0; i < 60; ++i) clock(some());
    rtl_->wr_i = rtl_->rd_i = rtl_->ask_i = rtl_->pin_i = 0;
    rtl_->stat_i = 0;
    rtl_.reset();
    model_ = {};
    pin_ = false;
    clock({});
  }
}

}  // namespace
}  // namespace vericansim

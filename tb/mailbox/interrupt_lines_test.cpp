// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Interrupt lines, row by row: condition, mask, level, OR (flexcan.md section 5).
#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBit = 8;  // clocks
constexpr Time kClock = 125 * kNanosecond;
constexpr std::uint32_t kWakMsk = 1u << 26, kSlfWak = 1u << 22;

// A line, the flag behind it and its mask: register, bit.
struct Row {
  const char *name;
  IrqLine line;
  std::uint32_t flag_at, flag;
  std::uint32_t mask_at, mask;
};
constexpr Row kRows[] = {
    {"Mb", kIrqMb, reg::kIflag1, 1u << 8, reg::kImask1, 1u << 8},
    {"BusOff", kIrqBusOff, reg::kEsr, 1u << 2, reg::kCtrl, 1u << 15},
    {"Error", kIrqError, reg::kEsr, 1u << 1, reg::kCtrl, 1u << 14},
    {"TxWarning", kIrqTxWarning, reg::kEsr, 1u << 17, reg::kCtrl, 1u << 11},
    {"RxWarning", kIrqRxWarning, reg::kEsr, 1u << 16, reg::kCtrl, 1u << 10},
    {"WakeUp", kIrqWake, reg::kEsr, 1u << 0, reg::kMcr, kWakMsk},
};

// Node 0 with every flag set and every mask 0.
class InterruptLines : public ::testing::TestWithParam<Row> {
 protected:
  InterruptLines() : rig_{2, 16} {
    for (unsigned n = 0; n < 2; ++n) rig_.configure(n);
    set_counters(0, 0);
    for (unsigned n = 0; n < 2; ++n) rig_.go(n);
    send_a_frame();
    wake_up();
    warn_receiver();
    go_bus_off();
    rig_.run(100 * kBit);
  }
  void set_counters(unsigned tec, unsigned rec) { rig_.write(0, reg::kEcr, rec << 8 | tec); }
  void send_a_frame() {
    rig_.put_tx(0, 8, {.id = 0x155});
    EXPECT_TRUE(rig_.wait_flag(0, 8));
    rig_.run(12 * kBit);
  }
  void dominant(Time from, Time clocks) { level(Effect::kDominant, from, clocks); }
  void level(Effect effect, Time from, Time clocks) {
    const Time now = rig_.bus().now();
    faults_.push_back(std::make_unique<LevelFault>(
        0, effect, Window{now + from * kClock, now + (from + clocks) * kClock}));
    rig_.bus().add(*faults_.back());
  }
  void wake_up() {
    rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) | kSlfWak);
    rig_.node(0).request_stop(true);
    rig_.run(2 * kBit);
    dominant(1, 1);
    rig_.run(4);
    rig_.node(0).request_stop(false);
    rig_.run(20 * kBit);
  }
  // REC from 95 to 96: a receiver's error, six dominant bits out of nothing.
  void warn_receiver() {
    ASSERT_TRUE(rig_.freeze(0));
    set_counters(0, 95);
    rig_.go(0);
    dominant(1, 7 * kBit);
    rig_.run(40 * kBit);
  }
  // TEC from 95 over 96 to bus-off: it hears recessive only.
  void go_bus_off() {
    ASSERT_TRUE(rig_.freeze(0));
    set_counters(95, 0);
    rig_.go(0);
    level(Effect::kRecessive, 1, 4000);
    rig_.put_tx(0, 9, {.id = 0x155});
    ASSERT_TRUE(rig_.run_until([&] { return rig_.field(0) == Field::kBusOff; }, 4000));
  }
  std::uint8_t lines() {
    rig_.run(3);
    return rig_.node(0).irq_lines();
  }
  void set(std::uint32_t at, std::uint32_t bits) { rig_.write(0, at, rig_.read(0, at) | bits); }
  void clear(std::uint32_t at, std::uint32_t bits) { rig_.write(0, at, rig_.read(0, at) & ~bits); }
  std::vector<std::unique_ptr<Fault>> faults_;
  MailboxRig rig_;
};

// FX-5.MB, FX-5.BOFF, FX-5.ERR, FX-5.TWRN, FX-5.RWRN, FX-5.WAKE, FX-5.ALL: with every flag set, a
// mask raises its line, the OR, and no other line.
TEST_P(InterruptLines, MaskOpensItsLineAndNoOther) {
  const Row &row = GetParam();
  ASSERT_EQ(rig_.read(0, row.flag_at) & row.flag, row.flag);
  EXPECT_EQ(lines(), 0);
  set(row.mask_at, row.mask);
  EXPECT_EQ(lines(), kIrqAll | row.line);
  rig_.run(1000);
  EXPECT_EQ(lines(), kIrqAll | row.line) << "held";
  clear(row.mask_at, row.mask);
  EXPECT_EQ(lines(), 0);
  EXPECT_EQ(rig_.read(0, row.flag_at) & row.flag, row.flag) << "a mask clears nothing";
}

// With every mask open a line falls with its flag, and takes no other with it.
TEST_P(InterruptLines, FlagHoldsItsLineAndNoOther) {
  constexpr std::uint8_t kEvery =
      kIrqAll | kIrqMb | kIrqBusOff | kIrqError | kIrqTxWarning | kIrqRxWarning | kIrqWake;
  for (const Row &row : kRows) set(row.mask_at, row.mask);
  EXPECT_EQ(lines(), kEvery);
  const Row &row = GetParam();
  rig_.write(0, row.flag_at, row.flag_at == reg::kEsr ? reg::kEsrInterrupts & ~row.flag : 0);
  rig_.write(0, row.flag_at, 0);
  for (const Row &other : kRows)
    if (other.flag_at == reg::kEsr && row.flag_at == reg::kEsr && other.line != row.line) {
      EXPECT_EQ(rig_.read(0, reg::kEsr) & other.flag, other.line == kIrqWake ? other.flag : 0u);
    }
  EXPECT_NE(lines() & row.line, 0) << "writing 0, or other bits, leaves it";
  const std::uint8_t before = lines();
  rig_.write(0, row.flag_at, row.flag);
  const std::uint8_t left = before & ~row.line;
  EXPECT_EQ(lines(), left == kIrqAll ? 0 : left);
}

// A byte clears flags of its own lane, whatever stands on the other lanes (ones here: the master
// drives the complement there).
TEST_P(InterruptLines, AByteClearsFlagsInItsOwnLaneOnly) {
  const Row &row = GetParam();
  const auto flag_lane = static_cast<unsigned>(std::countr_zero(row.flag)) / 8;
  const auto put_byte = [&](unsigned lane, std::uint32_t data) {
    rig_.access(0, {.address = row.flag_at + lane,
                    .write = true,
                    .size = AhbSize::kByte,
                    .data = data & 0xFF});
  };
  for (unsigned lane = 0; lane < 4; ++lane) put_byte(lane, 0);
  EXPECT_EQ(rig_.read(0, row.flag_at) & row.flag, row.flag);
  put_byte(flag_lane, row.flag >> (8 * flag_lane));
  EXPECT_EQ(rig_.read(0, row.flag_at) & row.flag, 0u);
}

// The OR is high as long as any line is.
TEST_P(InterruptLines, TheOrFallsWithTheLastLine) {
  for (const Row &row : kRows) set(row.mask_at, row.mask);
  for (const Row &row : kRows)
    if (row.line != GetParam().line) rig_.write(0, row.flag_at, row.flag);
  EXPECT_EQ(lines(), kIrqAll | GetParam().line);
  rig_.write(0, GetParam().flag_at, GetParam().flag);
  EXPECT_EQ(lines(), 0);
}

// FX-2.3.b: a soft reset takes every line down.
TEST_P(InterruptLines, SoftResetClearsTheFlag) {
  set(GetParam().mask_at, GetParam().mask);
  EXPECT_NE(lines(), 0);
  rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
  rig_.run(3 * kBit);
  EXPECT_EQ(lines(), 0);
  EXPECT_EQ(rig_.read(0, GetParam().flag_at) & GetParam().flag, 0u);
}

INSTANTIATE_TEST_SUITE_P(Rows, InterruptLines, ::testing::ValuesIn(kRows),
                         [](const auto &each) { return each.param.name; });

// FX-5.MB: each buffer of a 16 buffer core, by its own mask bit (64 buffers: can_events_test).
TEST(BufferLine, EachBufferByItsMask) {
  MailboxRig rig{2, 16};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n);
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  for (unsigned mb = 0; mb < 16; ++mb) {
    rig.put_tx(0, mb, {.id = 0x100 + mb});
    ASSERT_TRUE(rig.wait_flag(0, mb));
  }
  for (unsigned mb = 0; mb < 16; ++mb) {
    rig.write(0, reg::kImask1, 1u << mb);
    rig.run(3);
    EXPECT_EQ(rig.node(0).irq_lines(), kIrqAll | kIrqMb);
    rig.clear_flag(0, mb);
    rig.run(3);
    EXPECT_EQ(rig.node(0).irq_lines(), 0) << mb;
  }
}

// FX-5.a: clearing the flag of a locked buffer leaves the lock, and of an unread one leaves it
// unread.
TEST(BufferLine, ClearingTheFlagNeitherUnlocksNorServices) {
  MailboxRig rig{2, 16};
  for (unsigned n = 0; n < 2; ++n) {
    rig.configure(n);
    rig.put_rx(n, 3, {.id = 0x155}, 0);
  }
  for (unsigned n = 0; n < 2; ++n) rig.go(n);
  const auto send = [&](std::uint8_t data) {
    rig.put_tx(1, 8, {.id = 0x155, .dlc = 1, .data = {data}});
    ASSERT_TRUE(rig.wait_flag(1, 8));
    rig.clear_flag(1, 8);
    rig.run(12 * kBit);
  };
  send(1);
  EXPECT_EQ(rig.flags(0), 1u << 3);
  EXPECT_EQ(rig.get(0, 3).code(), 2u);  // locks
  rig.clear_flag(0, 3);
  send(2);
  EXPECT_EQ(rig.flags(0), 0u) << "still locked";
  EXPECT_EQ(rig.get(0, 3).low >> 24, 1u);
  rig.read(0, reg::kTimer);
  rig.run(20);
  EXPECT_EQ(rig.flags(0), 1u << 3);
  rig.clear_flag(0, 3);
  send(3);
  EXPECT_EQ(rig.get(0, 3).code(), 6u) << "the second was not read";
}

}  // namespace
}  // namespace vericansim

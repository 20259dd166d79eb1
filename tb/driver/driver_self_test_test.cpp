// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver's self-test: passes on the core, leaves no trace, and finds what is broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "driver/driver_node.hpp"
#include "driver/fake_core.hpp"

namespace vericansim {
namespace {

TEST(DriverSelfTest, PassesWithIdlePinsAndLeavesTheConfigurationAlone) {
  DriverBus bus{2};
  for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(verican_init(&bus[n].dev, &bus[n].config), VERICAN_OK);
  ASSERT_EQ(verican_start(&bus[1].dev), VERICAN_OK);
  const auto registers = [&] {
    std::vector<std::uint32_t> words;
    for (const std::uint32_t offset : {0x000u, 0x004u, 0x034u, 0x880u, 0x884u})
      words.push_back(bus[0].rtl().read32(offset));
    for (std::uint32_t offset = 0x80; offset < 0x480; offset += 4)
      words.push_back(bus[0].rtl().read32(offset));
    return words;
  };
  const auto before = registers();
  verican_test_report_t report{};
  EXPECT_EQ(verican_self_test(&bus[0].dev, &report), VERICAN_OK);
  EXPECT_EQ(report.step, VERICAN_TEST_PASSED);
  EXPECT_EQ(registers(), before);
  EXPECT_EQ(verican_self_test(&bus[0].dev, nullptr), VERICAN_OK);
  bus.run(100 * kMicrosecond);
  EXPECT_TRUE(bus[1].received().empty());
  EXPECT_EQ(bus[1].status().rec, 0);

  // Afterwards the device works as before.
  ASSERT_EQ(verican_start(&bus[0].dev), VERICAN_OK);
  const verican_frame_t frame = driver_frame(0x123);
  for (unsigned n = 0; n < 2; ++n) {
    ASSERT_EQ(verican_send(&bus[n].dev, &frame, nullptr), VERICAN_OK);
    ASSERT_TRUE(bus.run_until([&] { return !bus[n].events.empty(); }));
    bus.run(50 * kMicrosecond);
    EXPECT_EQ(bus[1 - n].received().size(), 1u);
    EXPECT_TRUE(bus[n].received().empty());
  }
}

// Sends these frames, which the other node's handler finds in its first mailboxes, none overrun.
void fill_first_mailboxes(DriverBus &bus, std::initializer_list<std::uint32_t> ids) {
  bus[0].events.clear();
  bus[1].interrupts = false;
  for (const std::uint32_t id : ids) {
    const verican_frame_t frame = driver_frame(id);
    ASSERT_EQ(verican_send(&bus[0].dev, &frame, nullptr), VERICAN_OK);
  }
  ASSERT_TRUE(bus.run_until([&] { return bus[0].events.size() == ids.size(); }));
  bus.run(50 * kMicrosecond);
  ASSERT_EQ(verican_irq_handler(&bus[1].dev), VERICAN_OK);
  const auto frames = bus[1].received();
  ASSERT_EQ(frames.size(), ids.size());
  for (unsigned n = 0; n < frames.size(); ++n) {
    EXPECT_EQ(frames[n].source, n);
    EXPECT_EQ(frames[n].flags & VERICAN_FRAME_OVERRUN, 0u) << n;
  }
}

// A mailbox whose frame has been read takes the next one (flexcan.md 3.5, 3.6). Without masks of
// their own the first takes all.
TEST(DriverSelfTest, MailboxesThatHaveBeenReadAreAsFreeAsBefore) {
  for (const char *profile : {"full", "small"}) {
    SCOPED_TRACE(profile);
    const bool queues = profile[0] == 'f';
    DriverBus bus{2, core_build(profile)};
    for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(bus[n].up(), VERICAN_OK);
    bus.run(20 * kMicrosecond);
    queues ? fill_first_mailboxes(bus, {1, 2}) : fill_first_mailboxes(bus, {1});
    ASSERT_EQ(verican_stop(&bus[1].dev), VERICAN_OK);
    EXPECT_EQ(verican_self_test(&bus[1].dev, nullptr), VERICAN_OK);
    ASSERT_EQ(verican_start(&bus[1].dev), VERICAN_OK);
    bus.run(20 * kMicrosecond);
    queues ? fill_first_mailboxes(bus, {3, 4, 5}) : fill_first_mailboxes(bus, {3});
  }
}

TEST(DriverSelfTest, KeepsTheFiltersOfTheFifo) {
  DriverBus bus{2};
  bus[1].config.rx_mode = VERICAN_RX_FIFO;
  for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(verican_init(&bus[n].dev, &bus[n].config), VERICAN_OK);
  const verican_filter_t only{0x123, 0x7FF, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_ONLY_0};
  ASSERT_EQ(verican_set_filters(&bus[1].dev, &only, 1), VERICAN_OK);
  EXPECT_EQ(verican_self_test(&bus[1].dev, nullptr), VERICAN_OK);
  for (unsigned n = 0; n < 2; ++n) ASSERT_EQ(verican_start(&bus[n].dev), VERICAN_OK);
  bus.run(20 * kMicrosecond);
  for (const std::uint32_t id : {0x122u, 0x123u, 0x124u}) {
    const verican_frame_t frame = driver_frame(id);
    ASSERT_EQ(verican_send(&bus[0].dev, &frame, nullptr), VERICAN_OK);
  }
  ASSERT_TRUE(bus.run_until([&] { return bus[0].events.size() == 3; }));
  bus.run(50 * kMicrosecond);
  const auto frames = bus[1].received();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].id, 0x123u);
}

// A core of plain memory that loops frames back from mailbox 1 to mailbox 0, with a fault.
class BrokenCore : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
    core_.on_write = [this](std::uint32_t offset, std::uint32_t value) {
      if (offset != VERICAN_MB_CS_OFFSET(1) || (value >> 24 & 0xF) != 0xC) return;
      core_.word(VERICAN_MB_CS_OFFSET(0)) = (value & 0x00FF0000) | 0x02000000;
      core_.word(VERICAN_MB_CS_OFFSET(0)) ^= cs_fault_;
      for (unsigned word = 4; word < 16; word += 4)
        core_.word(0x80 + word) = core_.word(0x90 + word) ^ (word == faulty_ ? 0x00400000 : 0);
      if (answers_) back_ = std::max(core_.reads, recovered_) + frame_;
    };
    core_.on_read = [this](std::uint32_t) {
      if (core_.reads >= recovered_) core_.word(VERICAN_ESR1_OFFSET) = 0;
      if (back_ == 0 || core_.reads < back_) return;
      core_.word(VERICAN_IFLAG1_OFFSET) |= 3;
      back_ = 0;
    };
  }
  // A slow bus and a processor so fast that it reads a register in each clock of the core; a frame
  // has up to 160 bits with stuff bits and intermission.
  void be_slow() {
    config_.bitrate = 5'000;
    config_.port.poll_limit = 0;
    ASSERT_EQ(verican_init(&dev_, &config_), VERICAN_OK);
    frame_ = 160 * bit();
  }
  [[nodiscard]] unsigned bit() const { return config_.clock_hz / config_.bitrate; }
  verican_test_report_t run(verican_result_t expected) {
    verican_test_report_t report{};
    EXPECT_EQ(verican_self_test(&dev_, &report), expected);
    return report;
  }

  FakeCore core_;
  verican_config_t config_ = core_.config();
  verican_t dev_{};
  std::uint32_t cs_fault_ = 0;
  unsigned faulty_ = 0;
  bool answers_ = true;
  unsigned frame_ = 0;      ///< reads that a frame lasts
  unsigned recovered_ = 0;  ///< reads until the end of bus-off

 private:
  unsigned back_ = 0;  ///< reads until the frame is back, 0: there is none
};

TEST_F(BrokenCore, PassesWithoutAFault) { EXPECT_EQ(run(VERICAN_OK).step, VERICAN_TEST_PASSED); }

TEST_F(BrokenCore, PassesAtASlowBitRate) {
  be_slow();
  EXPECT_EQ(run(VERICAN_OK).step, VERICAN_TEST_PASSED);
}

TEST_F(BrokenCore, PassesInALongBusOff) {  // BO-02
  be_slow();
  core_.word(VERICAN_ESR1_OFFSET) = VERICAN_ESR1_FLT_CONF_SET(VERICAN_ESR1_FLT_CONF_BUS_OFF);
  recovered_ = core_.reads + 128 * 11 * bit();
  EXPECT_EQ(run(VERICAN_OK).step, VERICAN_TEST_PASSED);
}

TEST_F(BrokenCore, AStuckBitInTheMemoryIsFound) {
  core_.lossy = VERICAN_MB_DATA0_OFFSET(17);
  core_.lost_bits = 0x1000;
  const verican_test_report_t report = run(VERICAN_ERR_SELF_TEST);
  EXPECT_EQ(report.step, VERICAN_TEST_MEMORY);
  EXPECT_EQ(report.where, VERICAN_MB_DATA0_OFFSET(17));
  EXPECT_EQ(report.expected ^ report.found, 0x1000u);
}

TEST_F(BrokenCore, AFrameThatDoesNotComeBackIsFound) {
  answers_ = false;
  const verican_test_report_t report = run(VERICAN_ERR_SELF_TEST);
  EXPECT_EQ(report.step, VERICAN_TEST_LOOP_BACK);
  EXPECT_EQ(report.where, 0u);
  EXPECT_EQ(report.expected, 3u);
  EXPECT_EQ(report.found, 0u);
}

TEST_F(BrokenCore, AChangedIdentifierIsFound) {
  faulty_ = 4;
  EXPECT_EQ(run(VERICAN_ERR_SELF_TEST).step, VERICAN_TEST_FRAME);
}

TEST_F(BrokenCore, AChangedLengthIsFound) {
  cs_fault_ = 0x00040000;
  EXPECT_EQ(run(VERICAN_ERR_SELF_TEST).step, VERICAN_TEST_FRAME);
}

TEST_F(BrokenCore, ChangedDataIsFoundInTheFirstFrameThatHasThem) {
  faulty_ = 12;
  const verican_test_report_t report = run(VERICAN_ERR_SELF_TEST);
  EXPECT_EQ(report.step, VERICAN_TEST_FRAME);
  EXPECT_EQ(report.where, 6u) << "bit 22 of the second word is in byte 5, frames grow by a byte";
  EXPECT_EQ(report.expected ^ report.found, 0x40u);
}

}  // namespace
}  // namespace vericansim

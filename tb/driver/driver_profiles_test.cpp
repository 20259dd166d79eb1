// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver on cores without some features (PK-42, PK-49): what is missing it refuses, and the
// rest works as on any core.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "driver/driver_node.hpp"

namespace vericansim {
namespace {

constexpr unsigned kData = 0, kExt = VERICAN_FRAME_EXTENDED, kRemote = VERICAN_FRAME_REMOTE;

// ---- What a profile refuses

struct Wish {
  const char *name;
  bool small, standard;  // whether the profile has it
  std::function<void(verican_config_t &)> make;
};

void PrintTo(const Wish &wish, std::ostream *out) { *out << wish.name; }

class Refusals : public ::testing::TestWithParam<Wish> {};

verican_result_t init(const char *profile, const Wish &wish) {
  DriverNode node{"node", {}, core_build(profile)};
  wish.make(node.config);
  return verican_init(&node.dev, &node.config);
}

TEST_P(Refusals, WhatIsMissingIsNotSupported) {
  const auto expected = [](bool has) { return has ? VERICAN_OK : VERICAN_ERR_UNSUPPORTED; };
  EXPECT_EQ(init("small", GetParam()), expected(GetParam().small));
  EXPECT_EQ(init("standard", GetParam()), expected(GetParam().standard));
  EXPECT_EQ(init("full", GetParam()), VERICAN_OK);
}

INSTANTIATE_TEST_SUITE_P(
    Wishes, Refusals,
    ::testing::Values(
        Wish{"Nothing", true, true, [](verican_config_t &) {}},
        Wish{"Fifo", false, false, [](verican_config_t &c) { c.rx_mode = VERICAN_RX_FIFO; }},
        Wish{"Abort", false, true, [](verican_config_t &c) { c.abort = true; }},
        Wish{"Priorities", false, true,
             [](verican_config_t &c) { c.tx_order = VERICAN_TX_BY_PRIORITY; }},
        Wish{"InOrder", false, true, [](verican_config_t &c) { c.tx_order = VERICAN_TX_IN_ORDER; }},
        Wish{"OneShot", false, true, [](verican_config_t &c) { c.one_shot = true; }},
        Wish{"FdTolerance", false, true, [](verican_config_t &c) { c.fd_tolerant = true; }}),
    [](const auto &test) { return std::string{test.param.name}; });

// ---- What the smallest profile does

class SmallDriver : public ::testing::Test {
 protected:
  void up() {
    ASSERT_EQ(bus_[0].up(), VERICAN_OK);
    ASSERT_EQ(bus_[1].up(), VERICAN_OK);
    bus_.run(20 * kMicrosecond);
  }
  // Sends a frame; whether the other node receives it, as it was.
  bool arrives(const verican_frame_t &frame) {
    EXPECT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK);
    const std::size_t sent = bus_[0].events.size() + 1;
    EXPECT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == sent; }));
    bus_.run(20 * kMicrosecond);
    const auto got = bus_[1].received();
    if (got.empty()) return false;
    EXPECT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0].id, frame.id);
    EXPECT_EQ(got[0].flags, frame.flags);
    EXPECT_EQ(got[0].dlc, frame.dlc);
    for (unsigned i = 0; i < 8 && (frame.flags & kRemote) == 0; ++i)
      EXPECT_EQ(got[0].data[i], i < frame.dlc ? frame.data[i] : 0) << i;
    return true;
  }
  verican_result_t filter(const std::vector<verican_filter_t> &filters) {
    EXPECT_EQ(verican_init(&bus_[1].dev, &bus_[1].config), VERICAN_OK);
    return verican_set_filters(&bus_[1].dev, filters.data(),
                               static_cast<std::uint16_t>(filters.size()));
  }

  DriverBus bus_{2, core_build("small")};
};

TEST_F(SmallDriver, FramesOfAllKindsAndLengthsArrive) {
  up();
  unsigned frames = 0;
  for (unsigned dlc = 0; dlc <= 8; ++dlc) {
    for (unsigned flags : {kData, kExt, kRemote, kExt | kRemote}) {
      EXPECT_TRUE(arrives(driver_frame(0x123 + dlc, dlc, flags))) << dlc << " " << flags;
      ++frames;
    }
  }
  EXPECT_EQ(frames, 36u);
}

TEST_F(SmallDriver, LowestIdentifierOfAllThatWaitGoesFirst) {
  up();
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id : {0x700u, 0x300u, 0x500u, 0x100u}) {
    const verican_frame_t frame = driver_frame(id, 8);
    ASSERT_EQ(verican_send(&bus_[0].dev, &frame, nullptr), VERICAN_OK);
  }
  ASSERT_TRUE(bus_.run_until([&] { return bus_[0].events.size() == 4; }));
  bus_.run(20 * kMicrosecond);
  for (const verican_frame_t &frame : bus_[1].received()) ids.push_back(frame.id);
  ASSERT_EQ(ids.size(), 4u);
  EXPECT_EQ(std::vector<std::uint32_t>(ids.begin() + 1, ids.end()),
            (std::vector<std::uint32_t>{0x100, 0x300, 0x500}));  // 0x700 was on the bus already
}

TEST_F(SmallDriver, FiltersWithOneMaskAcceptWhatTheySay) {
  const auto data = VERICAN_SELECT_ONLY_0;
  ASSERT_EQ(filter({{0x120, 0x7F0, data, data}, {0x340, 0x7F0, data, data}}), VERICAN_OK);
  ASSERT_EQ(verican_start(&bus_[1].dev), VERICAN_OK);
  ASSERT_EQ(bus_[0].up(), VERICAN_OK);
  bus_.run(20 * kMicrosecond);
  for (std::uint32_t id : {0x120u, 0x12Fu, 0x340u, 0x345u}) EXPECT_TRUE(arrives(driver_frame(id)));
  for (std::uint32_t id : {0x130u, 0x320u, 0x000u}) EXPECT_FALSE(arrives(driver_frame(id)));
  EXPECT_FALSE(arrives(driver_frame(0x120, 8, kExt)));
  EXPECT_FALSE(arrives(driver_frame(0x120, 8, kRemote)));
}

TEST_F(SmallDriver, FiltersWithDifferentMasksAreNotSupported) {
  const auto data = VERICAN_SELECT_ONLY_0, both = VERICAN_SELECT_BOTH;
  EXPECT_EQ(filter({{0x120, 0x7F0, data, data}, {0x340, 0x7FF, data, data}}),
            VERICAN_ERR_UNSUPPORTED);
  EXPECT_EQ(filter({{0x120, 0x7F0, data, data}, {0x340, 0x7F0, both, data}}),
            VERICAN_ERR_UNSUPPORTED);
}

// More filters than reach buffers 14 and 15, which have masks of their own.
TEST_F(SmallDriver, BuffersFourteenAndFifteenHaveTheMaskToo) {
  bus_[1].config.tx_mailboxes = 1;
  const auto data = VERICAN_SELECT_ONLY_0;
  std::vector<verican_filter_t> filters;
  for (std::uint32_t id = 0; id < 15; ++id) filters.push_back({id << 4, 0x7F0, data, data});
  ASSERT_EQ(filter(filters), VERICAN_OK);
  ASSERT_EQ(verican_start(&bus_[1].dev), VERICAN_OK);
  ASSERT_EQ(bus_[0].up(), VERICAN_OK);
  bus_.run(20 * kMicrosecond);
  for (std::uint32_t id = 0; id < 15; ++id) EXPECT_TRUE(arrives(driver_frame(id << 4 | 5))) << id;
  EXPECT_FALSE(arrives(driver_frame(15 << 4)));
}

TEST_F(SmallDriver, SelfTestPasses) {
  verican_test_report_t report{};
  ASSERT_EQ(verican_init(&bus_[0].dev, &bus_[0].config), VERICAN_OK);
  EXPECT_EQ(verican_self_test(&bus_[0].dev, &report), VERICAN_OK)
      << report.step << " " << report.where << " " << report.expected << " " << report.found;
}

}  // namespace
}  // namespace vericansim

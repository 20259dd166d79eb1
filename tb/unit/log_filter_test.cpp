// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Parts of recordings, and the table of identifiers; periods and jitter worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/input_error_of.hpp"
#include "trace/candump.hpp"
#include "trace/identifiers.hpp"
#include "trace/log_filter.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

CanLog sample() {
  return parse_candump(
      "(100.0) can0 123#11\n(100.1) can1 123##1AA\n(100.2) can1 456#22\n(100.3) can0 12345678#33\n"
      "(100.4) can1 20000004#0000000000000000\n(100.5) can0 456#R2\n",
      "log");
}

std::string error_of(const LogFilter &filter) {
  return input_error_of([&] { return filtered(sample(), filter, "a.log"); });
}

TEST(LogFilter, SeveralInterfacesMustBeChosen) {
  EXPECT_EQ(error_of({}),
            "a.log: holds several interfaces: can0 (3 frames), can1 (3 frames); allowed: "
            "--interface NAME, or --interface all for them as one bus");
  EXPECT_THAT(error_of({.interface = "can7"}),
              HasSubstr("--interface: 'can7' is not in a.log; allowed: all, can0 (3 frames)"));
  EXPECT_EQ(filtered(sample(), {.interface = "all"}, "a.log").entries.size(), 4U);
  const CanLog one = filtered(sample(), {.interface = "can1"}, "a.log");
  ASSERT_EQ(one.entries.size(), 1U);
  EXPECT_EQ(one.entries[0].time, 0);
  EXPECT_EQ(one.start_ns, 100'200'000'000);
  EXPECT_EQ(one.skipped, 2U);
  EXPECT_EQ(one.others.at(0).time, -100 * kMillisecond);
  EXPECT_EQ(one.others.at(0).before, 0U);
  EXPECT_EQ(one.others.at(1).before, 1U);
}

// candump's filters, which see 29-bit identifiers and remote frames by SocketCAN's flags.
TEST(LogFilter, IdentifiersByMask) {
  const auto ids = [](const char *text) {
    std::vector<std::uint32_t> result;
    const LogFilter filter{.interface = "all", .ids = {parse_filter(text)}};
    for (const LogEntry &entry : filtered(sample(), filter, "a.log").entries)
      result.push_back(entry.frame.id);
    return result;
  };
  EXPECT_EQ(ids("456:7FF"), (std::vector<std::uint32_t>{0x456, 0x456}));
  EXPECT_EQ(ids("456:C00007FF"), (std::vector<std::uint32_t>{0x456}));
  EXPECT_EQ(ids("12345678:9FFFFFFF"), (std::vector<std::uint32_t>{0x12345678}));
  EXPECT_EQ(ids("456~7FF"), (std::vector<std::uint32_t>{0x123, 0x12345678}));
}

TEST(LogFilter, TimesCountFromTheFirstFrameAndIncludeBothEnds) {
  LogFilter filter{.interface = "all"};
  filter.from = 200 * kMillisecond;
  filter.to = 300 * kMillisecond;
  const CanLog part = filtered(sample(), filter, "a.log");
  ASSERT_EQ(part.entries.size(), 2U);
  EXPECT_EQ(part.entries[0].frame.id, 0x456U);
  EXPECT_EQ(part.entries[1].time, 100 * kMillisecond);
  EXPECT_EQ(part.start_ns, 100'200'000'000);
  filter.to = 100 * kMillisecond;
  EXPECT_THAT(error_of(filter), HasSubstr("--from: is behind --to"));
}

/// Periods of 10, 12 and 8 ms: mean 10, deviations 0, 2, -2, jitter sqrt(8 / 3).
IdentifierTable table() {
  IdentifierTable result;
  const Time at[] = {5 * kMillisecond, 15 * kMillisecond, 27 * kMillisecond, 35 * kMillisecond};
  for (std::uint8_t i = 0; i < 4; ++i)
    result.add("can0", {0x123, false, false, 3, {7, i, 9}}, at[i]);
  result.add("can0", {0x123, false, true, 3, {}}, 0);
  result.add("", {0x1, true, false, 1, {5}}, 0);
  result.add("", {0x1, true, false, 2, {5, 6}}, kSecond);
  return result;
}

TEST(Identifiers, CountPeriodJitterAndChangedBytes) {
  const IdentifierTable all = table();
  ASSERT_EQ(all.rows().size(), 3U);
  const IdentifierRow &row = all.rows().at({"can0", false, false, 0x123});
  EXPECT_EQ(row.count, 4U);
  EXPECT_DOUBLE_EQ(row.mean_period, 10e9);
  EXPECT_EQ(row.shortest_period, 8 * kMillisecond);
  EXPECT_EQ(row.longest_period, 12 * kMillisecond);
  EXPECT_NEAR(row.jitter(), 1.632993e9, 1e4);
  EXPECT_EQ(row.first, 5 * kMillisecond);
  EXPECT_EQ(row.last, 35 * kMillisecond);
  EXPECT_EQ(row.last_frame.data[1], 3);
  EXPECT_EQ(row.changed, (std::array<bool, 8>{false, true}));
  // A byte that was not there before has changed.
  EXPECT_EQ(all.rows().at({"", false, true, 1}).changed, (std::array<bool, 8>{false, true}));
}

TEST(Identifiers, TextJsonAndCsv) {
  EXPECT_THAT(to_text(table()),
              HasSubstr("can0       123            4     10.000      8.000     "
                        "12.000      1.633    0.005000    0.035000  07 03* 09\n"));
  EXPECT_THAT(to_text(table()), HasSubstr("00000001"));
  const auto json = to_json(table());
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(json[1]["interface"], "can0");
  EXPECT_EQ(json[1]["id"], 0x123);
  EXPECT_EQ(json[1]["period_max_ps"], 12 * kMillisecond);
  EXPECT_EQ(json[1]["changed_bytes"].dump(), "[1]");
  std::ostringstream csv;
  write_csv(table(), csv);
  EXPECT_THAT(csv.str(), HasSubstr("\ncan0,123,0,0,4,0.010000000,0.008000000,0.012000000,"
                                   "0.001632993,0.005000000,0.035000000,3,07 03 09,1\n"));
  EXPECT_THAT(csv.str(), HasSubstr("\ncan0,123,0,1,1,0.000000000"));
}

}  // namespace
}  // namespace vericansim

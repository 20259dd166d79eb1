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

// What is no frame of SocketCAN at all (here: frames that the recording computer has lost) has no
// interface, identifier or time; it stays counted.
TEST(LogFilter, OneInterfaceNeedsNoChoiceAndOtherLinesStayCounted) {
  const CanLog log = parse_candump(
      "(100.0) can0 123#11\nDROPCOUNT: dropped 3 CAN frames on 'can0' socket\n"
      "(100.1) can0 123##1AA\n",
      "log");
  const CanLog all = filtered(log, {}, "a.log");
  EXPECT_EQ(all.entries.size(), 1U);
  EXPECT_EQ(all.others.size(), 1U);
  EXPECT_EQ(all.skipped, 2U);
}

TEST(LogFilter, WithoutATimeOfDayThereIsNoneLater) {
  CanLog log = sample();
  log.start_ns = 0;
  const CanLog part = filtered(log, {.interface = "can1"}, "a.log");
  EXPECT_EQ(part.start_ns, 0);
  EXPECT_EQ(part.entries.at(0).time, 0);
}

TEST(LogFilter, TimesCountFromTheFirstEntryIfNoClassicalFrameIsLeft) {
  const CanLog part =
      filtered(sample(), {.interface = "can1", .ids = {parse_filter("123:7FF")}}, "a.log");
  EXPECT_TRUE(part.entries.empty());
  ASSERT_EQ(part.others.size(), 1U);
  EXPECT_EQ(part.others[0].time, 0);
  EXPECT_EQ(part.start_ns, 100'100'000'000);
}

// 29 bits are a flag of CAN FD frames too. Error messages have a class, no identifier: candump's
// filters let none of them pass, inverted ones neither (linux/can/raw.h, CAN_RAW_ERR_FILTER).
TEST(LogFilter, OtherEntriesByMask) {
  const CanLog log = parse_candump(
      "(1.0) can0 00000123##1AA\n(1.1) can0 123##1BB\n(1.2) can0 20000123#0000000000000000\n",
      "log");
  const auto texts = [&](const char *filter) {
    std::string text;
    for (const ForeignEntry &entry :
         filtered(log, {.interface = "", .ids = {parse_filter(filter)}}, "a.log").others)
      text += entry.text + " ";
    return text;
  };
  EXPECT_EQ(texts("00000123:9FFFFFFF"), "00000123##1AA ");
  EXPECT_EQ(texts("123:800007FF"), "123##1BB ");
  EXPECT_EQ(texts("0:0"), "00000123##1AA 123##1BB ");
  EXPECT_EQ(texts("456~7FF"), "00000123##1AA 123##1BB ");
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

/// Periods of 10, 8, 12 and 10 ms: mean 10, deviations 0, -2, 2, 0, jitter sqrt(8 / 4). The second
/// byte changes once, the fourth comes and goes.
IdentifierTable table() {
  IdentifierTable result;
  const Time at[] = {5, 15, 23, 35, 45};
  for (std::uint8_t i = 0; i < 5; ++i)
    result.add("can0",
               {0x123,
                false,
                false,
                static_cast<std::uint8_t>(i == 2 ? 4 : 3),
                {7, static_cast<std::uint8_t>(i == 0 ? 0 : 3), 9}},
               at[i] * kMillisecond);
  result.add("can0", {0x123, false, true, 3, {}}, 0);
  result.add("", {0x1, true, false, 1, {5}}, 0);
  result.add("", {0x1, true, false, 2, {5, 0}}, kSecond);
  return result;
}

TEST(Identifiers, CountPeriodJitterAndChangedBytes) {
  const IdentifierTable all = table();
  ASSERT_EQ(all.rows().size(), 3U);
  const IdentifierRow &row = all.rows().at({"can0", false, false, 0x123});
  EXPECT_EQ(row.count, 5U);
  EXPECT_DOUBLE_EQ(row.mean_period, 10e9);
  EXPECT_EQ(row.shortest_period, 8 * kMillisecond);
  EXPECT_EQ(row.longest_period, 12 * kMillisecond);
  EXPECT_NEAR(row.jitter(), 1.414214e9, 1e4);
  EXPECT_EQ(row.first, 5 * kMillisecond);
  EXPECT_EQ(row.last, 45 * kMillisecond);
  EXPECT_EQ(row.last_frame.data[1], 3);
  EXPECT_EQ(row.changed, (std::array<bool, 8>{false, true, false, true}));
  // A byte that was not there before has changed.
  EXPECT_EQ(all.rows().at({"", false, true, 1}).changed, (std::array<bool, 8>{false, true}));
}

TEST(Identifiers, TextJsonAndCsv) {
  EXPECT_THAT(to_text(table()),
              HasSubstr("can0       123            5     10.000      8.000     "
                        "12.000      1.414    0.005000    0.045000  07 03* 09\n"));
  EXPECT_THAT(to_text(table()), HasSubstr("00000001"));
  const auto json = to_json(table());
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(json[1]["interface"], "can0");
  EXPECT_EQ(json[1]["id"], 0x123);
  EXPECT_EQ(json[1]["period_max_ps"], 12 * kMillisecond);
  EXPECT_EQ(json[1]["changed_bytes"].dump(), "[1,3]");
  EXPECT_EQ(json[1]["last_data"], "07 03 09");
  EXPECT_EQ(json[2]["last_data"], "");  // the remote frame
  EXPECT_EQ(json[2]["last_dlc"], 3);
  std::ostringstream csv;
  write_csv(table(), csv);
  EXPECT_THAT(csv.str(), HasSubstr("\ncan0,123,0,0,5,0.010000000,0.008000000,0.012000000,"
                                   "0.001414214,0.005000000,0.045000000,3,07 03 09,1 3\n"));
  EXPECT_THAT(csv.str(),
              HasSubstr("\ncan0,123,0,1,1,0.000000000,0.000000000,0.000000000,0.000000000,"
                        "0.000000000,0.000000000,3,,\n"));
}

// RFC 4180: an interface may be called anything.
TEST(IdentifierTable, NamesOfInterfacesAreQuotedInCsv) {
  IdentifierTable odd;
  odd.add("a,\"b", Frame{0x123, false, false, 0, {}}, 0);
  std::ostringstream csv;
  write_csv(odd, csv);
  EXPECT_THAT(csv.str(), HasSubstr("\n\"a,\"\"b\",123,0,0,1,"));
}

}  // namespace
}  // namespace vericansim

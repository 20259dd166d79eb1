// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Response-time analysis against published numbers: the counter-example of Davis et al. (2007) and
// the SAE benchmark.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "timing/analysis.hpp"

namespace vericansim {
namespace {

TEST(Analysis, FrameLengths) {
  EXPECT_EQ(worst_case_bits(0, false), 55U);
  EXPECT_EQ(worst_case_bits(8, false), 135U);  // 132 + 3 bits of intermission, FF-11
  EXPECT_EQ(worst_case_bits(8, true), 160U);   // 157 + 3
}

// The set by which Davis et al. refuted the analysis of 1994: 125 kbit/s, three messages of 7 bytes
// (1 ms each); the second instance of the lowest one responds later (3.5 ms) than the first (3.0
// ms).
TEST(Analysis, CounterExampleOf2007) {
  const std::vector<MessageSpec> set = {{7, false, 2'500 * kMicrosecond, 0},
                                        {7, false, 3'500 * kMicrosecond, 0},
                                        {7, false, 3'500 * kMicrosecond, 0}};
  const auto times = response_times(set, 8 * kMicrosecond);
  EXPECT_EQ(times[0], 2'000 * kMicrosecond);
  EXPECT_EQ(times[1], 3'000 * kMicrosecond);
  EXPECT_EQ(times[2], 3'500 * kMicrosecond);
  EXPECT_NEAR(worst_case_load(set, 8 * kMicrosecond), 0.971, 0.001);  // the paper: 97 %
}

TEST(Analysis, OverloadHasNoBound) {
  const std::vector<MessageSpec> set = {
      {8, false, kMillisecond, 0}, {8, false, kMillisecond, 0}, {0, false, kSecond, 0}};
  const auto times = response_times(set, 4 * kMicrosecond);  // two frames of 0.54 ms in 1 ms
  EXPECT_TRUE(times[0].has_value());
  EXPECT_FALSE(times[1].has_value());
  EXPECT_FALSE(times[2].has_value());
}

TEST(Analysis, BadValuesAreRefused) {
  EXPECT_THROW(static_cast<void>(response_times({{9, false, 1, 0}}, 1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(response_times({{8, false, 0, 0}}, 1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(response_times({{8, false, 1, 0}}, 0)), std::invalid_argument);
}

/// SAE class C, 17 messages as in Tindell and Burns (1994), highest priority first: bytes, jitter
/// and period in ms.
struct SaeMessage {
  unsigned bytes;
  double jitter_ms;
  double period_ms;
};
constexpr SaeMessage kSae[17] = {
    {1, 0.1, 50},  {2, 0.1, 5},   {1, 0.1, 5},    {2, 0.1, 5},    {1, 0.2, 5},   {2, 0.2, 5},
    {6, 0.2, 10},  {1, 0.2, 10},  {2, 0.2, 10},   {2, 0.2, 10},   {1, 0.2, 100}, {4, 0.3, 100},
    {1, 0.3, 100}, {1, 0.2, 100}, {3, 0.4, 1000}, {1, 0.3, 1000}, {1, 0.3, 1000}};

std::vector<MessageSpec> sae_set() {
  std::vector<MessageSpec> set;
  for (const SaeMessage &m : kSae)
    set.push_back({m.bytes, false, static_cast<Time>(m.period_ms * kMillisecond),
                   static_cast<Time>(std::llround(m.jitter_ms * 1000)) * kMicrosecond});
  return set;
}

// Loads of the set with worst-case stuffing: 86.7 / 43.4 / 21.7 / 10.8 % (sae17.md).
TEST(Analysis, SaeLoads) {
  const double expected[4] = {0.867, 0.434, 0.217, 0.108};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(worst_case_load(sae_set(), (8 >> i) * kMicrosecond), expected[i], 0.0006);
}

// First and last messages at 125 kbit/s, in microseconds.
TEST(Analysis, SaeAt125kbit) {
  const auto times = response_times(sae_set(), 8 * kMicrosecond);
  EXPECT_EQ(times[0], 1'540 * kMicrosecond);
  EXPECT_EQ(times[6], 5'240 * kMicrosecond);
  EXPECT_EQ(times[7], 8'600 * kMicrosecond);
  EXPECT_EQ(times[11], 19'420 * kMicrosecond);
  EXPECT_EQ(times[16], 29'820 * kMicrosecond);
}

// The whole table, where the shared data is at hand.
TEST(Analysis, SaeTable) {
  std::ifstream file("../shared/data/sae17.csv");
  if (!file) GTEST_SKIP() << "../shared/data/sae17.csv is not here";
  std::string line;
  std::getline(file, line);
  for (std::size_t row = 0; std::getline(file, line); ++row) {
    std::vector<double> cells;
    std::istringstream text{line};
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(std::stod(cell));
    ASSERT_EQ(cells.size(), 13U);
    for (int i = 0; i < 4; ++i) {
      const auto times = response_times(sae_set(), (8 >> i) * kMicrosecond);
      ASSERT_TRUE(times[row].has_value());
      EXPECT_NEAR(static_cast<double>(*times[row]) / kMillisecond,
                  cells[9 + static_cast<std::size_t>(i)], 0.0006)
          << "message " << cells[0] << " column " << i;
    }
  }
}

}  // namespace
}  // namespace vericansim

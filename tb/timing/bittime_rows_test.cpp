// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The core holds what `verican bittime` prints: tolerance of the clocks and cable together. A
// sample; `make campaign STAGES=bittime` takes all rows and more frames.
#include <gtest/gtest.h>

#include <ostream>

#include "timing/far_winner.hpp"
#include "timing/row_proof.hpp"

namespace vericansim {

struct Row {
  const char *name;
  std::uint32_t clock_hz, bitrate;
  BitTiming timing;
};
void PrintTo(const Row &row, std::ostream *out) { *out << row.name; }

namespace {

constexpr unsigned kFrames = 480;
constexpr unsigned kContestBuses = 30;

class Rows : public ::testing::TestWithParam<Row> {};

// BT-07, BT-08, BT-09, TH-08: at the limits there is no error.
TEST_P(Rows, HoldWhatIsSaidOfThem) {
  const Row &row = GetParam();
  const BitTimingRequest request{.clock_hz = row.clock_hz, .bitrate = row.bitrate};
  const BitTimingResult rated = rate_bit_timing(row.timing, request);
  ASSERT_TRUE(rated.usable());
  for (const RowPromise &promise : promises_of(rated, request)) {
    const RowProof proof = prove_row(promise, kFrames, 1);
    EXPECT_EQ(proof.dirty, 0U) << "of " << proof.buses << " buses";
    EXPECT_GE(proof.frames, kFrames);
    EXPECT_EQ(prove_far_winner(promise, kContestBuses, 1).dirty, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sample, Rows,
    ::testing::Values(Row{"LateSample8MHz1M", 8'000'000, 1'000'000, {1, 4, 1, 2, 1}},
                      Row{"Middle8MHz1M", 8'000'000, 1'000'000, {1, 3, 2, 2, 2}},
                      Row{"Best10MHz1M", 10'000'000, 1'000'000, {1, 4, 3, 2, 2}},
                      Row{"Symmetric10MHz1M", 10'000'000, 1'000'000, {1, 3, 3, 3, 3}},
                      Row{"WidePs2At8MHz500k", 8'000'000, 500'000, {1, 4, 5, 6, 4}},
                      Row{"Symmetric8MHz500k", 8'000'000, 500'000, {1, 5, 5, 5, 4}},
                      Row{"Cia8MHz500k", 8'000'000, 500'000, {1, 6, 7, 2, 2}},
                      Row{"Finest40MHz1M", 40'000'000, 1'000'000, {2, 7, 7, 5, 4}},
                      Row{"WideQuanta20MHz250k", 20'000'000, 250'000, {8, 3, 4, 2, 2}},
                      Row{"LongCable8MHz125k", 8'000'000, 125'000, {4, 6, 7, 2, 2}},
                      Row{"WideQuanta16MHz125k", 16'000'000, 125'000, {16, 3, 2, 2, 2}}),
    [](const auto &test) { return test.param.name; });

/// The three nodes with more than the calculator says.
struct Excess {
  const char *name;
  RowPromise promise;
};
void PrintTo(const Excess &excess, std::ostream *out) { *out << excess.name; }

class Excesses : public ::testing::TestWithParam<Excess> {};

// The rig sees errors where there are some.
TEST_P(Excesses, AreNotHeld) { EXPECT_GT(prove_row(GetParam().promise, kFrames, 1).dirty, 0U); }

// PROP for the cable and one way of 100 ns alone, and BT-08, which leave out what the core takes.
INSTANTIATE_TEST_SUITE_P(
    Textbook, Excesses,
    ::testing::Values(Excess{"8MHz1M", {{1, 2, 2, 3, 2}, 8e6, 0.00990, 5, 100}},
                      Excess{"10MHz1M", {{1, 3, 3, 3, 3}, 10e6, 0.01181, 10, 100}},
                      Excess{"8MHz500k", {{1, 4, 5, 6, 4}, 8e6, 0.01238, 30, 100}},
                      Excess{"8MHz500kSymmetric", {{1, 5, 5, 5, 4}, 8e6, 0.01232, 42, 100}}),
    [](const auto &test) { return "At" + std::string{test.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    Beyond, Excesses,
    ::testing::Values(Excess{"CableBy20", {{1, 6, 7, 2, 2}, 8e6, 0.00483, 96, 100}},
                      Excess{"ClocksBy30", {{1, 5, 5, 5, 4}, 8e6, 0.01582, 0, 0}},
                      Excess{"ClocksWithWideQuanta", {{16, 3, 2, 2, 2}, 16e6, 0.0122, 0, 0}}),
    [](const auto &test) { return test.param.name; });

/// Clocks and cables that BT-07 and BT-08 allow, and neighbours of a loser do not (three times what
/// the calculator says of these cables).
class Contests : public ::testing::TestWithParam<Excess> {};

TEST_P(Contests, LeaveNeighboursApart) {
  EXPECT_GT(prove_far_winner(GetParam().promise, kContestBuses, 1).dirty, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Beyond, Contests,
    ::testing::Values(Excess{"At8MHz500k", {{1, 6, 7, 2, 2}, 8e6, 0.0042, 80, 100}},
                      Excess{"At8MHz125k", {{4, 6, 7, 2, 2}, 8e6, 0.0024, 508, 100}}),
    [](const auto &test) { return test.param.name; });

}  // namespace
}  // namespace vericansim

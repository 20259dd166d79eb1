// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 14, the sweep SY-19: every phase error in every kind of bit, on the whole engine. The
// campaign does the same with more bit timings (tb/faults).
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "protocol/sync_sweep.hpp"

namespace vericansim {

void PrintTo(const SweepPlace &place, std::ostream *out) { *out << place.name; }

namespace {

class SyncSweep : public testing::TestWithParam<SweepPlace> {
 protected:
  static void check(const SweepPlace &place, const BitTiming &t, int e) {
    EXPECT_EQ(check_edge(place, t, e), "") << describe(t) << " e " << e;
  }
};

// SY-19, SY-21, SY-05, SY-06, SY-07, SY-08, SY-10, SY-11, SY-12, SY-14, SY-18: every place, every
// phase error, SJW 1 to what the segments allow.
TEST_P(SyncSweep, EdgeMovesTheNextSampleAsTheTableSays) {
  for (const BitTiming &base : {BitTiming{4, 5, 2, 2, 1}, BitTiming{5, 1, 4, 4, 1}}) {
    for (unsigned sjw = 1; sjw <= std::min({4u, base.ps1, base.ps2}); ++sjw) {
      BitTiming t = base;
      t.sjw = sjw;
      const int first = GetParam().early_edges ? -static_cast<int>(t.ps2) : 0;
      for (int e = first; e <= static_cast<int>(t.prop + t.ps1); ++e) check(GetParam(), t, e);
    }
  }
}

// SY-19, PF-29: the longest segments with the largest SJW.
TEST_P(SyncSweep, LongestSegments) {
  const BitTiming t{4, 8, 8, 8, 4};
  for (int e = GetParam().early_edges ? -8 : 0; e <= 16; e += 3) check(GetParam(), t, e);
  check(GetParam(), t, 4);
  check(GetParam(), t, 16);
}

INSTANTIATE_TEST_SUITE_P(EveryPlace, SyncSweep, testing::ValuesIn(sweep_places()),
                         [](const auto &case_info) { return std::string{case_info.param.name}; });

}  // namespace
}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 14, the sweep SY-19: every phase error in every kind of bit, on the whole engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "protocol/timing_places.hpp"

namespace vericansim {
namespace {

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;

/// A place where the sweep puts its edge: the bench is brought to the first clock of a bit whose
/// predecessor was sampled recessive.
struct SweepPlace {
  const char *name;
  Level sent;
  bool hard;
  bool early_edges;  ///< false: SY-21 has no case for an edge after the sample point
  void (*reach)(TimingBench &);
};

void PrintTo(const SweepPlace &place, std::ostream *out) { *out << place.name; }

// Six recessive bits in the identifier: a stuff error of the DUT alone.
void reach_error_flag(TimingBench &bench) {
  receive_frame(bench);
  bench.run_to(Field::kId, 2);
  bench.pin(kR);
  bench.run_to(Field::kErrFlag, 0);
}

void passive_receiver(TimingBench &bench) { bench.dut().preset_counters(0, 130); }

// Bus-off: a passive transmitter at 248 does not see its own SOF.
void reach_bus_off(TimingBench &bench) {
  bench.dut().preset_counters(248, 0);
  send_frame(bench);
  bench.run_to(Field::kSof, 0);
  bench.pin(kR);
  bench.run_to(Field::kBusOff, 3);
}

const SweepPlace kPlaces[] = {
    {"Idle", kR, true, true, [](TimingBench &b) { b.start(); }},
    {"Integration", kR, true, true,
     [](TimingBench &b) {
       b.dut().start();
       b.run_to(Field::kInteg, 3);
     }},
    {"Int2", kR, true, true,
     [](TimingBench &b) {
       receive_frame(b);
       b.run_to(Field::kInt, 1);
     }},
    {"Int3", kR, true, true,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kInt, 2);
     }},
    {"Suspend", kR, true, true,
     [](TimingBench &b) {
       b.dut().preset_counters(140, 0);
       send_frame(b);
       b.run_to(Field::kSuspend, 3);
     }},
    {"BusOff", kR, true, true, reach_bus_off},
    {"Int1", kR, false, true,
     [](TimingBench &b) {
       receive_frame(b);
       b.run_to(Field::kInt, 0);
     }},
    {"OwnSof", kD, false, false,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kSof, 0);
     }},
    {"ReceiverId", kR, false, true, [](TimingBench &b) { reach_received(b, Field::kId); }},
    {"ReceiverData", kR, false, true, [](TimingBench &b) { reach_received(b, Field::kData); }},
    {"ReceiverCrc", kR, false, true, [](TimingBench &b) { reach_received(b, Field::kCrc); }},
    {"ReceiverAck", kD, false, true,
     [](TimingBench &b) {
       receive_frame(b);
       b.run_to(Field::kAck, 0);
     }},
    {"ReceiverEof", kR, false, true, [](TimingBench &b) { reach_received(b, Field::kEof); }},
    {"ActiveFlag", kD, false, true, reach_error_flag},
    {"PassiveFlag", kR, false, true,
     [](TimingBench &b) {
       passive_receiver(b);
       reach_error_flag(b);
     }},
    {"DelimiterWait", kR, false, true,
     [](TimingBench &b) {
       passive_receiver(b);
       reach_error_flag(b);
       b.run_to(Field::kWait, 0);
     }},
    {"Delimiter", kR, false, true,
     [](TimingBench &b) {
       passive_receiver(b);
       reach_error_flag(b);
       b.run_to(Field::kDel, 2);
     }},
    {"TransmitterIdR", kR, false, true, [](TimingBench &b) { reach_sent(b, Field::kId, kR); }},
    {"TransmitterIdD", kD, false, true, [](TimingBench &b) { reach_sent(b, Field::kId, kD); }},
    {"TransmitterDataR", kR, false, true, [](TimingBench &b) { reach_sent(b, Field::kData, kR); }},
    {"TransmitterDataD", kD, false, true, [](TimingBench &b) { reach_sent(b, Field::kData, kD); }},
    {"TransmitterAckSlot", kR, false, true,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kAck, 0);
     }},
    {"TransmitterEof", kR, false, true,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kEof, 3);
     }},
};

class SyncSweep : public testing::TestWithParam<SweepPlace> {
 protected:
  static void check(const SweepPlace &place, const BitTiming &t, int e);
};

void SyncSweep::check(const SweepPlace &place, const BitTiming &t, int e) {
  SCOPED_TRACE(describe(t) + " e " + std::to_string(e));
  TimingBench bench{{.timing = t}};
  place.reach(bench);
  ASSERT_EQ(bench.sent(), place.sent);
  bench.clear_records();
  const std::uint64_t start = bench.now();
  const int n = static_cast<int>(t.quanta());
  const int before_sample = static_cast<int>(t.prop + t.ps1);
  const int sjw = static_cast<int>(t.sjw);
  bench.pin(kR);
  bench.pin(bench.in_quantum(start, static_cast<unsigned>(e >= 0 ? e : n + e)), kD);
  bench.run_bits(3);
  // Where the rules put this sample, the next SYNC_SEG and the next sample, in quanta.
  const int limit = place.hard ? 99 : sjw;
  const int late = e > 0 && place.sent == kR ? std::min(e, limit) : 0;
  const int early = e < 0 ? std::min(-e, limit) : 0;
  const int next_sync = n + late - early;
  const int next_level = next_sync + (e < 0 && -e <= limit ? 1 : 0);
  const auto period = [&](int quanta) { return start + std::uint64_t(quanta) * t.prescaler; };
  ASSERT_GE(bench.samples().size(), 2u);
  ASSERT_GE(bench.bit_starts().size(), 2u);
  EXPECT_EQ(bench.samples()[0].period, period(before_sample + late + 1) - 1);
  EXPECT_EQ(bench.samples()[0].value, e < 0 ? kR : kD);
  EXPECT_EQ(bench.bit_starts()[1], period(next_level));
  EXPECT_EQ(bench.samples()[1].period, period(next_sync + before_sample + 1) - 1);
}

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

INSTANTIATE_TEST_SUITE_P(EveryPlace, SyncSweep, testing::ValuesIn(kPlaces),
                         [](const auto &case_info) { return std::string{case_info.param.name}; });

}  // namespace
}  // namespace vericansim

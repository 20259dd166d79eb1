// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The sweep SY-19: see sync_sweep.hpp.
#include "protocol/sync_sweep.hpp"

#include <algorithm>

namespace vericansim {
namespace {

constexpr Level kD = Level::kDominant;
constexpr Level kR = Level::kRecessive;

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

const std::vector<SweepPlace> kPlaces = {
    {"Idle", Role::kNone, kR, true, true, [](TimingBench &b) { b.start(); }},
    {"Integration", Role::kNone, kR, true, true,
     [](TimingBench &b) {
       b.dut().start();
       b.run_to(Field::kInteg, 3);
     }},
    {"Int2", Role::kReceiver, kR, true, true,
     [](TimingBench &b) {
       receive_frame(b);
       b.run_to(Field::kInt, 1);
     }},
    {"Int3", Role::kTransmitter, kR, true, true,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kInt, 2);
     }},
    {"Suspend", Role::kTransmitter, kR, true, true,
     [](TimingBench &b) {
       b.dut().preset_counters(140, 0);
       send_frame(b);
       b.run_to(Field::kSuspend, 3);
     }},
    {"BusOff", Role::kNone, kR, true, true, reach_bus_off},
    {"Int1", Role::kReceiver, kR, false, true,
     [](TimingBench &b) {
       receive_frame(b);
       b.run_to(Field::kInt, 0);
     }},
    {"OwnSof", Role::kTransmitter, kD, false, false,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kSof, 0);
     }},
    {"ReceiverId", Role::kReceiver, kR, false, true,
     [](TimingBench &b) { reach_received(b, Field::kId); }},
    {"ReceiverData", Role::kReceiver, kR, false, true,
     [](TimingBench &b) { reach_received(b, Field::kData); }},
    {"ReceiverCrc", Role::kReceiver, kR, false, true,
     [](TimingBench &b) { reach_received(b, Field::kCrc); }},
    {"ReceiverAck", Role::kReceiver, kD, false, true,
     [](TimingBench &b) {
       receive_frame(b);
       b.run_to(Field::kAck, 0);
     }},
    {"ReceiverEof", Role::kReceiver, kR, false, true,
     [](TimingBench &b) { reach_received(b, Field::kEof); }},
    {"ActiveFlag", Role::kReceiver, kD, false, true, reach_error_flag},
    {"PassiveFlag", Role::kReceiver, kR, false, true,
     [](TimingBench &b) {
       passive_receiver(b);
       reach_error_flag(b);
     }},
    {"DelimiterWait", Role::kReceiver, kR, false, true,
     [](TimingBench &b) {
       passive_receiver(b);
       reach_error_flag(b);
       b.run_to(Field::kWait, 0);
     }},
    {"Delimiter", Role::kReceiver, kR, false, true,
     [](TimingBench &b) {
       passive_receiver(b);
       reach_error_flag(b);
       b.run_to(Field::kDel, 2);
     }},
    {"TransmitterIdR", Role::kTransmitter, kR, false, true,
     [](TimingBench &b) { reach_sent(b, Field::kId, kR); }},
    {"TransmitterIdD", Role::kTransmitter, kD, false, true,
     [](TimingBench &b) { reach_sent(b, Field::kId, kD); }},
    {"TransmitterDataR", Role::kTransmitter, kR, false, true,
     [](TimingBench &b) { reach_sent(b, Field::kData, kR); }},
    {"TransmitterDataD", Role::kTransmitter, kD, false, true,
     [](TimingBench &b) { reach_sent(b, Field::kData, kD); }},
    {"TransmitterAckSlot", Role::kTransmitter, kR, false, true,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kAck, 0);
     }},
    {"TransmitterEof", Role::kTransmitter, kR, false, true,
     [](TimingBench &b) {
       send_frame(b);
       b.run_to(Field::kEof, 3);
     }},
};

/// Where the rules put this sample, the next level and the next sample, in quanta.
struct Expected {
  int sample;
  int next_level;
  int next_sample;
};

Expected expected(const SweepPlace &place, const BitTiming &t, int e) {
  const int before_sample = static_cast<int>(t.prop + t.ps1);
  const int limit = place.hard ? 99 : static_cast<int>(t.sjw);
  const int late = e > 0 && place.sent == kR ? std::min(e, limit) : 0;
  const int early = e < 0 ? std::min(-e, limit) : 0;
  const int next_sync = static_cast<int>(t.quanta()) + late - early;
  const int next_level = next_sync + (e < 0 && -e <= limit ? 1 : 0);
  return {before_sample + late, next_level, next_sync + before_sample};
}

}  // namespace

const std::vector<SweepPlace> &sweep_places() { return kPlaces; }

std::string check_edge(const SweepPlace &place, const BitTiming &t, int e) {
  TimingBench bench{{.timing = t}};
  place.reach(bench);
  if (bench.sent() != place.sent) return "the DUT does not send the level of the place";
  bench.clear_records();
  const std::uint64_t start = bench.now();
  const int quantum = e >= 0 ? e : static_cast<int>(t.quanta()) + e;
  bench.pin(kR);
  bench.pin(bench.in_quantum(start, static_cast<unsigned>(quantum)), kD);
  bench.run_bits(3);
  const auto &samples = bench.samples();
  if (samples.size() < 2 || bench.bit_starts().size() < 2) return "the DUT has lost its grid";
  const Expected want = expected(place, t, e);
  const auto period = [&](int quanta) { return start + std::uint64_t(quanta) * t.prescaler; };
  std::string text;
  const auto compare = [&](const char *what, std::uint64_t is, std::uint64_t should) {
    if (is == should) return;
    text += std::string{what} + " in clock " + std::to_string(is - start) + " and not " +
            std::to_string(should - start) + "\n";
  };
  compare("sample", samples[0].period, period(want.sample + 1) - 1);
  if (samples[0].value != (e < 0 ? kR : kD)) text += "the sampled value is wrong\n";
  compare("next bit", bench.bit_starts()[1], period(want.next_level));
  compare("next sample", samples[1].period, period(want.next_sample + 1) - 1);
  return text;
}

}  // namespace vericansim

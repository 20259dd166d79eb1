// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockRig: see clock_rig.hpp.
#include "faults/clock_rig.hpp"

#include <cstdlib>
#include <stdexcept>

#include "bus/faults.hpp"
#include "bus/trace.hpp"

namespace vericansim {
namespace {

constexpr unsigned kIntegrationBits = 30;
constexpr unsigned kRestBits = 700;
constexpr unsigned kQuiet = 40;
constexpr unsigned kCounterDelay = BitRecorder::kSettle + 1;

}  // namespace

ClockRig::ClockRig(const BitTiming &timing, const StartCounters &counters)
    : dut_{"dut", {.timing = timing}}, reference_{timing}, partner_{timing} {
  dut_.preset_counters(counters.tec, counters.rec);
  reference_.model().preset_counters(counters.tec, counters.rec);
  dut_.start();
  PlaceTracker tracker;
  for (unsigned n = 0; n < kIntegrationBits * timing.clocks_per_bit(); ++n) {
    dut_.clock(Level::kRecessive);
    tracker.clocked(dut_.trace());
    if (dut_.idle() && tracker.fresh() && tracker.field() == Field::kIdle) return;
  }
  throw std::runtime_error("the DUT does not become idle");
}

void ClockRig::request(const Frame &frame, bool dut) {
  if (!dut) return partner_.model().request(frame);
  dut_.request(frame);
  reference_.model().request(frame);
}

void ClockRig::force(unsigned offset, unsigned clocks, Level level) {
  force_from_ = now_ + offset;
  force_to_ = force_from_ + clocks;
  forced_ = level;
}

void ClockRig::clock() {
  const Level wire = dut_.tx() & partner_.tx();
  const bool forced = now_ >= force_from_ && now_ < force_to_;
  const Level pin = forced ? forced_ : wire;
  const std::uint64_t word = dut_.trace();
  const BitPlace place = reference_.model().state();
  const bool sample = reference_.clock(pin);
  partner_.clock(wire);
  if (sample && (trace_field(word) != place.field || trace_stuff(word) != place.is_stuff)) {
    differs("place at the sample point");
  }
  compare(word, sample);
  dut_.clock(pin);
  wave_.clock(wire);
  wave_.node(0, pin);
  ++now_;
  if (dut_.tx() != reference_.tx()) differs("level at the TX pin");
}

void ClockRig::compare(std::uint64_t word, bool sample) {
  if (settle_ != 0 && --settle_ == 0) compare_counters();
  if (((word & kTraceSample) != 0) != sample) return differs("sample point");
  if (((word & kTraceBoundary) != 0) != reference_.bit_ended()) return differs("end of a bit");
  if (!sample) return;
  settle_ = kCounterDelay;
  if (decode_trace(word).rx != reference_.sampled()) differs("sampled value");
}

// FC-14: from 128 on REC is only "at least 128".
void ClockRig::compare_counters() {
  const Trace trace = decode_trace(dut_.trace());
  const NodeModel &model = reference_.model();
  const bool off = model.error_state() == ErrorState::kBusOff;
  if (trace.bus_off != off) return differs("bus-off");
  if (off) return;
  if (trace.tec != model.tec()) differs("TEC");
  const bool high = trace.rec >= 128 && model.rec() >= 128;
  if (trace.rec != model.rec() && !high) differs("REC");
  if (trace.passive != (model.error_state() == ErrorState::kPassive)) differs("error state");
}

void ClockRig::differs(const std::string &what) {
  if (!report_.empty()) return;
  report_ = "clock " + std::to_string(now_) + ", rules at " +
            std::string{field_name(reference_.model().state().field)} + ": " + what + " differs\n";
}

void ClockRig::run_bit() {
  do {
    if (!report_.empty()) return;
    clock();
  } while (!reference_.bit_ended());
}

void ClockRig::run_bits(unsigned bits) {
  for (unsigned i = 0; i < bits; ++i) run_bit();
}

bool ClockRig::rests() {
  NodeModel &a = reference_.model();
  NodeModel &b = partner_.model();
  return !a.pending() && !b.pending() && a.state().field == Field::kIdle &&
         b.state().field == Field::kIdle;
}

void ClockRig::finish() {
  run_bits(kQuiet);
  for (unsigned i = 0; i < kRestBits && !rests(); ++i) run_bit();
  if (report_.empty() && !rests()) differs("the bus does not come to rest: liveness");
  const std::size_t before = reference_.received().size();
  partner_.model().request(kGoodFrame);
  for (unsigned i = 0; i < kRestBits && partner_.model().pending(); ++i) run_bit();
  run_bits(3);
  if (report_.empty() && reference_.received().size() != before + 1) differs("the good frame");
  if (report_.empty() && dut_.received() != reference_.received()) differs("a received frame");
  if (report_.empty() && dut_.sent().size() != reference_.sent_frames()) differs("frames sent");
}

}  // namespace vericansim

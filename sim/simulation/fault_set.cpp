// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FaultSet: see fault_set.hpp.
#include "simulation/fault_set.hpp"

#include <algorithm>
#include <limits>
#include "scenario/fault_words.hpp"

namespace vericansim {
namespace {

constexpr Time kEver = std::numeric_limits<Time>::max();

/// How long a stretch of it lasts at least that counts. A node's bit lags that of the wire by its
/// synchroniser, so that a place of whole bits has the first clocks of the bit behind them.
Time least_stretch(const FaultSpec &spec, Time bit_time) {
  const bool whole_bits =
      spec.kind == FaultSpec::Kind::kPlace && !spec.first_quantum && !spec.last_quantum;
  return whole_bits ? bit_time / 4 : 0;
}

}  // namespace

Window FaultSet::on_bus(const Window &window) const {
  return {window.from + start_, window.to == kEver ? kEver : window.to + start_};
}

std::unique_ptr<Fault> FaultSet::make(const FaultSpec &spec,
                                      const std::function<unsigned(NodeId)> &prescaler) const {
  const Window window = on_bus(spec.window);
  switch (spec.kind) {
    case FaultSpec::Kind::kLevel:
      return std::make_unique<LevelFault>(spec.node, spec.effect, window);
    case FaultSpec::Kind::kCut: return std::make_unique<CutFault>(spec.node, window);
    case FaultSpec::Kind::kShort: return std::make_unique<ShortFault>(spec.node, window);
    case FaultSpec::Kind::kClock:
      return std::make_unique<ClockFault>(spec.node, window.from, spec.ppm);
    case FaultSpec::Kind::kNoise: {
      NoiseConfig noise = spec.noise;
      noise.window = window;
      return std::make_unique<NoiseFault>(noise);
    }
    case FaultSpec::Kind::kPlace: break;
  }
  PlaceSpec place = spec.place;
  const unsigned clocks = prescaler(spec.watched);
  if (spec.first_quantum) place.first_clock = *spec.first_quantum * clocks;
  if (spec.last_quantum) place.last_clock = (*spec.last_quantum + 1) * clocks - 1;
  return std::make_unique<PlaceFault>(spec.watched, place, spec.effect, spec.node);
}

// Level faults with an end are many in random scenarios and share one Fault.
void FaultSet::add_to(Bus &bus, Time start, Time bit_time,
                      const std::function<unsigned(NodeId)> &prescaler) {
  start_ = start;
  logs_.clear();
  for (const FaultSpec &spec : scenario_.faults)
    logs_.emplace_back(bit_time, least_stretch(spec, bit_time));
  std::unique_ptr<ScheduledFaults> scheduled;
  for (std::size_t i = 0; i < scenario_.faults.size(); ++i) {
    const FaultSpec &spec = scenario_.faults[i];
    if (spec.kind == FaultSpec::Kind::kLevel && spec.window.to != kEver) {
      if (!scheduled) scheduled = std::make_unique<ScheduledFaults>();
      scheduled->add(spec.node, spec.effect, on_bus(spec.window), &logs_[i]);
      continue;
    }
    faults_.push_back(make(spec, prescaler));
    faults_.back()->log_to(logs_[i]);
    bus.add(*faults_.back());
  }
  if (!scheduled) return;
  bus.add(*scheduled);
  faults_.push_back(std::move(scheduled));
}

// A clock stays wrong until the next fault of the same clock.
Time FaultSet::clock_until(const FaultSpec &spec, Time end) const {
  for (const FaultSpec &other : scenario_.faults)
    if (other.kind == FaultSpec::Kind::kClock && other.node == spec.node &&
        other.window.from > spec.window.from)
      end = std::min(end, other.window.from + start_);
  return end;
}

std::string FaultSet::victim(NodeId node) const {
  if (node == kBusPoint) return "wire";
  return node == kAllNodes ? "all" : scenario_.nodes[node].name;
}

std::vector<FaultReport> FaultSet::report(Time end) const {
  std::vector<FaultReport> list;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const FaultSpec &spec = scenario_.faults[i];
    const FaultLog &log = logs_[i];
    FaultReport fault{fault_name(scenario_, i),
                      fault_kind(spec),
                      victim(spec.node),
                      spec.node,
                      fault_text(scenario_, spec),
                      spec.line,
                      log.hits() == 0 && !spec.hits && !scenario_.expect.given,
                      log.hits(),
                      log.stretches(),
                      log.more()};
    if (spec.kind == FaultSpec::Kind::kClock)
      for (Window &time : fault.times) time.to = clock_until(spec, end);
    for (Window &time : fault.times) time = {time.from - start_, time.to - start_};
    list.push_back(std::move(fault));
  }
  return list;
}

}  // namespace vericansim

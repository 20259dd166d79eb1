// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See cycle_meter.hpp.
#include "simulation/cycle_meter.hpp"

#include <algorithm>

namespace vericansim {

void CycleMeter::Spread::add(Time value) {
  shortest = count == 0 ? value : std::min(shortest, value);
  longest = std::max(longest, value);
  sum += value;
  ++count;
}

void CycleMeter::on_frame(const BusFrame &frame, bool trigger, Time busy) {
  if (trigger) begin_cycle(frame, busy);
  if (frame.sender != BusFrame::kNobody) free_[frame.sender] = frame.end;
}

void CycleMeter::begin_cycle(const BusFrame &frame, Time busy) {
  if (cycle_) {
    traffic_.add(busy - cycle_->busy);
    period_.add(frame.end - cycle_->end);
  }
  cycle_ = Cycle{frame.end, busy};
  const auto asked = std::find_if(asked_.begin(), asked_.end(),
                                  [&](const Asked &one) { return one.frame == frame.frame; });
  wanted_.reset();
  if (asked == asked_.end()) return;  // not by a command, or the repetition of one
  wanted_ = std::max(asked->time, free_[frame.sender]);
  asked_.erase(asked_.begin(), asked + 1);
}

void CycleMeter::acted(Time last) {
  if (wanted_) latency_.add(last - *wanted_);
}

void CycleMeter::describe(RemoteReport &report) const {
  report.latency_shortest = latency_.shortest;
  report.latency_longest = latency_.longest;
  if (traffic_.count == 0) return;
  report.traffic_shortest = traffic_.shortest;
  report.traffic_longest = traffic_.longest;
  report.traffic_mean = traffic_.sum / traffic_.count;
  report.cycle_load = static_cast<double>(traffic_.sum) / static_cast<double>(period_.sum);
}

}  // namespace vericansim

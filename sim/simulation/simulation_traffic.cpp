// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulation: the traffic of the scenario, and which of its frames the bus has seen.
#include <limits>

#include "simulation/simulation.hpp"

namespace vericansim {

void Simulation::start_traffic() {
  for (const TrafficSpec &spec : scenario_.traffic) {
    // No message has the numbers of another one, with another seed either.
    const std::uint64_t stream = scenario_.seed << 32 | (traffic_.size() + 1);
    traffic_.push_back(std::make_unique<TrafficSource>(spec, bus_, *stations_[spec.node].host,
                                                       stream * 0x9E3779B97F4A7C15ULL));
    traffic_.back()->start(start_, start_ + scenario_.duration);
  }
}

// Nodes that have sent a frame together (AR-10) have each a message of their own that it ends.
FrameOrigin Simulation::origin_of(const BusFrame &frame) {
  FrameOrigin origin;
  for (NodeId node = 0; node < stations_.size(); ++node) {
    if (!frame.sent_by(node)) continue;
    const FrameOrigin own = origin_at(node, frame);
    if (origin.message < 0) origin = own;
  }
  return origin;
}

// Several messages of a node may have one identifier; what they hold tells them apart, or it was
// the one that has waited longest.
std::optional<std::size_t> Simulation::message_of(NodeId node, const Frame &frame) const {
  constexpr Time kNotDue = std::numeric_limits<Time>::max();
  std::optional<std::size_t> message;
  Time earliest = kNotDue;
  for (std::size_t i = 0; i < traffic_.size(); ++i) {
    if (traffic_[i]->spec().node != node || !traffic_[i]->matches(frame)) continue;
    const Time event = traffic_[i]->due(frame).value_or(kNotDue);
    if (message && event >= earliest) continue;
    message = i;
    earliest = event;
  }
  return message;
}

FrameOrigin Simulation::origin_at(NodeId node, const BusFrame &frame) {
  forget_lost(node, frame.end);
  sent_[node].seen(frame.frame, frame.end);
  const auto message = message_of(node, frame.frame);
  if (!message) return {};
  FrameOrigin origin;
  origin.message = static_cast<int>(*message);
  origin.response = traffic_[*message]->on_frame(frame.frame, frame.end);
  return origin;
}

// Else the next frame that is alike would be taken for it, and so on to the end of the run.
void Simulation::forget_lost(NodeId node, Time time) {
  for (const Frame &frame : sent_[node].lost(time))
    if (const auto message = message_of(node, frame)) traffic_[*message]->forget(frame);
}

void Simulation::on_sent(NodeId node, const Frame &frame) {
  forget_lost(node, bus_.now());
  sent_[node].told(frame, bus_.now());
  if (on_host_sent) on_host_sent(node);
  for (const auto &traffic : traffic_)
    if (traffic->spec().node == node && traffic->matches(frame)) return traffic->on_sent();
}

}  // namespace vericansim

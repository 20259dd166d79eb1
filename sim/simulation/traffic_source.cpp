// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TrafficSource: periodic, single and saturated messages.
#include "simulation/traffic_source.hpp"

#include <algorithm>
#include <stdexcept>

#include "model/same_identifier.hpp"

namespace vericansim {

TrafficSource::TrafficSource(const TrafficSpec &spec, Bus &bus, Host &host, std::uint64_t seed)
    : spec_{spec}, bus_{bus}, host_{host}, random_{seed} {
  spec.frame.validate();
  if (spec.period < 0 || spec.offset < 0 || spec.jitter < 0)
    throw std::invalid_argument("traffic: no time may be negative");
  if (spec.random_offset && spec.period == 0)
    throw std::invalid_argument("traffic: a random offset needs a period");
  report_.name = spec.name;
  report_.node = host.node().name();
}

bool TrafficSource::matches(const Frame &frame) const {
  return same_identifier(frame, spec_.frame);
}

void TrafficSource::start(Time start, Time stop) {
  stop_ = stop;
  Time first = start + spec_.offset;
  if (spec_.random_offset)
    first = start + static_cast<Time>(random_() % static_cast<std::uint64_t>(spec_.period));
  schedule(first);
}

void TrafficSource::schedule(Time event) {
  if (event >= stop_ || report_.queued >= spec_.count) return;
  // Each event before the end has its frame, whatever the seed.
  const Time most = std::min(spec_.jitter, stop_ - event);
  const Time late = most == 0 ? 0 : static_cast<Time>(random_() % static_cast<std::uint64_t>(most));
  bus_.at(event + late, [this, event] {
    queue(event);
    // A second frame of a saturated message waits while the first is on the wire.
    if (spec_.saturated) queue(event);
    if (spec_.period != 0) schedule(event + spec_.period);
  });
}

void TrafficSource::queue(Time event) {
  if (report_.queued >= spec_.count) return;
  const Frame frame = next_frame();
  host_.send(frame);
  waiting_.push_back({event, frame});
}

Frame TrafficSource::next_frame() {
  Frame frame = spec_.frame;
  const std::uint64_t value = spec_.data == DataKind::kRandom ? random_() : report_.queued;
  if (spec_.data != DataKind::kFixed)
    for (unsigned i = 0; i < frame.payload_size(); ++i)
      frame.data[i] = static_cast<std::uint8_t>(value >> 8 * i);
  ++report_.queued;
  return frame;
}

void TrafficSource::on_sent() {
  if (spec_.saturated && bus_.now() < stop_) queue(bus_.now());
}

std::deque<TrafficSource::Waiting>::const_iterator TrafficSource::find(const Frame &frame) const {
  return std::find_if(waiting_.begin(), waiting_.end(),
                      [&frame](const Waiting &waiting) { return waiting.frame == frame; });
}

std::optional<Time> TrafficSource::due(const Frame &frame) const {
  const auto found = find(frame);
  if (found == waiting_.end()) return std::nullopt;
  return found->event;
}

std::optional<Time> TrafficSource::on_frame(const Frame &frame, Time end) {
  const auto found = find(frame);
  if (found == waiting_.end()) return std::nullopt;
  const Time response = end - found->event;
  waiting_.erase(found);
  ++report_.sent;
  report_.shortest = report_.sent == 1 ? response : std::min(report_.shortest, response);
  report_.longest = std::max(report_.longest, response);
  report_.sum += response;
  return response;
}

void TrafficSource::forget(const Frame &frame) {
  if (const auto found = find(frame); found != waiting_.end()) waiting_.erase(found);
}

MessageReport TrafficSource::report() const {
  MessageReport report = report_;
  for (const Waiting &waiting : waiting_)
    report.waiting = std::max(report.waiting, bus_.now() - waiting.event);
  return report;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults: see faults.hpp.
#include "bus/faults.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bus/bus.hpp"

namespace vericansim {

void require_node(NodeId id, bool others) {
  if (id < Bus::kMaxNodes || (others && (id == kBusPoint || id == kAllNodes))) return;
  throw std::invalid_argument("a fault needs a node, 0 to " + std::to_string(Bus::kMaxNodes - 1) +
                              (others ? ", kAllNodes or kBusPoint" : "") + ", got " +
                              std::to_string(id));
}

void ScheduledFaults::add(NodeId victim, Effect effect, Window window, FaultLog *log) {
  require_node(victim, true);
  const Entry entry{window, effect, log};
  if (victim != kAllNodes) return insert(receiver(victim), entry);
  for_everybody_.push_back(entry);
  insert(point_, entry);
  for (Receiver &receiver : receivers_) insert(receiver, entry);
}

void ScheduledFaults::insert(Receiver &receiver, const Entry &entry) {
  const auto later = [](Time from, const Entry &e) { return from < e.window.from; };
  auto &list = receiver.entries;
  list.insert(std::upper_bound(list.begin(), list.end(), entry.window.from, later), entry);
}

ScheduledFaults::Receiver &ScheduledFaults::receiver(NodeId id) {
  if (id == kBusPoint) return point_;
  while (receivers_.size() <= id) {
    receivers_.emplace_back();
    for (const Entry &entry : for_everybody_) insert(receivers_.back(), entry);
  }
  return receivers_[id];
}

Level ScheduledFaults::level(NodeId id, Time t, Level level) {
  Receiver &who = receiver(id);
  const auto &list = who.entries;
  while (who.head < list.size() && list[who.head].window.to <= t) ++who.head;
  for (std::size_t i = who.head; i < list.size() && list[i].window.from <= t; ++i) {
    const Entry &entry = list[i];
    if (!entry.window.contains(t)) continue;
    const Level changed = apply_effect(entry.effect, level);
    if (changed != level && entry.log != nullptr && id != kBusPoint) entry.log->mark(t);
    level = changed;
  }
  return level;
}

void ClockFault::attach(Bus &bus) {
  if (node_ >= bus.size())
    throw std::invalid_argument("a fault of a clock needs a node of the bus, got " +
                                std::to_string(node_));
  Node &node = bus.node(node_);
  Clock{node.oscillator()}.set_error_ppm(error_ppm_);  // refuses here what it would refuse then
  bus.at(when_, [this, &bus, &node] {
    if (node.oscillator().config().error_ppm != error_ppm_) took_effect(node_, when_);
    node.oscillator().set_error_ppm(error_ppm_);
    bus.clocks_changed();
  });
}

// The place register of the core moves on at the sample point, so at the boundary it already tells
// the bit that begins.
void PlaceTracker::clocked(std::uint64_t word) {
  if (ending_) {
    enter(word);
  } else {
    ++clocks_;
  }
  ending_ = (word & kTraceBoundary) != 0;
}

void PlaceTracker::enter(std::uint64_t word) {
  const Field field = trace_field(word);
  const unsigned left = trace_left(word);
  const bool stuff = trace_stuff(word);
  // A stuff bit has the index of the bit that it delays.
  if (!goes_on(field, left, field_, left_)) {
    index_ = 0;
  } else if (!stuff_) {
    ++index_;
  }
  // An own frame begins with SOF, a foreign or a joined one with ID28.
  const bool foreign = field == Field::kId && field_ != Field::kId && field_ != Field::kSof;
  if (foreign || (field == Field::kSof && field_ != Field::kSof)) ++frame_;
  field_ = field;
  left_ = left;
  stuff_ = stuff;
  clocks_ = 0;
}

bool PlaceSpec::matches(const PlaceTracker &at) const {
  return (!frame || *frame == at.frame()) && (!field || *field == at.field()) &&
         (!index || *index == at.index()) && (!left || *left == at.left()) &&
         (!stuff || *stuff == at.stuff()) && at.clocks() >= first_clock &&
         at.clocks() <= last_clock;
}

Level PlaceFault::level(NodeId receiver, Time t, Level level) {
  if (!active_ || (receiver != victim_ && victim_ != kAllNodes)) return level;
  const Level changed = apply_effect(effect_, level);
  if (changed != level) took_effect(receiver, t);
  return changed;
}

void PlaceFault::clocked(NodeId node, Time, std::uint64_t word) {
  if (node != watched_) return;
  tracker_.clocked(word);
  const bool active = place_.matches(tracker_);
  if (active && (!active_ || tracker_.fresh())) ++hits_;
  active_ = active;
}

NoiseFault::NoiseFault(const NoiseConfig &config) : config_{config} {
  const auto is_probability = [](double p) { return p >= 0.0 && p <= 1.0; };
  if (!is_probability(config.per_bit) || !is_probability(config.per_ns)) {
    throw std::invalid_argument("noise: probabilities must be 0 to 1");
  }
  if (config.per_ns > 0.0 && config.glitch <= 0)
    throw std::invalid_argument("noise: a glitch must last, got " + std::to_string(config.glitch) +
                                " ps");
  if (config.victim != kAllNodes) require_node(config.victim);
}

NoiseFault::Victim &NoiseFault::victim(NodeId id) {
  while (victims_.size() <= id) {
    Victim fresh;
    fresh.random.seed(config_.seed * 0x9E3779B97F4A7C15ULL + victims_.size());
    fresh.next_glitch = config_.window.from + draw_gap(fresh);
    victims_.push_back(fresh);
  }
  return victims_[id];
}

// Glitches come as a Poisson process.
Time NoiseFault::draw_gap(Victim &victim) const {
  if (config_.per_ns <= 0.0) return config_.window.to / 2;
  std::exponential_distribution<double> gap{config_.per_ns / static_cast<double>(kNanosecond)};
  constexpr double kFar = 4e18;  // so that it fits behind any time of a run
  return static_cast<Time>(std::min(gap(victim.random), kFar));
}

Level NoiseFault::level(NodeId receiver, Time t, Level level) {
  if (receiver == kBusPoint || !config_.window.contains(t)) return level;
  if (config_.victim != kAllNodes && config_.victim != receiver) return level;
  Victim &who = victim(receiver);
  while (config_.per_ns > 0.0 && t >= who.next_glitch) {
    who.glitch_end = who.next_glitch + config_.glitch;
    who.next_glitch += draw_gap(who);
    ++hits_;
  }
  if (!who.bit_hit && t >= who.glitch_end) return level;
  if (log() != nullptr) log()->mark(t, receiver);
  return !level;
}

void NoiseFault::clocked(NodeId node, Time, std::uint64_t word) {
  if (config_.per_bit <= 0.0) return;
  Victim &who = victim(node);
  who.tracker.clocked(word);
  if (!who.tracker.fresh()) return;
  std::bernoulli_distribution flip{config_.per_bit};
  who.bit_hit = flip(who.random);
  if (who.bit_hit) ++hits_;
}

}  // namespace vericansim

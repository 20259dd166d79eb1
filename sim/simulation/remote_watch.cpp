// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteWatch: see remote_watch.hpp.
#include "simulation/remote_watch.hpp"

#include <algorithm>
#include <cmath>

#include "trace/remote_words.hpp"

namespace vericansim {
namespace {

double bit_ps(Bus &bus, const BitTiming &timing, NodeId id) {
  return timing.clocks_per_bit() * 1e12 / bus.node(id).oscillator().nominal_hz();
}

}  // namespace

Time skew_bound(Bus &bus, NodeId sender, NodeId a, NodeId b, const std::vector<BitTiming> &timings,
                double ppm) {
  const auto delay = [&](NodeId id) { return static_cast<double>(bus.delay(sender, id)); };
  double quantum = 0, clock = 0, bit = 0;
  for (const NodeId id : {a, b}) {
    const double hz = bus.node(id).oscillator().nominal_hz();
    clock = std::max(clock, 1e12 / hz);
    quantum = std::max(quantum, timings[id].prescaler * 1e12 / hz);
    bit = std::max(bit, bit_ps(bus, timings[id], id));
  }
  const auto sample_point = [&](NodeId id) {
    return (timings[id].quanta() - timings[id].ps2) / static_cast<double>(timings[id].quanta()) *
           bit_ps(bus, timings[id], id);
  };
  return static_cast<Time>(std::fabs(delay(a) - delay(b)) + quantum + 3 * clock +
                           std::fabs(sample_point(a) - sample_point(b)) + 44 * ppm * 1e-6 * bit);
}

RemoteWatch::RemoteWatch(Bus &bus, const std::vector<WatchedUnit> &units,
                         std::vector<BitTiming> timings, double ppm)
    : bus_{bus}, timings_{std::move(timings)}, ppm_{ppm} {
  unit_of_.assign(timings_.size(), units.size());
  for (const WatchedUnit &one : units) {
    unit_of_[one.node] = units_.size();
    Unit unit;
    unit.report.name = one.unit->name();
    unit.report.rtl = one.rtl;
    unit.report.number = one.number;
    unit.watched = one;
    unit.staged.fill(-1);
    units_.push_back(std::move(unit));
  }
}

// ---- Frames

bool RemoteWatch::is_trigger(const Frame &frame) const {
  return !units_.empty() && !frame.extended && !frame.remote && frame.dlc <= 1 &&
         frame.id == units_.front().watched.config.id(0, 0, 1);
}

void RemoteWatch::commanded(const Frame &frame) {
  if (is_trigger(frame)) meter_.commanded(frame, bus_.now());
}

void RemoteWatch::on_frame(const BusFrame &frame, Time busy) {
  for (Unit &unit : units_) look(unit);
  const Frame &f = frame.frame;
  const bool trigger = is_trigger(f);
  if (trigger) take_trigger(frame);
  meter_.on_frame(frame, trigger, busy);
  if (trigger) return;
  if (f.extended || units_.empty()) return;
  const RemoteConfig &config = units_.front().watched.config;
  const unsigned name = f.id >> config.address_bits() & config.highest_number();
  const unsigned a = f.id & ((1U << config.address_bits()) - 1);
  if ((f.id >> 10 & 1) != 0) return take_statement(frame, name, a);
  if (f.remote || f.dlc > 8) return;
  take_request(f, name, a);
}

void RemoteWatch::take_request(const Frame &frame, unsigned name, unsigned a) {
  if (name == 0) {
    if (a == 0) take_state(frame);
    return;
  }
  for (Unit &unit : units_)
    if (name == 1 || name == unit.watched.number) take_write(unit, frame, a);
}

void RemoteWatch::take_state(const Frame &frame) {
  if (frame.dlc == 0 || frame.dlc > 2) return;
  const unsigned number = frame.dlc == 2 ? frame.data[1] : 0;
  for (Unit &unit : units_)
    if (number == 0 || number == unit.watched.number) unit.expected = frame.data[0] == 0x01;
}

// RN-46: whichever command writes them, staged bytes go to the shadow.
void RemoteWatch::take_write(Unit &unit, const Frame &frame, unsigned a) {
  const RemoteConfig &config = unit.watched.config;
  unsigned first = 0;
  if (a == config.first_port() + static_cast<unsigned>(RemotePort::kWrite)) {
    if (frame.dlc < 3) return;
    first = 2;
    a = frame.data[0] | frame.data[1] << 8U;
  } else if (a + frame.dlc > config.first_port()) {
    return;
  }
  for (unsigned i = first; i < frame.dlc; ++i) {
    const unsigned address = a + i - first;
    if (address >= remote_map::kStage && address < remote_map::kStage + config.stage_bytes)
      unit.staged[address - remote_map::kStage] = frame.data[i];
  }
}

void RemoteWatch::take_statement(const BusFrame &frame, unsigned name, unsigned a) {
  const Frame &f = frame.frame;
  for (Unit &unit : units_) {
    if (!unit.measured || name != unit.watched.number || a != unit.measured_at || f.dlc != 4)
      continue;
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) word |= std::uint32_t{f.data[i]} << (8 * i);
    if (word != *unit.measured) continue;
    unit.measured.reset();
    RemoteNodeReport &report = unit.report;
    const Time response = frame.end - unit.acted;
    report.shortest = report.statements == 0 ? response : std::min(report.shortest, response);
    report.longest = std::max(report.longest, response);
    report.sum += response;
    ++report.statements;
  }
}

void RemoteWatch::take_trigger(const BusFrame &frame) {
  ++report_.triggers;
  const Time bit = static_cast<Time>(bit_ps(bus_, timings_.front(), 0));
  end_cycle(frame.end - bit);
  trigger_ = frame;
  expected_.clear();
  for (const Unit &unit : units_) expected_.push_back(unit.expected);
}

// ---- Actions

void RemoteWatch::applied(std::size_t index) {
  actions_.push_back({index, bus_.now()});
  Unit &unit = units_[index];
  ++unit.report.applied;
  if (unit.measured) ++unit.report.late_statements;
  unit.measured.reset();
  unit.acted = bus_.now();
  // In a clock edge of the node nothing may be asked of it.
  bus_.at(bus_.now() + 1, [this, index, wanted = unit.staged] { compare_stage(index, wanted); });
}

void RemoteWatch::compare_stage(std::size_t index, const std::array<int, kStageBytes> &wanted) {
  Unit &unit = units_[index];
  for (unsigned i = 0; i < kStageBytes; ++i) {
    if (wanted[i] < 0 || unit.watched.unit->peek(remote_map::kStage + i) == wanted[i]) continue;
    ++unit.report.lost_set_points;
    return;
  }
}

void RemoteWatch::measured(std::size_t index, unsigned address, std::uint32_t word) {
  units_[index].measured = word;
  units_[index].measured_at = address;
}

// The actions of the last TRIGGER are those before `until`.
void RemoteWatch::end_cycle(Time until) {
  std::vector<Action> actions, later;
  for (const Action &action : actions_) (action.time < until ? actions : later).push_back(action);
  actions_ = std::move(later);
  if (!trigger_) return;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const bool acted = std::any_of(actions.begin(), actions.end(),
                                   [&](const Action &action) { return action.unit == i; });
    units_[i].report.awaited += expected_[i];
    if (expected_[i] != 0 && !acted) ++units_[i].report.lost_set_points;
  }
  tell_cycle(actions);
  if (!actions.empty()) compare_actions(actions);
}

void RemoteWatch::tell_cycle(const std::vector<Action> &actions) const {
  if (!on_cycle) return;
  Time first = actions.empty() ? 0 : actions.front().time, last = first;
  for (const Action &action : actions) {
    first = std::min(first, action.time);
    last = std::max(last, action.time);
  }
  on_cycle(*trigger_, actions.size(), last - first);
}

void RemoteWatch::compare_actions(const std::vector<Action> &actions) {
  const auto [first, last] =
      std::minmax_element(actions.begin(), actions.end(),
                          [](const Action &a, const Action &b) { return a.time < b.time; });
  if (last_action_) {
    const Time period = first->time - *last_action_;
    Time &shortest = report_.period_shortest;
    shortest = shortest == 0 ? period : std::min(shortest, period);
    report_.period_longest = std::max(report_.period_longest, period);
  }
  last_action_ = first->time;
  meter_.acted(last->time);
  if (actions.size() < 2) return;
  ++report_.compared;
  skew_sum_ += last->time - first->time;
  report_.skew_longest = std::max(report_.skew_longest, last->time - first->time);
  bool above = false;
  for (const Action &a : actions)
    for (const Action &b : actions) {
      if (a.unit >= b.unit) continue;
      const Time bound = skew_bound(bus_, trigger_->sender, units_[a.unit].watched.node,
                                    units_[b.unit].watched.node, timings_, ppm_);
      report_.skew_bound = std::max(report_.skew_bound, bound);
      above = above || std::abs(a.time - b.time) > bound;
    }
  if (above) ++report_.above_bound;
}

// ---- Nodes

// One frame counts once at most, so the counters of STATUS cannot pass 256 unseen.
void RemoteWatch::look(Unit &unit) {
  RemoteUnit &node = *unit.watched.unit;
  const std::array<std::uint8_t, 2> now{node.peek(remote_map::kStatus + 5),
                                        node.peek(remote_map::kStatus + 6)};
  unit.report.accepted += static_cast<std::uint8_t>(now[0] - unit.counts[0]);
  unit.report.refused += static_cast<std::uint8_t>(now[1] - unit.counts[1]);
  unit.counts = now;
}

void RemoteWatch::on_bit(NodeId node, const BitRecord &bit) {
  if (unit_of_[node] >= units_.size()) return;
  Unit &unit = units_[unit_of_[node]];
  const bool operates = !unit.watched.unit->safe();
  if (unit.operates && !operates) {
    ++unit.report.went_safe;
    unit.report.last_safe = bit.time - start_;
  }
  unit.operates = operates;
}

RemoteReport RemoteWatch::report() {
  end_cycle(bus_.now() + 1);
  trigger_.reset();
  report_.nodes.clear();
  for (Unit &unit : units_) {
    look(unit);
    unit.report.state = remote_state_name(static_cast<unsigned>(unit.watched.unit->state()));
    report_.nodes.push_back(unit.report);
  }
  if (report_.compared != 0) report_.skew_mean = skew_sum_ / static_cast<Time>(report_.compared);
  meter_.describe(report_);
  return report_;
}

}  // namespace vericansim

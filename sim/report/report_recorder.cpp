// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportRecorder: see report_recorder.hpp.
#include "report/report_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace vericansim {
namespace {

std::uint16_t clamp16(std::uint64_t value) {
  return static_cast<std::uint16_t>(std::min<std::uint64_t>(value, 0xFFFF));
}

std::uint32_t id_word(const Frame &frame) {
  return frame.id | (frame.extended ? 1U << 31 : 0U) | (frame.remote ? 1U << 30 : 0U);
}

/// Whether a node can receive something else than the wire carries.
bool rx_can_differ(const Bus &bus) {
  if (bus.has_faults()) return true;
  for (NodeId from = 0; from < bus.size(); ++from)
    for (NodeId to = 0; to < bus.size(); ++to)
      if (bus.delay(from, to) != 0) return true;
  return false;
}

}  // namespace

ReportRecorder::ReportRecorder(Bus &bus, BusMonitor &monitor, ReportSetup setup,
                               std::uint64_t limit)
    : bus_{bus}, monitor_{monitor}, setup_{std::move(setup)}, limit_{limit} {
  if (setup_.timings.size() != bus.size())
    throw std::invalid_argument("a report needs the bit timing of each node");
  monitor_.on_event = [this, next = monitor_.on_event](const BusEvent &event) {
    events_->take(event);
    if (next) next(event);
  };
  begin();
}

void ReportRecorder::begin() {
  start_ = bus_.now();
  wall_start_ = std::chrono::steady_clock::now();
  data_ = ReportData{};
  data_.wire = EdgeList{start_, bus_.level()};
  reset_nodes();
  segments_ = std::make_unique<SegmentBuilder>(bus_.size(), start_, data_);
  events_ = std::make_unique<EventMatcher>(setup_.bit_time, start_, data_);
  settled_losses_ = 0;
  details_ = true;
  finished_ = false;
}

void ReportRecorder::reset_nodes() {
  const bool with_rx = rx_can_differ(bus_);
  const std::vector<NodeState> old = std::exchange(nodes_, {});
  for (NodeId id = 0; id < bus_.size(); ++id) {
    nodes_.emplace_back(BitTrack{setup_.timings[id], bus_.node(id).oscillator()});
    NodeState &node = nodes_.back();
    node.tx.level = node.tx.before = bus_.node(id).tx();
    if (!old.empty()) {
      node.rx = old[id].rx;
      node.track = old[id].track;
      node.passive = old[id].passive;
      node.off = old[id].off;
      node.tec = old[id].tec;
      node.rec = old[id].rec;
    }
    add_counters(id, 0);
    data_.tx.emplace_back(start_, node.tx.level);
    if (with_rx) data_.rx.emplace_back(start_, node.rx.level);
  }
}

void ReportRecorder::Pin::change(Time time, Level to) {
  before = level;
  level = to;
  changed = time;
}

void ReportRecorder::on_level(Time time, Level level) {
  if (details_) data_.wire.change(time, level);
}

void ReportRecorder::on_node_tx(NodeId node, Time time, Level level) {
  nodes_[node].tx.change(time, level);
  if (details_) data_.tx[node].change(time, level);
}

void ReportRecorder::on_node_rx(NodeId node, Time time, Level level) {
  nodes_[node].rx.change(time, level);
  if (details_ && !data_.rx.empty()) data_.rx[node].change(time, level);
}

void ReportRecorder::on_bit(NodeId id, const BitRecord &record) {
  NodeState &node = nodes_[id];
  const TrackedBit before = node.track.bit();
  TrackedBit bit = node.track.take(record);
  // What the pin shows: in listen-only and loop-back mode the core sends nothing.
  bit.tx = node.tx.at(record.time - 1);
  if (record.time > start_ && details_) segments_->take(id, bit);
  find_trouble(id, before, bit, record.after);
  count_attempts(id, bit, record.after);
  note_counters(id, bit, record.after);
}

void ReportRecorder::find_trouble(NodeId id, const TrackedBit &before, const TrackedBit &bit,
                                  const Trace &after) {
  NodeState &node = nodes_[id];
  Finding finding;
  finding.node = id;
  // An overload flag begins behind the bit that asks for it; index 0 again: another one.
  const bool first_flag_bit = bit.field == Field::kOvlFlag && bit.index == 0;
  if (first_flag_bit && before.field != Field::kOvlFlag) {
    finding.bit = before;
    events_->find(finding);
  }
  if (bit.field == Field::kOvlFlag) node.after_overload = true;
  if (bit.field == Field::kErrFlag) node.after_overload = false;
  if (after.errors != 0) {
    finding.bit = bit;
    finding.errors = after.errors;
    finding.after_overload = node.after_overload;
    finding.passive = node.passive;
    finding.to_bus_off = after.bus_off && !node.off;
    events_->find(finding);
  }
  if (before.field == Field::kDel && bit.field != Field::kDel)
    events_->delimiter_ended(id, bit.start);
}

void ReportRecorder::count_attempts(NodeId id, const TrackedBit &bit, const Trace &after) {
  NodeState &node = nodes_[id];
  // A loss whose winner did not get beyond the arbitration field keeps nobody.
  if (bit.begins && after.transmitter) settled_losses_ = data_.losses.winner.size();
  if (bit.transmitter && bit.field >= Field::kR1 && bit.field <= Field::kEof) settle_losses(id);
  if (after.tx_fail && after.errors != 0) ++node.failed;
  if (after.tx_fail && after.errors == 0) {
    ++node.lost;
    LossColumns &to = data_.losses;
    to.time.push_back(ns(static_cast<double>(bit.time)));
    to.node.push_back(static_cast<std::uint8_t>(id));
    to.field.push_back(static_cast<std::uint8_t>(bit.field));
    to.index.push_back(bit.index);
    to.winner.push_back(kNoNode);
  }
  if (!after.tx_ok) return;
  node.done_failed = std::exchange(node.failed, 0);
  node.done_lost = std::exchange(node.lost, 0);
}

// Who still transmits behind the arbitration field has won.
void ReportRecorder::settle_losses(NodeId winner) {
  auto &winners = data_.losses.winner;
  for (; settled_losses_ < winners.size(); ++settled_losses_)
    winners[settled_losses_] = static_cast<std::uint8_t>(winner);
}

void ReportRecorder::note_counters(NodeId id, const TrackedBit &bit, const Trace &after) {
  NodeState &node = nodes_[id];
  const unsigned tec = after.bus_off ? 256U : after.tec;
  const bool same = tec == node.tec && after.rec == node.rec && after.passive == node.passive &&
                    after.bus_off == node.off;
  if (same) return;
  node.tec = tec;
  node.rec = after.rec;
  node.passive = after.passive;
  node.off = after.bus_off;
  add_counters(id, ns(static_cast<double>(bit.time)));
}

void ReportRecorder::add_counters(NodeId id, double time_ns) {
  const NodeState &node = nodes_[id];
  CounterColumns &to = data_.counters;
  to.time.push_back(time_ns);
  to.node.push_back(static_cast<std::uint8_t>(id));
  to.tec.push_back(static_cast<std::uint16_t>(node.tec));
  to.rec.push_back(static_cast<std::uint16_t>(node.rec));
  to.state.push_back(node.off ? 2 : node.passive ? 1 : 0);
}

void ReportRecorder::add(const BusFrame &frame, const FrameOrigin &origin) {
  FrameColumns &to = data_.frames;
  const bool known = frame.sender < nodes_.size();
  to.start.push_back(ns(static_cast<double>(frame.start)));
  to.end.push_back(ns(static_cast<double>(frame.end)));
  to.sender.push_back(known ? static_cast<std::uint8_t>(frame.sender) : kNoNode);
  to.id.push_back(id_word(frame.frame));
  to.dlc.push_back(frame.frame.dlc);
  to.data.insert(to.data.end(), frame.frame.data.begin(), frame.frame.data.end());
  to.message.push_back(static_cast<std::int16_t>(origin.message));
  to.response.push_back(origin.response ? static_cast<double>(*origin.response) / 1e3
                                        : std::numeric_limits<double>::quiet_NaN());
  to.retries.push_back(known ? clamp16(nodes_[frame.sender].done_failed) : 0);
  to.lost.push_back(known ? clamp16(nodes_[frame.sender].done_lost) : 0);
  if (details_ && to.start.size() >= limit_) end_details(bus_.now());
}

void ReportRecorder::end_details(Time time) {
  segments_->finish();
  details_ = false;
  details_end_ = time;
}

void ReportRecorder::finish() {
  if (std::exchange(finished_, true)) return;
  end_ = bus_.now();
  wall_end_ = std::chrono::steady_clock::now();
  events_->finish();
  if (details_) end_details(end_);
  const double bit = static_cast<double>(setup_.bit_time) / 1e3;
  const double last = ns(static_cast<double>(details_end_));
  const auto locate = [&](const std::vector<double> &times, double slack,
                          std::vector<std::uint32_t> &to) {
    to.clear();
    for (const double time : times)
      to.push_back(time > last ? kNoSegment : data_.segment_at(time + slack));
  };
  // The decoder's grid follows the wire, a node's lags by its synchroniser and the cable.
  locate(data_.frames.start, bit, data_.frames.segment);
  locate(data_.events.start, bit / 2, data_.events.segment);
  locate(data_.losses.time, 0, data_.losses.segment);
}

double ReportRecorder::wall_seconds() const {
  return std::chrono::duration<double>(wall_end_ - wall_start_).count();
}

}  // namespace vericansim

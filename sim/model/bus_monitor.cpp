// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusMonitor: from levels and traces to counts.
#include "model/bus_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace vericansim {
namespace {

DecoderConfig decoder_config(Time bit_time, double sample_point) {
  DecoderConfig config;
  config.bit_time = bit_time;
  if (!(sample_point > 0 && sample_point < 1))
    throw std::invalid_argument(
        fmt::format("sample point must be above 0 and below 1, got {:g}", sample_point));
  config.sample_point = std::clamp(static_cast<int>(sample_point * 1000), 1, 999);
  return config;
}

}  // namespace

BusMonitor::BusMonitor(const Bus &bus, Time bit_time, double sample_point)
    : bus_{bus},
      bit_time_{bit_time},
      nodes_(bus.size()),
      sending_(bus.size()),
      decoder_{decoder_config(bit_time, sample_point),
               [this](const BusEvent &e) { take_event(e); }} {
  decoder_.on_level(bus.now(), bus.level());
}

void BusMonitor::on_level(Time time, Level level) {
  decoder_.on_level(time, level);
  settle(time);
}

void BusMonitor::advance(Time time) {
  decoder_.finish(time);
  settle(time);
}

void BusMonitor::settle_all(Time time) {
  decoder_.finish(time);
  settle(std::numeric_limits<Time>::max());
}

void BusMonitor::close(Time time) {
  settle_all(time);
  hold_up_to_rest(time);
  if (held_until_ > time) busy_ -= held_until_ - time;  // intermission that is not over
  const std::optional<Time> start = decoder_.under_way();
  if (!start) return;
  hold(*start, time);
  if (decoder_.kind_under_way() == BusEventKind::kErrorFrame) ++error_frames_;
  if (decoder_.kind_under_way() == BusEventKind::kOverloadFrame) ++overload_frames_;
}

void BusMonitor::count_errors(NodeCounts &counts, std::uint8_t errors) {
  if (errors == 0) return;
  ++counts.errors;
  for (unsigned kind = 0; kind < counts.by_kind.size(); ++kind)
    counts.by_kind[kind] += (errors >> kind) & 1;
}

void BusMonitor::on_bit(NodeId node, const BitRecord &bit) {
  NodeCounts &counts = nodes_[node];
  const Trace &after = bit.after;
  // The node's last frame is settled before its next one, also where no edge on the bus shows it.
  if (after.start && after.transmitter) advance(bit.time);
  count_errors(counts, after.errors);
  if (after.start) {
    counts.sending = after.transmitter;
    if (after.transmitter) ++counts.attempts;
  }
  if (after.rx_valid && !after.transmitter) ++counts.delivered;
  if (after.tx_fail && after.errors == 0) ++counts.lost_arbitration;
  if (after.tx_ok) ++counts.sent;
  if (after.tx_ok || after.tx_fail) counts.sending = false;
  if (bit.at.transmitter) follow_transmitter(node, bit);
  if (after.bus_off && !counts.off) ++counts.bus_off;
  counts.off = after.bus_off;
  counts.passive = after.passive;
  counts.tec = after.bus_off ? 256U : after.tec;
  counts.rec = after.rec;
  counts.max_tec = std::max(counts.max_tec, counts.tec);
  if (!after.bus_off) counts.max_rec = std::max(counts.max_rec, counts.rec);
  settle(bit.time);
}

// Behind arbitration all transmitters of a bus send one frame. Only the pin tells a node in
// loop-back from them; two dominant bits in a row, as the reserved bits are, show there for sure,
// wherever in the bit it is looked at.
void BusMonitor::follow_transmitter(NodeId node, const BitRecord &bit) {
  Sending &sending = sending_[node];
  if (bus_.node(node).tx() == Level::kDominant) sending.dominant = bit.time;
  if (bit.at.field == Field::kCrc) sending.crc = bit.time;
  if (bit.after.tx_ok) sending.success = bit.time;
}

// The bus is held from `from` to `to`. Flags overlap the intermission that a frame is given, and so
// does a SOF in its last bit: no time counts twice.
void BusMonitor::hold(Time from, Time to) {
  from = std::max(from, held_until_);
  if (to <= from) return;
  busy_ += to - from;
  held_until_ = to;
}

// What the decoder has not understood goes on until it is at rest again, at `now` at the latest.
void BusMonitor::hold_up_to_rest(Time now) {
  if (lost_since_) hold(*lost_since_, decoder_.at_rest_since().value_or(now));
  lost_since_.reset();
}

void BusMonitor::take_event(const BusEvent &event) {
  constexpr Time kIntermission = 3;
  hold_up_to_rest(event.start);
  switch (event.kind) {
    case BusEventKind::kFrame:
      hold(event.start, event.end + kIntermission * bit_time_);
      // What a lone error-passive transmitter repeats looks whole to a listener (MO-03).
      if (!event.acked) {
        ++unacknowledged_;
        break;
      }
      ++frames_;
      unsettled_.push_back({event.frame, event.start, event.end});
      break;
    case BusEventKind::kOverloadFrame:
      ++overload_frames_;
      hold(event.start, event.end + kIntermission * bit_time_);
      break;
    case BusEventKind::kBadFrame:
      ++error_frames_;
      hold(event.start, event.end + kIntermission * bit_time_);
      break;
    case BusEventKind::kErrorFrame:
      ++error_frames_;
      // From the SOF of the frame that was destroyed, if there was one.
      const bool in_frame = event.field >= Field::kSof && event.field <= Field::kEof;
      hold(in_frame ? event.frame_start : event.start, event.end + kIntermission * bit_time_);
  }
  if (event.without_end()) lost_since_ = event.end;
  if (on_event) on_event(event);
}

// Two bits after its end every node has its view of a frame.
void BusMonitor::settle(Time now) {
  if (unsettled_.empty()) return;
  const auto open = std::find_if(unsettled_.begin(), unsettled_.end(), [&](const BusFrame &frame) {
    return frame.end + 2 * bit_time_ > now;
  });
  for (auto frame = unsettled_.begin(); frame != open; ++frame) {
    add_senders(*frame);
    if (on_frame) on_frame(*frame);
  }
  unsettled_.erase(unsettled_.begin(), open);
}

void BusMonitor::add_senders(BusFrame &frame) const {
  for (NodeId node = 0; node < sending_.size(); ++node) {
    const Sending &sending = sending_[node];
    if (sending.dominant < frame.start || sending.crc < frame.start || sending.crc > frame.end)
      continue;
    frame.transmitters |= 1ULL << node;
    if (sending.success < frame.end - 2 * bit_time_ || sending.success > frame.end + 2 * bit_time_)
      continue;
    frame.senders |= 1ULL << node;
    if (frame.sender == BusFrame::kNobody) frame.sender = node;
  }
}

}  // namespace vericansim

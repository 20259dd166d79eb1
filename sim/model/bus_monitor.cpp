// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusMonitor: from levels and traces to counts.
#include "model/bus_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    : bit_time_{bit_time},
      nodes_(bus.size()),
      decoder_{decoder_config(bit_time, sample_point),
               [this](const BusEvent &e) { take_event(e); }} {
  decoder_.on_level(bus.now(), bus.level());
}

void BusMonitor::on_level(Time time, Level level) {
  decoder_.on_level(time, level);
  settle();
}

void BusMonitor::advance(Time time) {
  decoder_.finish(time);
  settle();
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
  count_errors(counts, after.errors);
  if (after.start && after.transmitter) ++counts.attempts;
  if (after.rx_valid && !after.transmitter) ++counts.delivered;
  if (after.tx_fail && after.errors == 0) ++counts.lost_arbitration;
  if (after.tx_ok) {
    ++counts.sent;
    senders_.emplace_back(node, bit.time);
  }
  if (after.bus_off && !counts.off) ++counts.bus_off;
  counts.off = after.bus_off;
  counts.passive = after.passive;
  counts.tec = after.bus_off ? 256U : after.tec;
  counts.rec = after.rec;
  counts.max_tec = std::max(counts.max_tec, counts.tec);
  if (!after.bus_off) counts.max_rec = std::max(counts.max_rec, counts.rec);
}

void BusMonitor::take_event(const BusEvent &event) {
  constexpr Time kIntermission = 3;
  switch (event.kind) {
    case BusEventKind::kFrame:
      busy_ += event.end - event.start + kIntermission * bit_time_;
      // What a lone error-passive transmitter repeats looks whole to a listener (MO-03).
      if (!event.acked) {
        ++unacknowledged_;
        break;
      }
      ++frames_;
      unsettled_.push_back({event.frame, event.start, event.end, BusFrame::kNobody});
      break;
    case BusEventKind::kOverloadFrame:
      ++overload_frames_;
      busy_ += event.end - event.start;
      break;
    default:
      ++error_frames_;
      // From the SOF of the frame that was destroyed, if there was one.
      const bool in_frame = event.field >= Field::kSof && event.field <= Field::kEof;
      busy_ += event.end - (in_frame ? event.frame_start : event.start);
  }
  if (on_event) on_event(event);
}

// A frame has its sender if a node reported success between the frame's last bits and two bits
// later.
void BusMonitor::settle() {
  if (unsettled_.empty()) return;
  for (BusFrame &frame : unsettled_) {
    for (const auto &[node, time] : senders_)
      if (time > frame.end - 2 * bit_time_ && time < frame.end + 2 * bit_time_) frame.sender = node;
    if (on_frame) on_frame(frame);
  }
  unsettled_.clear();
  senders_.clear();
}

}  // namespace vericansim

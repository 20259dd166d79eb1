// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SegmentBuilder: see segment_builder.hpp.
#include "report/segment_builder.hpp"

#include <algorithm>
#include <numeric>

namespace vericansim {
namespace {

// Nodes that never come to rest together (a cable cut, a bus stuck at dominant) are cut anyway.
constexpr std::size_t kLongestSegment = 4000;  // bits

std::uint8_t code_of(const TrackedBit &bit) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(bit.field) | (bit.stuff ? 0x20U : 0U) |
                                   static_cast<unsigned>(bit.rx) << 6 |
                                   static_cast<unsigned>(bit.tx) << 7);
}

std::int8_t clamp_change(int change) {
  return static_cast<std::int8_t>(std::clamp(change, -127, 127));
}

}  // namespace

SegmentBuilder::SegmentBuilder(std::size_t nodes, Time origin, ReportData &data)
    : origin_{static_cast<double>(origin)}, data_{data}, last_(nodes) {
  current_.lanes.resize(nodes);
  before_.lanes.resize(nodes);
}

void SegmentBuilder::take(NodeId node, const TrackedBit &bit) {
  if (!current_.open) {
    if (!bit.quiet()) begin(bit.start);
  } else if (must_split(node, bit)) {
    begin(bit.start);
  }
  last_[node] = bit;
  if (!current_.open) return;
  // A slower node may still deliver the last bit of the segment before.
  const bool late = before_.open && static_cast<double>(bit.time) < current_.start;
  Lane &lane = late ? before_.lanes[node] : current_.lanes[node];
  if (lane.used != 0 || !bit.quiet()) append(lane, bit);
  if (before_.open && static_cast<double>(bit.time) > current_.start + 2 * bit.quanta * bit.tq)
    close(before_);
  const bool over =
      std::all_of(last_.begin(), last_.end(), [](const TrackedBit &b) { return b.quiet(); });
  if (!over) return;
  close(before_);
  close(current_);
}

// A frame that begins starts a segment, unless another node is in the middle of one, or has begun
// this one.
bool SegmentBuilder::must_split(NodeId node, const TrackedBit &bit) const {
  if (current_.lanes[node].bits.size() > kLongestSegment) return true;
  if (!bit.begins) return false;
  for (NodeId other = 0; other < last_.size(); ++other)
    if (other != node && last_[other].in_frame()) return false;
  return true;
}

void SegmentBuilder::begin(double start) {
  close(before_);
  std::swap(before_, current_);
  current_.open = true;
  current_.start = start;
}

void SegmentBuilder::append(Lane &lane, const TrackedBit &bit) {
  if (lane.bits.empty()) {
    lane.start = bit.start;
    lane.tq = bit.tq;
  } else {
    lane.changes.back() = clamp_change(lane.changes.back() + bit.previous_changed);
  }
  lane.quanta = bit.quanta;
  lane.bits.push_back(code_of(bit));
  lane.changes.push_back(clamp_change(bit.lengthened));
  if (!bit.quiet()) lane.used = lane.bits.size();
  if (bit.in_frame()) lane.transmits = bit.transmitter;
}

/// The lane that shows what the bus carried: that of a transmitter, else the longest.
std::size_t SegmentBuilder::reference(const std::vector<Lane> &lanes) {
  const auto better = [](const Lane &a, const Lane &b) {
    if (a.transmits != b.transmits) return b.transmits;
    return a.used < b.used;
  };
  return static_cast<std::size_t>(std::max_element(lanes.begin(), lanes.end(), better) -
                                  lanes.begin());
}

// Field, stuff bit and sampled level; what was sent differs between the nodes of any frame.
bool SegmentBuilder::agree(const std::vector<Lane> &lanes, std::size_t reference) {
  constexpr std::uint8_t kSeen = 0x7F;
  const Lane &like = lanes[reference];
  return std::all_of(lanes.begin(), lanes.end(), [&](const Lane &lane) {
    return lane.used == 0 || (lane.used == like.used &&
                              std::equal(lane.bits.begin(),
                                         lane.bits.begin() + static_cast<std::ptrdiff_t>(lane.used),
                                         like.bits.begin(), [](std::uint8_t a, std::uint8_t b) {
                                           return ((a ^ b) & kSeen) == 0;
                                         }));
  });
}

void SegmentBuilder::close(Segment &segment) {
  if (!segment.open) return;
  segment.open = false;
  const std::size_t first = reference(segment.lanes);
  const bool one = agree(segment.lanes, first);
  if (segment.lanes[first].used != 0) {
    data_.segments.start.push_back(ns(segment.lanes[first].start));
    data_.segments.end.push_back(0);
    data_.segments.lane.push_back(static_cast<std::uint32_t>(data_.lanes.node.size()));
    store(segment.lanes[first], first);
    for (std::size_t node = 0; node < segment.lanes.size() && !one; ++node)
      if (node != first && segment.lanes[node].used != 0) store(segment.lanes[node], node);
    data_.segments.lanes.push_back(
        static_cast<std::uint8_t>(data_.lanes.node.size() - data_.segments.lane.back()));
  }
  for (Lane &lane : segment.lanes) {
    lane.bits.clear();
    lane.changes.clear();
    lane.used = 0;
    lane.transmits = false;
  }
}

void SegmentBuilder::store(const Lane &lane, std::size_t node) {
  LaneColumns &to = data_.lanes;
  const auto used = static_cast<std::ptrdiff_t>(lane.used);
  to.node.push_back(static_cast<std::uint8_t>(node));
  to.start.push_back(ns(lane.start));
  to.tq.push_back(lane.tq / 1e3);
  to.first.push_back(static_cast<std::uint32_t>(to.bit.size()));
  to.count.push_back(static_cast<std::uint32_t>(lane.used));
  to.bit.insert(to.bit.end(), lane.bits.begin(), lane.bits.begin() + used);
  to.q.insert(to.q.end(), lane.changes.begin(), lane.changes.begin() + used);
  const double quanta = static_cast<double>(lane.quanta) * static_cast<double>(lane.used) +
                        std::accumulate(lane.changes.begin(), lane.changes.begin() + used, 0.0);
  double &start = data_.segments.start.back(), &end = data_.segments.end.back();
  start = std::min(start, to.start.back());
  end = std::max(end, ns(lane.start + quanta * lane.tq));
}

void SegmentBuilder::finish() {
  close(before_);
  close(current_);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WireJudge: see wire_judge.hpp.
#include "judge/wire_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace vericansim {

std::string frame_text(const Frame &frame) {
  std::string text = fmt::format("{:0{}X}{} [{}]", frame.id, frame.extended ? 8 : 3,
                                 frame.remote ? " remote" : "", frame.dlc);
  for (unsigned i = 0; i < frame.payload_size(); ++i) text += fmt::format(" {:02X}", frame.data[i]);
  return text;
}

std::string WireJudge::when(Time time) const {
  return fmt::format("at {:.3f} us", static_cast<double>(time) / kMicrosecond);
}

bool WireJudge::clean(Time sof, Time end) const {
  return !disturbances_.any(sof - kSettled * bit_time_, end + 2 * bit_time_);
}

bool WireJudge::disturbed(NodeId id, Time sof, Time end) const {
  return disturbances_.of(id, sof - 2 * bit_time_, end + 2 * bit_time_);
}

void WireJudge::bit(NodeId id, Time time, const NodeBit &bit, const Frame &frame) {
  if (!successes_.empty() || !deliveries_.empty() || !unclaimed_.empty())
    settle(time - 3 * bit_time_, time - kFar * bit_time_);
  NodeView &node = nodes_[id];
  if (bit.started) node.sof = time + (bit.rx == Level::kRecessive ? bit_time_ : 0);
  if (bit.failed) {
    node.failed = time;
    node.failed_eof6 = bit.field == Field::kEof && bit.left == 1;
    node.failed_late = bit.field == Field::kEof && bit.left == 0;
    node.unheard = bit.passive && bit.errors == kErrAck;
  }
  if (bit.delivered && !bit.transmitter) {
    ++counts_.deliveries;
    deliveries_.push_back({id, node.sof, time, frame});
  }
  if (!bit.sent) return;
  node.success = {id, node.sof, time, frame};
  if (sent_together(node.success)) return;
  ++counts_.exchanges;
  successes_.push_back(node.success);
  unseen_.push_back(successes_.back());
}

// AR-10: a remote frame that two nodes send at once is one frame on the wire.
bool WireJudge::same_exchange(const Success &a, const Success &b) const {
  return std::abs(a.end - b.end) < 3 * bit_time_ / 2 && a.frame == b.frame;
}

bool WireJudge::sent_together(const Success &success) const {
  return std::any_of(successes_.begin(), successes_.end(),
                     [&](const Success &other) { return same_exchange(success, other); });
}

// Three bits after its end every node has its view of a frame. The decoder's comes with the next
// edge on the bus, so a success is unseen only when a later frame has come.
void WireJudge::settle(Time nodes_until, Time wire_until) {
  while (!successes_.empty() && successes_.front().end < nodes_until) {
    judge(successes_.front());
    successes_.pop_front();
  }
  while (!deliveries_.empty() && deliveries_.front().time < nodes_until - 3 * bit_time_) {
    judge_left_over(deliveries_.front());
    deliveries_.pop_front();
  }
  judge_unclaimed(nodes_until);
  while (!unseen_.empty() && unseen_.front().end < wire_until) {
    const Success &success = unseen_.front();
    if (clean(success.sof, success.end)) {
      report_(fmt::format("{} counts {} as sent {}, but it was not on the wire",
                          nodes_[success.node].name, frame_text(success.frame), when(success.end)));
    }
    unseen_.pop_front();
  }
}

void WireJudge::judge(const Success &success) {
  const bool strict = clean(success.sof, success.end);
  if (strict) ++counts_.strict;
  for (NodeId id = 0; id < nodes_.size(); ++id)
    if (id != success.node) judge_receiver(success, id, strict);
}

// Samples of one bit lie less than a bit apart at any two nodes; EOF6 is one before EOF7.
void WireJudge::judge_receiver(const Success &success, NodeId id, bool clean) {
  const auto mine = std::find_if(deliveries_.begin(), deliveries_.end(), [&](const Delivery &d) {
    return d.node == id && std::abs(d.time + bit_time_ - success.end) < 3 * bit_time_ / 2;
  });
  if (mine == deliveries_.end()) {
    if (same_exchange(nodes_[id].success, success)) return;
    const bool took_part = std::abs(nodes_[id].sof - success.sof) < 3 * bit_time_ / 2;
    if (!clean || !took_part) return;
    return report_(fmt::format("{} has not received {}, which {} sent {}", nodes_[id].name,
                               frame_text(success.frame), nodes_[success.node].name,
                               when(success.end)));
  }
  const bool both_undisturbed = !disturbed(id, success.sof, success.end) &&
                                !disturbed(success.node, success.sof, success.end);
  if (mine->frame != success.frame && (clean || both_undisturbed)) {
    report_(fmt::format("{} has received {}, but {} sent {} {}", nodes_[id].name,
                        frame_text(mine->frame), nodes_[success.node].name,
                        frame_text(success.frame), when(success.end)));
  }
  deliveries_.erase(mine);
}

// A delivery that belongs to no success: the sender repeats the frame (VA-03).
void WireJudge::judge_left_over(const Delivery &delivery) {
  if (delivery.time > end_ - 3 * bit_time_) return;  // the run is over before the sender's EOF7
  ++counts_.duplicates;
  // What an error passive sender repeats for want of an acknowledge is complete for those who only
  // listen (MO-03).
  for (const NodeView &node : nodes_) {
    const bool its_frame = std::abs(node.sof - delivery.sof) < 3 * bit_time_ / 2;
    if (its_frame && node.unheard && node.failed > node.sof) return;
  }
  if (clean(delivery.sof, delivery.time)) {
    return report_(fmt::format("{} has received {} {}, which nobody sent",
                               nodes_[delivery.node].name, frame_text(delivery.frame),
                               when(delivery.time)));
  }
  if (disturbed(delivery.node, delivery.sof, delivery.time)) return;
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    const NodeView &node = nodes_[id];
    const Time late = node.failed - delivery.time;
    const bool its_frame = std::abs(node.sof - delivery.sof) < 3 * bit_time_ / 2 &&
                           node.failed > node.sof && late < 2 * bit_time_;
    if (!its_frame || node.failed_late || disturbed(id, delivery.sof, delivery.time)) continue;
    if (node.failed_eof6 && late > 0) continue;
    if (late < -bit_time_) continue;  // lost the arbitration long before
    report_(fmt::format("{} has received {} {}, whose sender {} failed before EOF7",
                        nodes_[delivery.node].name, frame_text(delivery.frame), when(delivery.time),
                        node.name));
  }
}

void WireJudge::judge_unclaimed(Time until) {
  while (!unclaimed_.empty() && unclaimed_.front().end < until) {
    const BusFrame &frame = unclaimed_.front();
    report_(fmt::format("{} was on the wire until {:.3f} us, but nobody counts it as sent",
                        frame_text(frame.frame), static_cast<double>(frame.end) / kMicrosecond));
    unclaimed_.pop_front();
  }
}

void WireJudge::finish(Time now) {
  end_ = now;
  judge_unclaimed(now - kApart * bit_time_);
  unclaimed_.clear();  // the run is over before the sender's EOF7
  settle(now + 100 * bit_time_, now + kFar * bit_time_);
}

void WireJudge::on_wire(const BusFrame &frame) {
  const bool strict = clean(frame.start, frame.end);
  settle(-kFar * bit_time_, frame.start);
  const auto mine = std::find_if(unseen_.begin(), unseen_.end(), [&](const Success &s) {
    return std::abs(s.end - frame.end) < kApart * bit_time_;
  });
  if (mine == unseen_.end()) {
    if (strict) unclaimed_.push_back(frame);
    return;
  }
  const bool undisturbed = !disturbed(mine->node, mine->sof, mine->end);
  if (mine->frame == frame.frame) {
    ++counts_.decoded;
  } else if (strict || (undisturbed && !disturbed(kAllNodes, mine->sof, mine->end))) {
    report_(fmt::format("{} was on the wire {}, but {} counts {} as sent", frame_text(frame.frame),
                        when(frame.end), nodes_[mine->node].name, frame_text(mine->frame)));
  }
  unseen_.erase(mine);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeJudge: see node_judge.hpp.
#include "judge/node_judge.hpp"

namespace vericansim {
namespace {

/// Places where a frame that waits may start, or joins a foreign SOF.
bool may_start_at(const NodeBit &bit) {
  switch (bit.field) {
    case Field::kInteg:
    case Field::kIdle: return true;  // after bus-off it may take a bit longer (BO-05)
    case Field::kInt:
    case Field::kSuspend: return bit.left == 0;
    default: return false;
  }
}

}  // namespace

NodeJudge::NodeJudge(BufferJudge &buffers, Report report)
    : buffers_{buffers}, report_{std::move(report)}, assertions_{[this](const std::string &what) {
        report_(what);
      }} {}

void NodeJudge::bit(const BitRecord &record, Level pin) {
  if (failed_) return;
  restarted_ = false;
  if (!record.after.running) return cut(record.at);
  ++bits_;
  const NodeBit bit = node_bit(record, pin);
  const bool own = bit.started && record.after.transmitter;
  interfere(buffers_.begin_bit(bit));
  prepare(bit, own);
  const NodeConfig &config = followers_.front().model().config();
  const bool waits = buffers_.must_send() || !buffers_.flights().empty();
  assertions_.look(bit, {config.listen_only, config.loop_back}, waits);
  compare(bit);
  if (!failed_) tell_buffers(bit, own);
  failed_ = failed_ || !buffers_.ok();
}

// The node leaves the bus around a sample point: a receiver within a frame, too (FX-2.1.a). Its
// counters, and a recovery from bus-off (BO-02), have counted that bit. A frame that it ends has
// been received, and TIMER has counted it (FX-6.b), unless the node had left before it.
void NodeJudge::cut(const Trace &at) {
  for (RuleFollower &follower : followers_) follower.model().sample(at.rx);
  if (!at.running) return;
  buffers_.cut_bit();
  const NodeModel &model = followers_.front().model();
  NodeBit bit;
  bit.errors = model.events().error != NodeError::kNone ? 1 : 0;
  bit.delivered = model.events().delivered;
  if (bit.errors != 0 || bit.delivered) buffers_.end_bit(bit, model.received());
}

void NodeJudge::interfere(const BufferJudge::Interference &what) {
  restarted_ = what.stopped;
  const NodeConfig config = buffers_.registers().node();
  for (RuleFollower &follower : followers_) {
    NodeModel &model = follower.model();
    model.config() = config;
    if (what.soft_reset) model.preset_counters(0, 0);
    if (what.counters) {
      model.preset_counters(static_cast<int>(what.counters->first),
                            static_cast<int>(what.counters->second));
    }
    if (what.stopped) model.restart();
  }
  if (what.stopped) in_header_ = false;
  if (what.stopped) assertions_.restarted();
  if (what.counters || what.soft_reset) assertions_.counters_preset();
}

// Gives the models what the node has to send, one model for each frame that it may be.
void NodeJudge::prepare(const NodeBit &bit, bool own) {
  if (bit.started) {
    buffers_.started(own, bit.rx == Level::kRecessive);
    in_header_ = true;
  }
  if (own) {
    const std::vector<Frame> flights = buffers_.flights();
    std::vector<RuleFollower> next;
    // Between frames the models differ in nothing that matters.
    for (const Frame &frame : flights) {
      next.push_back(followers_.front());
      next.back().model().request(frame);
    }
    if (!next.empty()) followers_ = next;
    return;
  }
  const bool must = may_start_at(bit) && buffers_.must_send();
  for (RuleFollower &follower : followers_) {
    if (must) {
      follower.model().request({});
    } else {
      follower.model().cancel();
    }
  }
}

void NodeJudge::compare(const NodeBit &bit) {
  std::string first;
  const BitPlace at = followers_.front().model().state();
  std::size_t kept = 0;
  for (RuleFollower &follower : followers_) {
    const std::vector<std::string> differences = follower.follow(bit);
    if (differences.empty()) {
      if (&followers_[kept] != &follower) followers_[kept] = follower;
      ++kept;
    } else if (first.empty()) {
      first = differences.front();
    }
  }
  if (kept != 0) {
    followers_.resize(kept);
    return;
  }
  failed_ = true;
  report_(std::string{field_name(at.field)} + "[" + std::to_string(at.index) + "]: " + first);
}

// The buffers hear of a frame once its identifier and format are known: after a dominant IDE or
// after the RTR of an extended frame.
void NodeJudge::tell_buffers(const NodeBit &bit, bool own) {
  const NodeModel &model = followers_.front().model();
  const bool ends_header = !bit.stuff && (bit.field == Field::kExRtr ||
                                          (bit.field == Field::kIde && bit.rx == Level::kDominant));
  if (bit.errors != 0 || bit.failed || bit.delivered || bit.sent)
    buffers_.end_bit(bit, model.received());
  if (own || bit.errors != 0) in_header_ = own;
  if (!in_header_ || !ends_header) return;
  in_header_ = false;
  const bool sends = model.role() == Role::kTransmitter;
  buffers_.header(sends ? std::nullopt : std::optional{model.received()});
}

}  // namespace vericansim

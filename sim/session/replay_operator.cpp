// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayOperator: see replay_operator.hpp.
#include "session/replay_operator.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/range.hpp"
#include "simulation/simulation.hpp"
#include "trace/candump.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

// Frames that wait in the software of a node that sends as fast as the bus allows.
constexpr std::uint64_t kAhead = 16;

// Bits after which a node that has something to send is given up: without any frame on the bus (a
// recovery from bus-off takes some thousand), and without one of its own.
constexpr Time kSilence = 20'000;
constexpr Time kStarved = 1'000'000;

/// Whether another node has frames of the recording of which `id` has none in its share.
bool others_send(const std::vector<NodeSpec> &nodes, NodeId id) {
  const auto &mine = std::get<ReplayRole>(nodes[id].role);
  for (NodeId other = 0; other < nodes.size(); ++other) {
    const auto *role = std::get_if<ReplayRole>(&nodes[other].role);
    if (other != id && role != nullptr && role->file == mine.file && role->log == mine.log &&
        !make_plan(*role).frames.empty())
      return true;
  }
  return false;
}

}  // namespace

ReplayOperator::ReplayOperator(const OperatorContext &context)
    : simulation_{context.simulation()},
      id_{context.id},
      name_{context.spec().name},
      bit_time_{bit_time_of(context.simulation().bitrate())} {
  const auto &role = std::get<ReplayRole>(context.spec().role);
  file_ = role.file;
  saturated_ = role.saturated;
  loop_ = role.loop;
  plan_ = make_plan(role);
  failure_ = plan_.nothing;
  none_of_share_ = failure_.empty() && plan_.frames.empty();
  const auto &nodes = context.scenario().nodes;
  if (none_of_share_ && !others_send(nodes, id_))
    failure_ = fmt::format("no frame of {} is of share {}/{}, and no other node sends one of it",
                           file_, role.share + 1, role.shares);
  for (NodeId id = 0; id < nodes.size(); ++id)
    if (id != id_ && nodes[id].hosted() && nodes[id].host.filters.empty() &&
        !nodes[id].host.loop_back)
      followers_.push_back({id});
  if (!context.say) return;
  for (const std::string &warning : plan_.warnings)
    context.say(fmt::format("{}: warning: {}: {}", name_, file_, warning));
  if (plan_.longest_gap >= kLongGap)
    context.say(fmt::format("{}: {} has no frame for {} before frame {}", name_, file_,
                            long_time(plan_.longest_gap), plan_.after_gap));
}

// ---- Sending

const Frame &ReplayOperator::frame(std::uint64_t number) const {
  return plan_.frames[number % plan_.frames.size()].frame;
}

Time ReplayOperator::due(std::uint64_t number) const {
  const std::uint64_t count = plan_.frames.size();
  return start_ + plan_.frames[number % count].due + static_cast<Time>(number / count) * plan_.pass;
}

bool ReplayOperator::more() const {
  return !over_ && failure_.empty() && !plan_.frames.empty() &&
         (loop_ || fed_ < plan_.frames.size());
}

void ReplayOperator::begin(Time now) {
  start_ = last_frame_ = last_own_ = now;
  if (more()) simulation_.bus().at(std::max(now, due(0)), [this] { feed(); });
}

/// Sends what is due, and arranges for the next.
void ReplayOperator::feed() {
  const Time now = simulation_.bus().now();
  while (more() && due(fed_) <= now && (!saturated_ || fed_ - left_ < kAhead))
    simulation_.host(id_).send(frame(fed_++));
  if (more() && due(fed_) > now) simulation_.bus().at(due(fed_), [this] { feed(); });
}

void ReplayOperator::on_sent() {
  ++left_;
  last_own_ = simulation_.bus().now();
  if (saturated_) feed();
}

bool ReplayOperator::done() const {
  return loop_ || !failure_.empty() || (!more() && left_ == fed_);
}

double ReplayOperator::progress() const {
  if (done()) return 1;
  return static_cast<double>(sent_) / static_cast<double>(plan_.frames.size());
}

void ReplayOperator::end(Time elapsed) {
  over_ = true;
  elapsed_ = elapsed;
}

void ReplayOperator::check() {
  const Time now = simulation_.bus().now();
  if (left_ == fed_) last_own_ = last_frame_ = now;
  if (!failure_.empty() || over_) return;
  const Time silence = now - std::max(last_frame_, last_own_);
  if (silence > kSilence * bit_time_ || now - last_own_ > kStarved * bit_time_)
    failure_ =
        fmt::format("gave up after {} with {} of {} frames sent: {}",
                    readable_time(now - last_own_), sent_, plan_.frames.size(), give_up_reason());
}

std::string ReplayOperator::give_up_reason() const {
  const NodeCounts &counts = simulation_.counts(id_);
  if (counts.off) return "the node is bus-off";
  constexpr unsigned kAck = 3;
  if (counts.errors != 0 && counts.by_kind[kAck] == counts.errors) return "nobody acknowledges";
  if (counts.errors != 0) return fmt::format("{} errors", counts.errors);
  return "others hold the bus";
}

// ---- Following

bool ReplayOperator::stored(const Frame &frame) const {
  return !frame.remote || simulation_.stores_remote();
}

void ReplayOperator::on_frame(const BusFrame &seen) {
  last_frame_ = simulation_.bus().now();
  if (!seen.sent_by(id_) || sent_ == fed_ || !failure_.empty()) return;
  if (seen.frame == frame(sent_))
    ++sent_;
  else
    failure_ = fmt::format("frame {} was on the bus as {}, not {}", sent_ + 1,
                           candump_frame(seen.frame), candump_frame(frame(sent_)));
}

// A node may have a frame before the monitor has told of it.
void ReplayOperator::on_received(NodeId node, const Frame &received) {
  for (Follower &follower : followers_) {
    if (follower.node != node) continue;
    skip_unstored(follower);
    if (follower.seen < fed_ && received == frame(follower.seen)) ++follower.seen;
  }
}

void ReplayOperator::skip_unstored(Follower &follower) const {
  while (follower.seen < fed_ && !stored(frame(follower.seen))) ++follower.seen;
}

// ---- The result

// A run that is over before the first frame has shown nothing of the recording. A user who stops it
// knows that.
std::string ReplayOperator::failure_at_end(bool interrupted) const {
  if (!failure_.empty() || interrupted || fed_ != 0 || plan_.frames.empty()) return failure_;
  return fmt::format(
      "none of its {} frames was due: the first is at {}, and the run was over at {}",
      plan_.frames.size(), readable_time(plan_.frames.front().due), readable_time(elapsed_));
}

ReplayReceiver ReplayOperator::judge(const Follower &follower) const {
  Follower last = follower;
  skip_unstored(last);
  ReplayReceiver result;
  result.node = simulation_.scenario().nodes[follower.node].name;
  for (std::uint64_t i = 0; i < sent_; ++i) {
    result.expected += stored(frame(i)) ? 1 : 0;
    result.received += i < last.seen && stored(frame(i)) ? 1 : 0;
  }
  if (last.seen < sent_)
    result.first_difference = fmt::format("frame {} of {} has not come: {}", last.seen + 1, name_,
                                          candump_frame(frame(last.seen)));
  return result;
}

void ReplayOperator::report(RunReport &report) {
  ReplayResult result;
  result.node = name_;
  result.file = file_;
  result.frames = loop_ ? fed_ : plan_.frames.size();
  result.sent = sent_;
  result.skipped = plan_.skipped;
  result.recorded = plan_.recorded;
  result.none_of_share = none_of_share_;
  result.longest_gap = plan_.longest_gap;
  result.after_gap = plan_.after_gap;
  result.warnings = plan_.warnings;
  result.failure = failure_at_end(report.interrupted);
  if (!saturated_ && !report.interrupted) result.late = fed_ - sent_;
  for (const Follower &follower : followers_) result.receivers.push_back(judge(follower));
  report.replays.push_back(std::move(result));
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Replay of recorded traffic.
#include "scenario/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bus/range.hpp"
#include "scenario/bittime.hpp"
#include "scenario/bus_outputs.hpp"
#include "scenario/station.hpp"
#include "scenario/stop_request.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

class Replay {
 public:
  Replay(const CanLog &log, const ReplayOptions &options);
  ReplayReport execute(const std::function<void(double)> &progress);

 private:
  void build();
  [[nodiscard]] NodeId sender_of(const Frame &frame) const;
  void feed(std::size_t entry);
  void feed_all();
  [[nodiscard]] std::uint64_t sent() const;
  void run(const std::function<void(double)> &progress);
  [[nodiscard]] ReplayNode judge(NodeId node) const;
  ReplayReport collect();

  const CanLog &log_;
  ReplayOptions options_;
  std::size_t count_;
  Time bit_time_;
  Stations stations_;
  std::unique_ptr<BusMonitor> monitor_;
  std::unique_ptr<BusOutputs> outputs_;
  std::size_t on_bus_ = 0;
  bool interrupted_ = false;
  Bus bus_;
  Time start_ = 0;
};

Replay::Replay(const CanLog &log, const ReplayOptions &options)
    : log_{log},
      options_{options},
      count_{options.limit == 0 ? log.entries.size() : std::min(options.limit, log.entries.size())},
      bit_time_{bit_time_of(options.bitrate)} {
  build();
}

void Replay::build() {
  const BitTimingRequest request = bit_timing_request(options_.clock_hz, options_.bitrate);
  const auto timings = find_bit_timings(request);
  if (timings.empty())
    throw InputError("--clock", 0,
                     fmt::format("no setting of 8 to 25 quanta gives {} bit/s from {} Hz",
                                 request.bitrate, request.clock_hz));
  HostConfig config;
  config.timing = timings.front().timing;
  for (NodeId id = 0; id < options_.nodes; ++id) {
    // Ends of the range at the first and the last node, and phases that are no fraction of a
    // period.
    const double place = options_.nodes == 1 ? 0 : static_cast<double>(id) / (options_.nodes - 1);
    ClockConfig clock{.frequency_hz = options_.clock_hz,
                      .error_ppm = options_.ppm * (1 - 2 * place)};
    clock.phase = options_.ppm == 0 ? 0 : static_cast<Time>(id) * 7'919;
    const Link link{.cable = cable_delay(options_.cable_m * std::abs(place - 0.5))};
    stations_.add(bus_, make_station(fmt::format("node{}", id), clock, config, options_.num_mb),
                  link);
  }
  monitor_ = std::make_unique<BusMonitor>(bus_, bit_time_, timings.front().sample_point);
  monitor_->on_frame = [this](const BusFrame &frame) {
    ++on_bus_;
    outputs_->write(frame);
  };
  bus_.add(*monitor_);
  outputs_ = std::make_unique<BusOutputs>(options_.outputs, bus_, bit_time_);
  const std::vector<BitTiming> all(options_.nodes, config.timing);
  outputs_->record(bus_, *monitor_,
                   {"Replay", fmt::format("{} frames of a recording", count_), options_.bitrate,
                    bit_time_, all});
}

// One identifier always has the same sender, as on a real bus; Fibonacci hashing spreads
// neighbours.
NodeId Replay::sender_of(const Frame &frame) const {
  const std::uint32_t key = (frame.id ^ (frame.extended ? 0x80000000U : 0U)) * 2654435769U;
  return static_cast<NodeId>((static_cast<std::uint64_t>(key) * options_.senders) >> 32);
}

/// Sends entry `entry` now and those that are due at the same time, and arranges for the next one.
void Replay::feed(std::size_t entry) {
  const Time now = bus_.now();
  while (entry < count_ && start_ + log_.entries[entry].time <= now) {
    stations_[sender_of(log_.entries[entry].frame)].host->send(log_.entries[entry].frame);
    ++entry;
  }
  if (entry < count_) bus_.at(start_ + log_.entries[entry].time, [this, entry] { feed(entry); });
}

void Replay::feed_all() {
  for (std::size_t i = 0; i < count_; ++i)
    stations_[sender_of(log_.entries[i].frame)].host->send(log_.entries[i].frame);
}

std::uint64_t Replay::sent() const {
  std::uint64_t sum = 0;
  for (NodeId id = 0; id < stations_.size(); ++id) sum += stations_[id].host->stats().sent;
  return sum;
}

void Replay::run(const std::function<void(double)> &progress) {
  constexpr Time kPatience = 400;  // bits without a frame on a bus that has one to send: stuck
  const Time last = options_.fast || count_ == 0 ? 0 : log_.entries[count_ - 1].time;
  std::uint64_t before = 0;
  Time silence = 0;
  while (sent() < count_ && silence < kPatience * bit_time_ && !stop_requested()) {
    bus_.run_for(50 * bit_time_);
    stations_.check();
    silence = sent() != before || stations_.pending() == 0 ? 0 : silence + 50 * bit_time_;
    before = sent();
    if (progress) progress(static_cast<double>(before) / static_cast<double>(count_));
    if (stations_.pending() == 0 && bus_.now() > start_ + last + 1000 * bit_time_) break;
  }
  interrupted_ = stop_requested();
  bus_.run_for(20 * bit_time_);
  stations_.check();
  monitor_->advance(bus_.now());
}

/// Frames of each sender must come in the order of the log; frames of several senders may overtake
/// each other.
ReplayNode Replay::judge(NodeId node) const {
  const std::vector<Frame> &received = stations_[node].received;
  ReplayNode result;
  result.name = stations_[node].node->name();
  result.counts = monitor_->node(node);
  result.received = received.size();
  std::vector<std::vector<Frame>> wanted(options_.senders);
  for (std::size_t i = 0; i < count_; ++i) {
    const Frame &frame = log_.entries[i].frame;
    const NodeId sender = sender_of(frame);
    result.sent += sender == node ? 1 : 0;
    if (sender == node || (frame.remote && !stations_.stores_remote())) continue;
    wanted[sender].push_back(frame);
    ++result.expected;
  }
  std::vector<std::size_t> next(options_.senders);
  for (std::size_t i = 0; i < received.size() && result.first_difference.empty(); ++i) {
    const NodeId sender = sender_of(received[i]);
    const bool due =
        next[sender] < wanted[sender].size() && wanted[sender][next[sender]] == received[i];
    if (!due)
      result.first_difference =
          fmt::format("received frame {}: {}", i + 1, candump_frame(received[i]));
    ++next[sender];
  }
  for (NodeId sender = 0;
       sender < options_.senders && result.first_difference.empty() && !interrupted_; ++sender)
    if (next[sender] != wanted[sender].size())
      result.first_difference = fmt::format("frame {} of node{} has not come: {}", next[sender] + 1,
                                            sender, candump_frame(wanted[sender][next[sender]]));
  result.complete = result.first_difference.empty();
  return result;
}

ReplayReport Replay::collect() {
  ReplayReport report;
  report.frames = count_;
  report.interrupted = interrupted_;
  report.on_bus = on_bus_;
  report.error_frames = monitor_->error_frames();
  report.skipped = log_.skipped;
  report.recorded = count_ == 0 ? 0 : log_.entries[count_ - 1].time;
  report.duration = bus_.now() - start_;
  report.load = static_cast<double>(monitor_->busy()) / static_cast<double>(report.duration);
  report.node_cycles = stations_.cycles();
  for (NodeId id = 0; id < stations_.size(); ++id) report.nodes.push_back(judge(id));
  return report;
}

ReplayReport Replay::execute(const std::function<void(double)> &progress) {
  const auto begin = std::chrono::steady_clock::now();
  stations_.join(bus_, bit_time_);
  start_ = bus_.now();
  if (options_.fault != nullptr) bus_.add(*options_.fault);
  outputs_->begin();
  if (options_.fast)
    feed_all();
  else
    feed(0);
  run(progress);
  outputs_->finish(bus_.now());
  outputs_->write_report();
  ReplayReport report = collect();
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

}  // namespace

bool ReplayReport::ok() const {
  return !interrupted && on_bus == frames && error_frames == 0 &&
         std::all_of(nodes.begin(), nodes.end(), [](const ReplayNode &n) { return n.complete; });
}

ReplayReport replay(const CanLog &log, const ReplayOptions &options,
                    const std::function<void(double)> &progress) {
  if (options.nodes < 2 || options.nodes > Bus::kMaxNodes || options.senders < 1 ||
      options.senders > options.nodes)
    throw std::invalid_argument("a replay needs 2 to 64 nodes and 1 to that many senders");
  return Replay{log, options}.execute(progress);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TrafficSource: queues the frames of one message at a node when they are due, and measures their
// response times.
#pragma once

#include <deque>
#include <optional>
#include <random>

#include "bus/bus.hpp"
#include "node/host.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// One message. It must outlive the bus's actions, that is: the run.
class TrafficSource {
 public:
  /// Throws std::invalid_argument if a time is out of range, or as Frame::validate().
  TrafficSource(const TrafficSpec &spec, Bus &bus, Host &host, std::uint64_t seed);

  /// Begins to queue at `start`. Each event before `stop` has its frame, queued before `stop`, too.
  void start(Time start, Time stop);
  /// The host has sent a frame of this message (saturated messages queue the next one).
  void on_sent();
  /// The event of the first frame that is due and is `frame`, bit for bit.
  [[nodiscard]] std::optional<Time> due(const Frame &frame) const;
  /// That frame has ended on the bus at `end`; its response time, if it was due.
  std::optional<Time> on_frame(const Frame &frame, Time end);

  /// The first frame that is due and is `frame` has left without having been one on the bus.
  void forget(const Frame &frame);

  [[nodiscard]] const TrafficSpec &spec() const { return spec_; }
  /// True if `frame` could be one of this message.
  [[nodiscard]] bool matches(const Frame &frame) const;
  /// What was seen up to now.
  [[nodiscard]] MessageReport report() const;

 private:
  struct Waiting {
    Time event;
    Frame frame;
  };

  [[nodiscard]] std::deque<Waiting>::const_iterator find(const Frame &frame) const;
  void schedule(Time event);
  void queue(Time event);
  [[nodiscard]] Frame next_frame();

  TrafficSpec spec_;
  Bus &bus_;
  Host &host_;
  std::mt19937_64 random_;
  Time stop_ = 0;
  std::deque<Waiting> waiting_;  // frames that have not ended yet, in the order of their events
  MessageReport report_;
};

}  // namespace vericansim

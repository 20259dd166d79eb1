// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FollowerBus: an ideal master, bit by bit from the codec, and nodes can_time_node with clocks of
// their own; what their pulse pins do.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/frame_codec.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "time/tsyn_frames.hpp"
#include "verilated.h"

namespace vericansim {

/// One node. Times in ps.
template <typename Model>
class Follower {
 public:
  Follower(double period_ps, double phase_ps) : period_{period_ps}, phase_{phase_ps} {
    top_.eval();
    top_.can_rx_i = 1;
    reset();
  }
  ~Follower() { top_.final(); }
  Follower(const Follower &) = delete;
  Follower &operator=(const Follower &) = delete;

  /// A hard reset; the node's own time stands still meanwhile.
  void reset() {
    top_.rst_ni = 0;
    rising_edge(top_, top_.clk_i);
    top_.rst_ni = 1;
  }

  [[nodiscard]] double next() const { return phase_ + period_ * static_cast<double>(edges_); }
  [[nodiscard]] bool dominant() const { return top_.can_tx_o == 0; }
  [[nodiscard]] unsigned state() const { return top_.state_o; }
  /// Times of the rising edges of its pin.
  [[nodiscard]] const std::vector<double> &pulses() const { return pulses_; }
  [[nodiscard]] Model &model() { return top_; }

  void edge(bool dominant) {
    const bool before = top_.pps_o != 0;
    top_.can_rx_i = dominant ? 0 : 1;
    rising_edge(top_, top_.clk_i);
    if constexpr (requires { top_.after_edge(); }) top_.after_edge();  // of who plants defects
    if (top_.pps_o != 0 && !before) pulses_.push_back(next());
    ++edges_;
  }

 private:
  SerialContext context_;
  Model top_{&context_, "follower"};
  double period_, phase_;
  std::uint64_t edges_ = 0;
  std::vector<double> pulses_;
};

/// The bus.
template <typename Model>
class FollowerBus {
 public:
  /// `bit_ps`: length of a bit of the master; its time is `epoch_ns` when the simulation begins.
  FollowerBus(double bit_ps, std::uint64_t epoch_ns) : bit_{bit_ps}, epoch_{epoch_ns} {}

  void add(double period_ps, double phase_ps) {
    nodes_.push_back(std::make_unique<Follower<Model>>(period_ps, phase_ps));
  }
  Follower<Model> &node(unsigned n) { return *nodes_[n]; }

  /// The master's time, ns, at a time of the simulation, ps.
  [[nodiscard]] std::uint64_t master(double at) const {
    return epoch_ + static_cast<std::uint64_t>(std::llround(at / 1000));
  }

  /// SYNC now and FUP 300 bits later.
  void pair() {
    const std::vector<WireBit> bits = send(pairs_.sync(master(now_)));
    const std::uint64_t reference =
        master(start_ + bit_ * static_cast<double>(reference_bit(bits)));
    run(start_ + 300 * bit_);
    send(pairs_.follow_up(reference));
    run(start_ + 300 * bit_);
  }

  /// Runs until `until`, ps.
  void run(double until) {
    for (;;) {
      Follower<Model> *first = nodes_.front().get();
      for (const auto &node : nodes_)
        if (node->next() < first->next()) first = node.get();
      if (first->next() >= until) break;
      now_ = first->next();
      first->edge(level());
    }
    now_ = until;
  }
  [[nodiscard]] double now() const { return now_; }

 private:
  std::vector<WireBit> send(const Frame &frame) {
    EncodedFrame encoded = encode_unacknowledged(frame);
    sent_ = levels_of(encoded.bits);
    start_ = now_;
    return encoded.bits;
  }
  /// Whether anybody is dominant now.
  [[nodiscard]] bool level() const {
    const auto bit = static_cast<std::size_t>(std::max(0.0, (now_ - start_) / bit_));
    const bool sent = bit < sent_.size() && sent_[bit] == Level::kDominant;
    return sent || std::any_of(nodes_.begin(), nodes_.end(),
                               [](const auto &node) { return node->dominant(); });
  }

  double bit_;
  std::uint64_t epoch_;
  TsynPairs pairs_;
  double now_ = 0, start_ = 0;
  std::vector<Level> sent_;
  std::vector<std::unique_ptr<Follower<Model>>> nodes_;
};

}  // namespace vericansim

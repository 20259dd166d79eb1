// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// StampJudge: what the stamps of a node must be (TM-20 to TM-26), from the level at its receive pin
// and its own transmit level in every clock and from the bits that it has sampled. It also makes
// glitches, behind recessive bits, which let a node synchronise wherever they come.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "bus/faults.hpp"
#include "bus/trace.hpp"
#include "time/time_rig.hpp"

namespace vericansim {

/// Of all nodes of a rig. Nobody but shifted() tells it of changes of their clocks.
class StampJudge : public Fault {
 public:
  /// One of `rareness` recessive bits is followed by a glitch of a clock; 0: none is.
  StampJudge(TimeRig &time, std::uint32_t tctrl, unsigned rareness, std::uint32_t seed)
      : time_{time},
        point_{tctrl & 3},
        txpin_{(tctrl & 4) != 0},
        rareness_{rareness},
        random_{seed},
        nodes_(time.nodes.size()) {}

  [[nodiscard]] unsigned hooks() const override { return kLevel | kClocked; }
  [[nodiscard]] Level level(NodeId n, Time, Level level) override {
    if (n >= nodes_.size()) return level;
    Node &node = nodes_[n];
    if (node.glitch != 0 && --node.glitch == 0) level = Level::kDominant;
    node.pin[2] = node.pin[1];
    node.pin[1] = node.pin[0];
    node.pin[0] = level == Level::kDominant;
    return level;
  }
  void clocked(NodeId n, Time, std::uint64_t word) override {
    if (n >= nodes_.size()) return;
    Node &node = nodes_[n];
    const std::uint64_t now = time_.node(n).edges() * kTimeStep + node.ahead;
    const Trace trace = decode_trace(word);
    // The synchroniser shows the level of the edge before the last.
    if (node.pin[1] && !node.pin[2]) node.pin_fall = now;
    const bool dominant = trace.tx == Level::kDominant;
    if (dominant && !node.sends) node.tx_fall = now;
    node.sends = dominant;
    // A dominant bit behind which a frame begins was its start.
    if (trace.start && node.before == Level::kDominant) begin(node, node.edge_before);
    if (trace.rx_valid) node.valid.push_back(point_ == 2 ? now : node.stamp.value_or(0));
    if (trace.sample) sampled(node, trace, now);
  }

  /// The clock of node n has been shifted, between two frames.
  void shifted(unsigned n, std::uint64_t ahead) { nodes_[n].ahead += ahead; }

  /// Stamps of the frames that have become valid at node n.
  [[nodiscard]] const std::vector<std::uint64_t> &valid(unsigned n) const {
    return nodes_[n].valid;
  }
  /// Bits that were shorter or longer than eight clocks.
  [[nodiscard]] unsigned shortened() const { return shortened_; }
  [[nodiscard]] unsigned lengthened() const { return lengthened_; }

 private:
  /// Clocks from a sample to a glitch: in PHASE_SEG2, before the next sample, and behind that. At 7
  /// it would be sampled.
  static constexpr std::array<unsigned, 8> kPlaces{1, 2, 4, 5, 8, 8, 9, 10};
  struct Node {
    std::array<bool, 3> pin{};  // dominant at the last edges
    bool sends = false;
    std::uint64_t ahead = 0;  // TIME is that much more than the clocks since reset
    std::uint64_t pin_fall = 0, tx_fall = 0;
    Level before = Level::kRecessive;  // last sampled bit
    std::uint64_t edge_before = 0;     // last edge at the pin before it
    std::uint64_t last_sample = 0;
    bool referenced = false;
    std::optional<std::uint64_t> stamp;
    std::vector<std::uint64_t> valid;
    unsigned glitch = 0;  // clocks until it comes
  };

  void begin(Node &node, std::uint64_t edge) const {
    node.referenced = false;
    node.stamp.reset();
    if (point_ == 0) node.stamp = edge;
  }
  void sampled(Node &node, const Trace &trace, std::uint64_t now) {
    const bool dominant = trace.rx == Level::kDominant;
    const bool own = trace.transmitter && !txpin_;
    if (trace.field == Field::kSof) begin(node, own ? node.tx_fall : node.pin_fall);
    const bool behind = trace.field >= Field::kR1 && trace.field <= Field::kCrc;
    if (behind && dominant && node.before == Level::kRecessive && !node.referenced) {
      node.referenced = true;
      if (point_ % 2 != 0) node.stamp = own ? node.tx_fall : node.pin_fall;
    }
    node.before = trace.rx;
    node.edge_before = node.pin_fall;
    count(node, now);
    if (!dominant && rareness_ != 0 && random_() % rareness_ == 0)
      node.glitch = kPlaces[random_() % kPlaces.size()];
  }
  void count(Node &node, std::uint64_t now) {
    const std::uint64_t at = now - node.ahead, length = (at - node.last_sample) / kTimeStep;
    shortened_ += length < 8;
    lengthened_ += length > 8;
    node.last_sample = at;
  }

  TimeRig &time_;
  unsigned point_;
  bool txpin_;
  unsigned rareness_;
  std::mt19937 random_;
  std::vector<Node> nodes_;
  unsigned shortened_ = 0, lengthened_ = 0;
};

}  // namespace vericansim

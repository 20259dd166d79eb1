// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ThreeNodes: see three_nodes.hpp.
#include "timing/three_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/trace.hpp"
#include "timing/hard_frames.hpp"

namespace vericansim {
namespace {

class Rig {
 public:
  explicit Rig(const ThreeNodes &config)
      : bit_{static_cast<Time>(config.timing.clocks_per_bit() * 1e12 / config.clock_hz)},
        frames_{config.seed} {
    const auto period = static_cast<std::uint64_t>(1e12 / config.clock_hz);
    for (unsigned i = 0; i < 3; ++i) {
      const ClockConfig clock{.frequency_hz = config.clock_hz,
                              .error_ppm = config.error_ppm[i],
                              .phase = static_cast<Time>(frames_.random() % period)};
      nodes_[i] =
          std::make_unique<CoreNode>(std::to_string(i), CoreConfig{.timing = config.timing}, clock);
      bus_.add(*nodes_[i]);
    }
    for (NodeId a = 0; a < 3; ++a)
      for (NodeId b = 0; b < 3; ++b)
        bus_.set_delay(a, b,
                       static_cast<Time>(config.node_delay_ns * kNanosecond) +
                           cable_delay(std::abs(config.metres[a] - config.metres[b])));
    for (auto &node : nodes_) node->start();
    bus_.run_for(16 * bit_);
    for (auto &node : nodes_) node->clear_events();
  }

  ThreeNodesResult run(unsigned frames, unsigned most_errors) {
    constexpr Time kStep = 6;  // bits; no flag, and no gap between two ends of frames, is shorter
    constexpr Time kLongest = 160;
    const Time end = bus_.now() + 4 * kLongest * frames * bit_;
    while (result_.frames < frames && result_.errors < most_errors && bus_.now() < end) {
      for (NodeId i = 0; i < 3; ++i)
        if (queued_[i] < nodes_[i]->sent().size() + 2) queue(i);
      bus_.run_for(kStep * bit_);
      look();
    }
    if (result_.frames < frames && result_.errors == 0) ++result_.errors;  // it stands
    bus_.run_for(4 * bit_);
    compare();
    return result_;
  }

 private:
  void queue(NodeId i) {
    nodes_[i]->request(frames_.next(i, result_.frames));
    ++queued_[i];
  }

  void look() {
    for (NodeId i = 0; i < 3; ++i) {
      const bool overload = decode_trace(nodes_[i]->trace()).field == Field::kOvlFlag;
      result_.errors += overload || nodes_[i]->events().errors != 0;
      nodes_[i]->clear_events();
      for (; seen_[i] < nodes_[i]->sent().size(); ++seen_[i]) {
        order_.push_back(i);
        ++result_.frames;
      }
    }
  }

  /// Each node has received what the others sent, in the order of the bus.
  void compare() {
    for (NodeId i = 0; i < 3; ++i) {
      std::array<std::size_t, 3> at{};
      std::vector<Frame> expected;
      for (const NodeId sender : order_) {
        const Frame &frame = nodes_[sender]->sent()[at[sender]++];
        if (sender != i) expected.push_back(frame);
      }
      const auto &received = nodes_[i]->received();
      for (std::size_t n = 0; n < expected.size(); ++n)
        result_.differences += n >= received.size() || received[n] != expected[n];
      result_.differences += received.size() > expected.size();
    }
    for (const auto &node : nodes_) result_.node_cycles += node->oscillator().cycles();
  }

  Time bit_;
  HardFrames frames_;
  Bus bus_;
  std::array<std::unique_ptr<CoreNode>, 3> nodes_;
  std::array<std::size_t, 3> queued_{}, seen_{};
  std::vector<NodeId> order_;  // of the frames on the bus
  ThreeNodesResult result_;
};

}  // namespace

ThreeNodesResult run_three_nodes(const ThreeNodes &bus, unsigned frames, unsigned most_errors) {
  return Rig{bus}.run(frames, most_errors);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// run_flip(): see run.hpp. The flip-flops are members of the model's root (flops.inc).
#include "softerror/follower/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "Vcan_time_node_flops.h"
#include "Vcan_time_node_flops___024root.h"
#include "time/follower_bus.hpp"

// Verilator's own (5.006): evaluates all logic that is not clocked.
void Vcan_time_node_flops___024root___eval_settle(Vcan_time_node_flops___024root *root);

namespace vericansim {
namespace {

using Root = Vcan_time_node_flops___024root;

constexpr double kPeriod = 250'000, kInterval = 2e10;  // ps: 4 MHz, and 20 ms between pairs
constexpr double kFast = 1 - 60e-6;                    // its oscillator
constexpr double kRight = 750;                         // ns: three clocks
// Pairs of a run. A node that an upset takes off the bus is back in less than one of them.
constexpr unsigned kPairs = 60, kAtLeast = 34, kQuiet = 10, kLocked = 14;
// A node sends at most six dominant bits in a row, and an error in its flag makes it begin again:
// twice that is more than any rule allows a node that is alone in it.
constexpr unsigned kLongestRun = 24 * 8;

/// The model as FollowerBus clocks it, with the flip in it.
class FlippedNode : public Vcan_time_node_flops {
 public:
  using Vcan_time_node_flops::Vcan_time_node_flops;

  void plan(const FlopFlip &flip) { flip_ = flip; }
  /// Called by FollowerBus behind every edge of the clock.
  void after_edge() {
    if (is_due()) {
      follower_flops().flip(rootp, flip_.flop);
      Vcan_time_node_flops___024root___eval_settle(rootp);
    }
    ++clocks_;
    run_ = can_tx_o != 0 ? 0 : run_ + 1;
    longest_run_ = std::max(longest_run_, run_);
  }
  /// TIME behind the last edge, ns.
  [[nodiscard]] std::uint64_t time() const {
    const Root &root = *rootp;
    const std::uint64_t upper =
        root.can_time_node__DOT__u_core__DOT__gen_time__DOT__u_time__DOT__u_clock__DOT__hi_o;
    return upper << 32 | root.can_time_node__DOT__u_core__DOT__gen_time__DOT__u_time__DOT__lo_q;
  }
  [[nodiscard]] unsigned longest_run() const { return longest_run_; }

 private:
  [[nodiscard]] bool is_due() const {
    if (!flip_.stuck) return clocks_ == flip_.clock;
    return clocks_ >= flip_.clock && follower_flops().value(rootp, flip_.flop) != *flip_.stuck;
  }

  FlopFlip flip_{0, ~0ULL, {}};
  std::uint64_t clocks_ = 0;
  unsigned run_ = 0, longest_run_ = 0;
};

}  // namespace

const FlopPlaces &follower_flops() {
  static const auto list = [] {
    FlopPlaces all;
#define FLOP(name, member, mask) all.add(name, offsetof(Root, member), mask);
#include "flops.inc"
#undef FLOP
    return all;
  }();
  return list;
}

FollowerOutcome run_flip(const FlopFlip &flip) {
  FollowerBus<FlippedNode> bus{8 * kPeriod, 1'700'000'000'999'000'000};
  bus.add(kPeriod * kFast, 12'345);
  FlippedNode &node = bus.node(0).model();
  node.plan(flip);
  FollowerOutcome outcome;
  const bool flipped = flip.clock <= kFlipTo;
  const double flipped_at = flipped ? static_cast<double>(flip.clock) * kPeriod * kFast : 0;
  unsigned behind = 0, quiet = 0;
  for (unsigned n = 0; n < kPairs && (n < kAtLeast || quiet < kQuiet); ++n) {
    bus.pair();
    bus.run((n + 1) * kInterval);
    if (n < kLocked || bus.now() < flipped_at) continue;
    ++behind;
    const auto error =
        static_cast<double>(static_cast<std::int64_t>(node.time() - bus.master(bus.now())));
    outcome.worst_ns = std::max(outcome.worst_ns, std::abs(error));
    const bool right = std::abs(error) < kRight;
    quiet = right && bus.node(0).state() == 2 ? quiet + 1 : 0;
    if (!right) outcome.pairs = behind;
  }
  outcome.hangs = quiet < kQuiet;
  outcome.babbled = node.longest_run() > kLongestRun;
  // A pulse every ms; each is a clock or two late.
  unsigned pulses = 0;
  for (const double at : bus.node(0).pulses()) {
    const double off = at / 1000 - std::round(at / 1e9) * 1e6;
    if (at > bus.now() - kInterval && off > 0 && off < 1000) ++pulses;
  }
  outcome.lost_pulses = pulses < 18;
  return outcome;
}

}  // namespace vericansim

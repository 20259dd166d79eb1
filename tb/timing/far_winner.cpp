// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// prove_far_winner(): see far_winner.hpp.
#include "timing/far_winner.hpp"

#include <array>
#include <memory>
#include <string>

#include "bus/bus.hpp"
#include "node/core_node.hpp"

namespace vericansim {
namespace {

enum : NodeId { kFar, kLoser, kListener, kNodes };
constexpr unsigned kContests = 10;  // a bus

class Rig {
 public:
  Rig(const RowPromise &promise, bool winner_is_fast, std::mt19937_64 &random)
      : bit_{static_cast<Time>(promise.timing.clocks_per_bit() * 1e12 / promise.clock_hz)} {
    const auto period = static_cast<std::uint64_t>(1e12 / promise.clock_hz);
    const std::array<double, kNodes> signs{winner_is_fast ? 1.0 : -1.0, 1.0, -1.0};
    for (NodeId i = 0; i < kNodes; ++i) {
      const ClockConfig clock{.frequency_hz = promise.clock_hz,
                              .error_ppm = signs[i] * promise.tolerance * 1e6,
                              .phase = static_cast<Time>(random() % period)};
      nodes_[i] = std::make_unique<CoreNode>(std::to_string(i),
                                             CoreConfig{.timing = promise.timing}, clock);
      bus_.add(*nodes_[i]);
    }
    const Time near = static_cast<Time>(promise.node_delay_ns * kNanosecond);
    for (NodeId a = 0; a < kNodes; ++a)
      for (NodeId b = 0; b < kNodes; ++b)
        bus_.set_delay(a, b,
                       near + ((a == kFar) != (b == kFar) ? cable_delay(promise.cable_m) : 0));
    for (auto &node : nodes_) node->start();
    bus_.run_for(16 * bit_);
  }

  /// False if a node saw an error or the frame did not arrive everywhere. The winner hears the
  /// loser's SOF, or begins by itself up to a bit later.
  bool run(const Contest &contest, Time later) {
    for (auto &node : nodes_) {
      node->clear_events();
      node->received().clear();
    }
    nodes_[kLoser]->request(contest.loser, true);
    bus_.run_for(later % bit_);
    nodes_[kFar]->request(contest.winner, true);
    bus_.run_for(180 * bit_);
    bool clean = nodes_[kFar]->events().sent + nodes_[kLoser]->events().sent > 0;
    for (auto &node : nodes_) clean = clean && node->events().errors == 0;
    return clean && !nodes_[kListener]->received().empty();
  }

  [[nodiscard]] std::uint64_t node_cycles() const {
    std::uint64_t sum = 0;
    for (const auto &node : nodes_) sum += node->oscillator().cycles();
    return sum;
  }

 private:
  Time bit_;
  Bus bus_;
  std::array<std::unique_ptr<CoreNode>, kNodes> nodes_;
};

}  // namespace

RowProof prove_far_winner(const RowPromise &promise, unsigned buses, std::uint64_t seed) {
  constexpr unsigned kDifferent = 100;
  const std::vector<Contest> contests = worst_contests(promise, kDifferent, seed);
  std::mt19937_64 random{seed};
  RowProof proof;
  for (unsigned number = 0; number < buses; ++number) {
    Rig rig{promise, number % 2 == 1, random};
    bool clean = true;
    for (unsigned i = 0; clean && i < kContests; ++i, ++proof.frames)
      clean = rig.run(contests[random() % contests.size()], static_cast<Time>(random() >> 1));
    ++proof.buses;
    proof.dirty += !clean;
    proof.node_cycles += rig.node_cycles();
  }
  return proof;
}

}  // namespace vericansim

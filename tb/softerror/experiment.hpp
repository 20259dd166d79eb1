// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// One flip and what came of it: the traffic after it, then the question whether the node still
// works, then what it takes to make it work again.
#pragma once

#include <array>
#include <cstdint>

#include "softerror/world.hpp"

namespace vericansim {

/// What it takes until the node sends and receives everything again.
enum class Cure : std::uint8_t {
  kNone,         ///< nothing: it does so by itself
  kRenew,        ///< flags cleared, buffers given their codes again
  kReconfigure,  ///< freeze mode and the whole configuration again
  kSoftReset,
  kHardReset,  ///< nothing that software can do helps
  kNever,      ///< not even that: the test bench is wrong
};

/// What is flipped.
struct Flip {
  enum class Kind : std::uint8_t { kNothing, kFlop, kRam, kStuckAt0, kStuckAt1 };
  Kind kind = Kind::kNothing;
  std::uint32_t index = 0;  ///< of FlopNode::flops(), or a bit of the RAMs
};

/// What has been seen; plain data, for it crosses a process boundary.
struct Outcome {
  Flip flip;
  std::uint64_t seed = 0;
  std::uint64_t time = 0;     ///< of the flip, clocks since the world began
  bool finished = false;      ///< the run has come to its end
  bool vanished = false;      ///< the core's whole state is what it would be without the flip
  bool bus_differs = false;   ///< the node's pin
  bool host_differs = false;  ///< interrupts, or what the CPU read
  bool config_changed = false;
  bool ahb_hangs = false;
  bool run_too_long = false;  ///< dominant for longer than any rule allows
  bool bus_blocked = false;   ///< the neighbours did not get through any more
  Cure cure = Cure::kNone;
  std::uint32_t errors = 0;  ///< of all nodes, from the flip on
  std::uint32_t bus_offs = 0;
  std::uint32_t wrong_sent = 0;      ///< frames that nobody was to send, at a neighbour
  std::uint32_t wrong_received = 0;  ///< ... in the driver
  std::uint32_t lost_sent = 0;       ///< reported sent, and not received by both
  std::uint32_t lost_received = 0;   ///< sent by a neighbour, not received by the driver
  std::uint32_t told = 0;            ///< overruns that the controller has told
  std::uint32_t twice = 0;           ///< received more than once, anywhere
  std::uint32_t others = 0;          ///< frames between the neighbours lost
  std::uint32_t longest_run = 0;     ///< tenths of own bits
  std::uint32_t longest_gap = 0;     ///< nominal bits without a good frame, a neighbour waiting
  std::uint32_t recovery = 0;        ///< nominal bits until the last error, or until cured
};

/// The states of the run without a flip, every kCheckClocks.
struct Reference {
  static constexpr unsigned kCheckClocks = 1024;
  static constexpr unsigned kChecks = 24;
  std::array<std::uint64_t, kChecks> state{};
  std::array<std::uint64_t, kChecks> bus{};
  std::array<std::uint64_t, kChecks> host{};
  std::uint64_t end_bus = 0;
  std::uint64_t end_host = 0;
};

/// Clocks of traffic after the flip.
inline constexpr std::uint64_t kAftermath =
    std::uint64_t{Reference::kCheckClocks} * Reference::kChecks;

/// Runs the rest of the world's scene from now on. Without a flip (Kind::kNothing) it fills
/// `reference`; with one it compares with it.
[[nodiscard]] Outcome experiment(World &world, const Flip &flip, Reference &reference);

}  // namespace vericansim

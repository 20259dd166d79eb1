// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlTraffic: who else is on the bus of a case in RTL: other frames, and error frames.
#pragma once

#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "bus/bus.hpp"
#include "node/core_node.hpp"
#include "timesync/sync_case.hpp"

namespace vericansim {

/// Drives the bus dominant for longer than any frame may, when told to: an error that all nodes
/// see, wherever in a frame.
class ErrorSource : public Node {
 public:
  /// `bitrate`, bit/s: an edge for each bit.
  explicit ErrorSource(double bitrate);

  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t quiet() const override { return bits_ == 0 ? ~0ULL : 0; }
  [[nodiscard]] std::uint64_t skip_period() const override { return bits_ == 0 ? 1 : 0; }

  /// From the next edge on.
  void disturb();

 private:
  unsigned bits_ = 0;  // still to come
};

/// The engine in RTL sends frames of the longest base format: `load` of the bus at most, frames
/// independent of each other. The source of errors hits each bit of a bus that is not idle with the
/// probability bit_errors.
class RtlTraffic {
 public:
  /// Calls software at a time, as RtlBench::at().
  using At = std::function<void(Time when, std::function<void()> software)>;

  /// Joins `bus`; it and what `at` uses must outlive it.
  RtlTraffic(Bus &bus, const SyncCase &setting, std::uint64_t seed, At at);

  /// Nothing waits to be sent.
  [[nodiscard]] bool silent() const;
  /// Whether somebody else sends, for the source of errors.
  std::function<bool()> others_send;
  /// Called when an error begins, before it is on the bus.
  std::function<void()> on_error;

 private:
  void add_sender(std::uint32_t id, double load);
  void send(CoreNode &sender, std::uint32_t id, double load);
  void disturb();

  Bus &bus_;
  At at_;
  double bit_;  // ps
  double spread_ppm_, bitrate_, bit_errors_;
  std::mt19937_64 dice_;
  std::vector<std::unique_ptr<CoreNode>> senders_;
  std::unique_ptr<ErrorSource> errors_;
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FlopRemote: a Verilated can_remote (profile full, number 3) one of whose flip-flops
// flips at a clock, or is stuck from then on.
#pragma once

#include <cstdint>
#include <memory>

#include "bus/node.hpp"
#include "softerror/flop_places.hpp"

namespace vericansim {

class FlopRemote final : public Node {
 public:
  FlopRemote(const ClockConfig &clock, const FlopFlip &flip);
  ~FlopRemote() override;

  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t trace() const override;
  /// Clocks of rst_ni = 0; the memory is cleared, the node joins again.
  void reset();

  [[nodiscard]] static const FlopPlaces &flops();
  /// The longest time for which the node has sent dominant, clocks.
  [[nodiscard]] unsigned longest_run() const { return longest_run_; }

 private:
  struct Impl;  // keeps the Verilated header out of this one
  void edge();

  std::unique_ptr<Impl> impl_;
  FlopFlip flip_;
  std::uint64_t clocks_ = 0;
  unsigned run_ = 0;
  unsigned longest_run_ = 0;
};

}  // namespace vericansim

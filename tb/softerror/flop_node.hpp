// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FlopNode: a Verilated can_ahb of 64 buffers whose flip-flops can be read and flipped.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "node/rtl_node.hpp"

namespace vericansim {

/// One flip-flop of the core: bit `bit` of variable `variable` (instance path below can_ahb).
struct Flop {
  const char *variable = "";
  unsigned bit = 0;
  [[nodiscard]] std::string name() const {
    return std::string{variable} + "[" + std::to_string(bit) + "]";
  }
};

/// The whole core as one model, all flip-flops of flops.py's list open. Unlike the nodes of
/// RtlNode::create() nothing in it rests: what a clock edge does is done in every clock.
class FlopNode final : public RtlNode {
 public:
  explicit FlopNode(std::string name, const ClockConfig &clock = {});
  ~FlopNode() override;

  void reset() override;
  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t trace() const override;
  [[nodiscard]] std::uint8_t irq_lines() const override;
  void request_stop(bool stop) override;
  [[nodiscard]] bool irq_time() const override;
  [[nodiscard]] bool time_out() const override;
  [[nodiscard]] std::uint64_t time_of_clock() const override;
  void external(bool level) override;
  /// Not for this node: std::logic_error.
  [[nodiscard]] AhbResult peek(const AhbTransfer &transfer) override;

  /// All flip-flops, in the order of flops.py.
  [[nodiscard]] static const std::vector<Flop> &flops();
  /// Inverts flip-flop n of flops() now, that is right after the last clock edge, and lets the
  /// logic behind it settle.
  void flip(unsigned n);
  [[nodiscard]] bool value(unsigned n) const;
  /// From now on flip-flop n is stuck at `level`: a planted defect, to see it found.
  void stick(unsigned n, bool level);

  /// Bits of the buffer RAMs: C/S words, identifiers and data, masks.
  [[nodiscard]] static unsigned ram_bits();
  /// Inverts one of them; returns which RAM it is in: 0 C/S, 1 MSG, 2 MASK.
  unsigned flip_ram(unsigned bit);

  /// Clocks of a bit as CTRL1 has it now, whatever flipped in it.
  [[nodiscard]] unsigned bit_clocks() const;
  /// A digest of the whole state; equal digests and equal inputs mean an equal future.
  [[nodiscard]] std::uint64_t state() const;
  /// Digests of all that has been seen of the node at its transmit pin, and of interrupts and AHB.
  [[nodiscard]] std::uint64_t seen_on_bus() const { return bus_seen_; }
  [[nodiscard]] std::uint64_t seen_by_host() const { return host_seen_; }
  /// The longest time that HREADYOUT was low, and the present one, in clocks.
  [[nodiscard]] unsigned longest_wait() const { return longest_wait_; }

 private:
  struct Impl;  // keeps the Verilated header out of this one

  void edge();
  AhbResponse cycle(const AhbRequest &request);
  static void look(std::uint64_t &seen, std::uint64_t word) {
    seen = (seen ^ word) * 0x9E3779B97F4A7C15ULL + (seen >> 29);
  }

  std::unique_ptr<Impl> impl_;
  std::uint64_t bus_seen_ = 0;
  std::uint64_t host_seen_ = 0;
  unsigned wait_ = 0;
  unsigned longest_wait_ = 0;
};

}  // namespace vericansim

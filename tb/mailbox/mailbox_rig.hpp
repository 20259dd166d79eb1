// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MailboxRig: several whole cores on one bus, each with plain calls for its software and, if
// wanted, a stream of accesses that keeps its AHB busy in every clock.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bus/bus.hpp"
#include "bus/trace.hpp"
#include "harness/core_build.hpp"
#include "harness/test_wave.hpp"
#include "model/frame.hpp"
#include "model/registers.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {

/// CTRL1 timing fields for 8 clocks a bit: PROP 2, PS1 3, PS2 2 tq, SJW 1.
inline constexpr std::uint32_t kTiming8 = (2u << 19) | (1u << 16) | 1u;
/// The same with PROP 1, PS1 3, PS2 3 tq and SJW 3: bits of 5 to 11 clocks.
inline constexpr std::uint32_t kElastic8 = (2u << 22) | (2u << 19) | (2u << 16);

/// What MCR.MCR and CTRL1 get when a node is brought up.
struct RigConfig {
  std::uint32_t mcr = reg::kMcrBcc | reg::kMcrSrxDis;  ///< besides the mode bits and MAXMB
  std::uint32_t ctrl = kTiming8;
};

/// A message buffer as the CPU reads it.
struct MbWords {
  std::uint32_t cs = 0, id = 0, low = 0, high = 0;
  [[nodiscard]] unsigned code() const { return (cs >> 24) & 0xF; }
  friend bool operator==(const MbWords &, const MbWords &) = default;
};

/// C/S (with `code`) and ID word of a frame, as flexcan.md 3.1 lays them out.
MbWords mb_words(const Frame &frame, unsigned code);
/// The frame in a buffer.
Frame mb_frame(const MbWords &words);

/// The cores. All run on one ideal clock of 8 MHz unless told otherwise.
class MailboxRig {
 public:
  explicit MailboxRig(unsigned nodes = 1, unsigned num_mb = 64);
  /// With nodes of a build.
  MailboxRig(unsigned nodes, const CoreBuild &build);
  /// With these nodes, all of the same size, at least one.
  explicit MailboxRig(std::vector<std::unique_ptr<RtlNode>> nodes);

  RtlNode &node(unsigned n) { return *nodes_[n]; }
  Bus &bus() { return bus_; }
  [[nodiscard]] unsigned num_mb() const { return num_mb_; }
  [[nodiscard]] unsigned node_count() const { return static_cast<unsigned>(nodes_.size()); }

  /// Accesses; the bus runs until they are done.
  std::uint32_t read(unsigned n, std::uint32_t address) {
    return access(n, {.address = address}).data;
  }
  void write(unsigned n, std::uint32_t address, std::uint32_t data) {
    access(n, {.address = address, .write = true, .data = data});
  }
  AhbResult access(unsigned n, const AhbTransfer &transfer);
  /// Transfers back to back, in one go; results in the same order.
  std::vector<AhbResult> burst(unsigned n, const std::vector<AhbTransfer> &transfers);

  /// Transfers that fill every free clock of node n's AHB from now on; nullptr: none.
  void hammer(unsigned n, std::function<AhbTransfer()> next) { hammers_[n] = std::move(next); }

  /// Runs `clocks` clocks of the 8 MHz clock.
  void run(unsigned clocks);
  /// Runs until `done()`; false if `clocks` passed first.
  bool run_until(const std::function<bool()> &done, unsigned clocks);

  /// Leaves disable mode, sets the configuration in freeze mode and stays there.
  void configure(unsigned n, const RigConfig &config = {});
  /// Leaves freeze mode and waits until the node has integrated.
  void go(unsigned n);
  /// Requests freeze mode and waits for its acknowledge; false if it does not come within `clocks`.
  bool freeze(unsigned n, unsigned clocks = 4000);

  /// Writes a buffer in the order of flexcan.md 3.3: data, ID, C/S last.
  void put(unsigned n, unsigned mb, const MbWords &words);
  void put_tx(unsigned n, unsigned mb, const Frame &frame) { put(n, mb, mb_words(frame, 0xC)); }
  /// Makes buffer mb receive frames like `like` (IDE and ID); with `mask` if given (freeze mode).
  void put_rx(unsigned n, unsigned mb, const Frame &like, std::optional<std::uint32_t> mask = {});
  /// Reads a buffer the way drivers do; does not unlock.
  MbWords get(unsigned n, unsigned mb);
  /// IFLAG2:IFLAG1.
  std::uint64_t flags(unsigned n);
  void clear_flag(unsigned n, unsigned mb);
  /// Runs until IFLAG of mb is set; false if that takes more than `clocks`.
  bool wait_flag(unsigned n, unsigned mb, unsigned clocks = 4000);

  /// What node n is doing.
  [[nodiscard]] Field field(unsigned n) { return trace_field(node(n).trace()); }
  [[nodiscard]] bool violated() const;
  [[nodiscard]] unsigned max_waits() const;

 private:
  void step();

  Bus bus_;
  unsigned num_mb_;
  std::vector<std::unique_ptr<RtlNode>> nodes_;
  std::vector<std::function<AhbTransfer()>> hammers_;
  std::vector<BusMaster::Ticket> last_;  // newest ticket + 1
  std::optional<TestWave> wave_;
};

}  // namespace vericansim

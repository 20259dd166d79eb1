// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeNode: a whole core of 64 buffers with the time unit, every clock of it evaluated.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "Vcan_ahb_time.h"
#include "mailbox/mailbox_rig.hpp"
#include "node/model_context.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {

/// ns a clock of every TimeNode: what its clock of 8 MHz needs (TB_TIME_INC in CMakeLists.txt).
inline constexpr std::uint64_t kTimeStep = 125;

/// Registers of the time unit (docs/registers.md).
namespace time_reg {
inline constexpr std::uint32_t kTcap = 0x1100, kTctrl = 0x1104, kTstat = 0x1108;
inline constexpr std::uint32_t kTimelo = 0x1110, kTimehi = 0x1114, kTincn = 0x1118;
inline constexpr std::uint32_t kTincf = 0x111C, kTshlo = 0x1120, kTshhi = 0x1124;
inline constexpr std::uint32_t kTslew = 0x1128, kTcmp = 0x1130, kTcmph = 0x1134;
inline constexpr std::uint32_t kTtx = 0x1140, kTtxmb = 0x1144;
inline constexpr std::uint32_t kTextlo = 0x1150, kTexthi = 0x1154;
inline constexpr std::uint32_t stamp(unsigned mb) { return 0x1400 + 8 * mb; }
}  // namespace time_reg

/// The core in one model.
class TimeNode final : public RtlNode {
 public:
  explicit TimeNode(std::string name, const ClockConfig &clock = {});
  ~TimeNode() override;

  void reset() override;
  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t trace() const override;
  [[nodiscard]] std::uint8_t irq_lines() const override;
  void request_stop(bool stop) override;
  [[nodiscard]] AhbResult peek(const AhbTransfer &transfer) override;

  /// Clock edges since the reset ended: TIME is kTimeStep times that while nobody sets it (TM-10).
  [[nodiscard]] std::uint64_t edges() const { return edges_; }
  /// Edges after which the transmit flip-flop had gone dominant.
  [[nodiscard]] const std::vector<std::uint64_t> &falls() const { return falls_; }
  /// Edges after which the trace told that a frame had become valid: the end of EOF6's sample
  /// point.
  [[nodiscard]] const std::vector<std::uint64_t> &valids() const { return valids_; }
  /// Edges after which `time_out_o` had changed.
  [[nodiscard]] const std::vector<std::uint64_t> &pulses() const { return pulses_; }
  [[nodiscard]] bool irq_time() const { return top_.irq_time_o != 0; }
  void external(bool level) { top_.ext_i = level; }

 private:
  void edge();

  VerilatedContext context_;
  Vcan_ahb_time top_{&context_, "time"};
  ModelContext model_context_{context_};
  std::uint64_t edges_ = 0;
  bool dominant_ = false, out_ = false;
  std::vector<std::uint64_t> falls_, valids_, pulses_;
};

/// MailboxRig of `nodes` of them.
struct TimeRig {
  explicit TimeRig(unsigned count) : TimeRig{std::vector<Time>(count, 0)} {}
  /// With the time of the first edge of each clock, ps.
  explicit TimeRig(const std::vector<Time> &first_edges);
  TimeNode &node(unsigned n) { return *nodes[n]; }
  /// TIME of node n as software reads it.
  std::uint64_t time(unsigned n);
  /// The stamp of a buffer.
  std::uint64_t stamp(unsigned n, unsigned mb);

  /// When edge number `edge` of node n came (TimeNode::edges()); one is before the bus begins.
  [[nodiscard]] Time at(unsigned n, std::uint64_t edge) const {
    return phases[n] + (static_cast<Time>(edge) - 2) * static_cast<Time>(kTimeStep) * kNanosecond;
  }

  std::vector<TimeNode *> nodes;
  std::vector<Time> phases;
  MailboxRig rig;

 private:
  static std::vector<std::unique_ptr<RtlNode>> make(const std::vector<Time> &first_edges,
                                                    std::vector<TimeNode *> &made);
};

}  // namespace vericansim

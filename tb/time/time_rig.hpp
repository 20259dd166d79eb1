// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeRig: MailboxRig of cores with the time unit, and the addresses of its registers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mailbox/mailbox_rig.hpp"
#include "node/time_node.hpp"

namespace vericansim {

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

/// MailboxRig of `nodes` of them.
struct TimeRig {
  explicit TimeRig(unsigned count) : TimeRig{std::vector<Time>(count, 0)} {}
  /// With the time of the first edge of each clock, ps.
  explicit TimeRig(const std::vector<Time> &first_edges);
  /// With these clocks.
  explicit TimeRig(const std::vector<ClockConfig> &clocks);
  TimeNode &node(unsigned n) { return *nodes[n]; }
  /// TIME of node n as software reads it.
  std::uint64_t time(unsigned n);
  /// The stamp of a buffer.
  std::uint64_t stamp(unsigned n, unsigned mb);

  /// When edge number `edge` of node n came (TimeNode::edges()), if its clock is right.
  [[nodiscard]] Time at(unsigned n, std::uint64_t edge) const {
    const auto ticks = static_cast<Time>(edge - TimeNode::kEdgesOfReset);
    return phases[n] + ticks * static_cast<Time>(kTimeStep) * kNanosecond;
  }

  std::vector<TimeNode *> nodes;
  std::vector<Time> phases;
  MailboxRig rig;

 private:
  static std::vector<std::unique_ptr<RtlNode>> make(const std::vector<ClockConfig> &clocks,
                                                    std::vector<TimeNode *> &made);
};

}  // namespace vericansim

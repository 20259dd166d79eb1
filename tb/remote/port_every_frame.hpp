// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Every base frame, and every access of the ports READ and WRITE, at the engine's port of a remote
// node, RTL and model in lockstep (RN-101).
#pragma once

#include <cstdint>
#include <string>

namespace vericansim {

/// A node with a number, locked or not (NameBits 3).
struct PortSetting {
  std::string profile;
  unsigned number = 3;
  bool unlocked = false;
};
/// The numbers 0 to 7, each locked and not.
constexpr unsigned kPortSettings = 16;
PortSetting port_setting(const std::string &profile, unsigned index);

struct PortRun {
  std::uint64_t frames = 0;
  std::uint64_t answers = 0;
  std::string difference;  ///< the first, with what led there; empty: none
};

/// Every `stride`th of the 65,536 pairs of identifier, RTR and DLC, from `first` on, with random
/// data. Before each frame the node has the number and the lock of `setting`.
PortRun run_every_frame(const PortSetting &setting, unsigned stride, unsigned first, unsigned seed);

/// READ and WRITE of every `stride`th pair of address (12 bits, and as many with bits above) and
/// length 0 to 7, from `first` on.
PortRun run_every_access(const PortSetting &setting, unsigned stride, unsigned first,
                         unsigned seed);

}  // namespace vericansim

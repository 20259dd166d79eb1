// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SaturatedBus: whole cores at 1 Mbit/s whose software always has the next frame ready.
#pragma once

#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "node/host.hpp"

namespace vericansim {

/// Nodes on a bus that is never idle. `drift`: every oscillator has its own error, and the kernel
/// runs by events; otherwise all nodes share an ideal clock. `with_time`: cores with the time unit.
class SaturatedBus {
 public:
  SaturatedBus(unsigned nodes, unsigned megahertz, bool drift, bool with_time = false);

  void run_for(Time duration) { bus_.run_for(duration); }
  [[nodiscard]] std::uint64_t cycles() const;
  /// Frames received by all nodes together.
  [[nodiscard]] std::uint64_t received() const;
  [[nodiscard]] Bus &bus() { return bus_; }
  [[nodiscard]] Host &host(unsigned i) { return *hosts_[i]; }

  /// Bit timing of 1 Mbit/s at 8, 16, 50 or 80 MHz.
  static BitTiming timing(unsigned megahertz);

 private:
  Bus bus_;
  std::vector<std::unique_ptr<RtlNode>> nodes_;
  std::vector<std::unique_ptr<Host>> hosts_;
};

}  // namespace vericansim

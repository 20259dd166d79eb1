// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RegisterShadow: the settings of a core as the CPU's writes to MCR, CTRL1, CTRL2 and XCTRL make
// them (flexcan.md 1 and 2), so that a judge can follow a node whose software it does not know.
#pragma once

#include <cstdint>

#include "model/buffer_match.hpp"
#include "model/node_model.hpp"

namespace vericansim {

/// The registers that decide how a node behaves. Starts with the values after a hard reset.
class RegisterShadow {
 public:
  /// What a write has brought about.
  struct Change {
    bool configuration = false;  ///< something that the buffers or the rules depend on
    bool soft_reset = false;
    bool stop = false;  ///< freeze, disable or soft reset is asked for
  };

  explicit RegisterShadow(unsigned num_mb) : num_mb_{num_mb} {}

  /// A write of the bits in `lanes`; `running`: the core takes part in the bus, so that what may be
  /// written in freeze mode alone stays. Other addresses change nothing.
  Change write(std::uint32_t address, std::uint32_t data, std::uint32_t lanes, bool running);

  /// In freeze mode, if the core does not run.
  [[nodiscard]] bool disabled() const;
  [[nodiscard]] BufferConfig buffers() const;
  [[nodiscard]] NodeConfig node() const;

 private:
  Change write_mcr(std::uint32_t data, std::uint32_t lanes, bool frozen);

  unsigned num_mb_;
  std::uint32_t mcr_ = 0xD890000F;
  std::uint32_t ctrl1_ = 0;
  std::uint32_t ctrl2_ = 0;
  std::uint32_t xctrl_ = 0;
};

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteMemory: the bytes of a node, and who may do what with them (section 8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/remote_config.hpp"
#include "model/remote_status.hpp"

namespace vericansim {

/// Memory, configuration, tables and rows of one node. The engine's own bytes (E00..EFF) are not
/// here: what is where in them is no one's business; the shadow has its own accessor.
class RemoteMemory {
 public:
  /// As after reset with the number `node`. `status` gives the rows and must outlive this.
  RemoteMemory(const RemoteConfig &config, const RemoteStatus &status, unsigned node);

  /// The byte that a bus read of `address` (0..FFF) sees; 0 where nothing is.
  [[nodiscard]] std::uint8_t operator[](unsigned address) const;
  /// 16 bits, little-endian.
  [[nodiscard]] unsigned word(unsigned address) const {
    return (*this)[address] | (*this)[address + 1] << 8;
  }

  /// What the bus gets for reading `n` bytes (1..8) from `address` (16 bits): accepted, illegal
  /// address or protected.
  [[nodiscard]] RemoteCode check_read(unsigned address, unsigned n) const;
  /// The same for a write; `open`: configuration and tables may be written.
  [[nodiscard]] RemoteCode check_write(unsigned address, unsigned n, bool open) const;

  /// A bus write that has been checked: staged bytes go to the shadow (RN-46).
  void bus_write(unsigned address, std::span<const std::uint8_t> bytes);
  /// TRIGGER in OPERATE: the shadow becomes visible.
  void apply_stage();
  /// A write of user logic; ignored where it has no right (RN-53).
  void user_write(unsigned address, std::uint8_t byte);

  [[nodiscard]] const std::vector<std::uint8_t> &shadow() const { return shadow_; }

 private:
  enum class Area { kNone, kMemory, kConfig, kRow };
  [[nodiscard]] Area area(unsigned address) const;
  [[nodiscard]] bool nowhere(unsigned first, unsigned last) const;
  [[nodiscard]] bool denied(unsigned table, unsigned address) const;

  const RemoteConfig &config_;
  const RemoteStatus &status_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint8_t> shadow_;
};

}  // namespace vericansim

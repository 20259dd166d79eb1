// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteMaps: what a node takes over from the statements of others (RN-65, RN-66).
#pragma once

#include <optional>
#include <vector>

#include "model/frame.hpp"
#include "model/remote_memory.hpp"

namespace vericansim {

/// The entries at F80 with their time-outs.
class RemoteMaps {
 public:
  /// Where the bytes of a frame go.
  struct Place {
    unsigned entry = 0;
    unsigned address = 0;
    unsigned length = 0;  ///< 0..8
    bool trigger = false;
  };

  /// Both must outlive this.
  RemoteMaps(const RemoteConfig &config, const RemoteMemory &memory);

  /// The lowest entry for a base data frame that is no request to this node, if it is long enough
  /// for that one.
  [[nodiscard]] std::optional<Place> find(const Frame &frame) const;
  /// A frame of the entry has been taken.
  void taken(unsigned entry);
  void tick();
  /// All time-outs begin anew.
  void restart();

  /// An entry has waited too long.
  [[nodiscard]] bool stale() const;
  /// One whose time-out leads to SAFE.
  [[nodiscard]] bool stale_leads_to_safe() const;

 private:
  [[nodiscard]] bool on(unsigned k) const;
  [[nodiscard]] bool matches(unsigned k, const Frame &frame) const;
  [[nodiscard]] unsigned flags(unsigned k) const { return memory_[address(k) + 6]; }
  [[nodiscard]] static unsigned address(unsigned k) { return remote_map::kMaps + 8 * k; }
  [[nodiscard]] bool is_late(unsigned k) const;

  const RemoteConfig &config_;
  const RemoteMemory &memory_;
  std::vector<unsigned> waited_;  // ms
};

}  // namespace vericansim

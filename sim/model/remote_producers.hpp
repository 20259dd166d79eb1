// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteProducers: statements that a node makes by itself (RN-63, RN-64).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/frame.hpp"
#include "model/remote_memory.hpp"

namespace vericansim {

/// The entries at F40 with their timers and due bits.
class RemoteProducers {
 public:
  /// Both must outlive this.
  RemoteProducers(const RemoteConfig &config, const RemoteMemory &memory);

  /// A millisecond has passed. `operate`: entries with data may send.
  void tick(bool operate);
  /// A TRIGGER has been obeyed.
  void trigger(bool operate);
  /// User logic wants entry `k` sent; take() knows whether it may. Throws std::out_of_range if
  /// there is none.
  void event(unsigned k);
  /// Nothing is due any longer.
  void clear_due();

  /// The statement of the lowest entry that is due and may be sent, which is then no longer due;
  /// `number`: of the node.
  [[nodiscard]] std::optional<Frame> take(unsigned number, bool operate);

 private:
  struct Entry {
    bool off = true;  ///< switched off
    bool on = false;  ///< not, and all its fields are legal
    bool by_trigger = false;
    bool on_change = false;
    bool cyclic = false;
    bool row = false;  ///< STATUS or IDENT, not data
    unsigned a = 0;
    unsigned address = 0;
    unsigned length = 0;
    unsigned period = 0;
    unsigned gap = 0;
  };
  struct Timer {
    bool due = false;
    unsigned left = 0;                   // ms or TRIGGERs of this period; 0: it has not begun
    unsigned gap_left = 0;               // ms
    std::array<std::uint8_t, 8> last{};  // bytes last sent
  };
  [[nodiscard]] Entry entry(unsigned k) const;
  [[nodiscard]] bool changed(const Entry &entry, const Timer &timer) const;
  static void step(const Entry &entry, Timer &timer, bool allowed);

  const RemoteConfig &config_;
  const RemoteMemory &memory_;
  std::vector<Timer> timers_;
};

}  // namespace vericansim

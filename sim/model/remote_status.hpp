// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteStatus: what a node tells of itself: the rows STATUS and IDENT and the counters.
#pragma once

#include <array>
#include <cstdint>

#include "model/remote_config.hpp"

namespace vericansim {

/// The eight counters at FE8 (RN-35).
enum class RemoteCounter : std::uint8_t {
  kFunction,
  kValue,
  kAddress,  ///< address, protection and lock
  kBusy,     ///< busy, and answers that were dropped
  kDuplicate,
  kBusOff,
  kSequence,  ///< sequence, time-out, TRIGGER count not last + 1
  kHold,
};

/// Fields of STATUS (RN-24), with the counters beside them.
struct RemoteStatus {
  RemoteState state = RemoteState::kInit;
  bool unlocked = false;
  bool duplicate = false;  ///< DUP
  bool stale = false;
  bool watchdog = false;
  bool bus_off = false;
  std::uint8_t tec = 0;
  std::uint8_t rec = 0;
  RemoteCode code = RemoteCode::kAccepted;  ///< of the last request that was counted
  std::uint8_t a = 0;                       ///< of the same
  std::uint8_t accepted = 0;                ///< modulo 256
  std::uint8_t refused = 0;                 ///< modulo 256
  std::uint8_t trigger = 0;                 ///< the last TRIGGER's count
  std::array<std::uint8_t, 8> counters{};   ///< each stops at FF
  std::array<std::uint8_t, 16> clock{};     ///< row of the clock (TM-108), which is no model's

  /// A request that changes something was accepted; `result`: accepted or open.
  void accept(unsigned at, RemoteCode result = RemoteCode::kAccepted);
  /// A request was refused.
  void refuse(unsigned at, RemoteCode why);
  void count(RemoteCounter counter);
  /// CLEAR: counters and the flags DUP, watchdog and bus-off.
  void clear();
  /// The row STATUS.
  [[nodiscard]] std::array<std::uint8_t, 8> row() const;
};

/// The row IDENT (RN-25).
[[nodiscard]] std::array<std::uint8_t, 8> remote_ident(const RemoteConfig &config);

}  // namespace vericansim

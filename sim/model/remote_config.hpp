// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteConfig: the parameters of can_remote, and the numbers of its memory map and of its results.
#pragma once

#include <cstdint>
#include <string>

namespace vericansim {

/// Results of commands, as STATUS byte 3 and the answers of BLOCK show them (RN-31).
enum class RemoteCode : std::uint8_t {
  kAccepted = 0x00,
  kFunction = 0x01,  ///< unknown port or system function, remote frame to a port that has none
  kAddress = 0x02,   ///< not in memory, hidden, beyond the window, wrap
  kValue = 0x03,     ///< DLC, length, op or count that the command does not have
  kOpen = 0x05,      ///< accepted, not finished: block write opened
  kBusy = 0x06,      ///< answer queue full, a block transfer runs
  kProtected = 0x10,
  kLocked = 0x11,
  kSequence = 0x12,
  kTimeout = 0x13,
  kAborted = 0x14,
};

/// States of a node, as bits 1:0 of STATUS byte 0 (RN-70).
enum class RemoteState : std::uint8_t { kInit = 0, kListen = 1, kSafe = 2, kOperate = 3 };

/// Places in the memory of a node (section 8).
namespace remote_map {
inline constexpr unsigned kStage = 0x010;
inline constexpr unsigned kHidden = 0xE00;  ///< the engine's own bytes
inline constexpr unsigned kNode = 0xF00;
inline constexpr unsigned kFlags = 0xF01;
inline constexpr unsigned kWatchdog = 0xF02;  ///< 16 bits, ms
inline constexpr unsigned kBackOff = 0xF04;   ///< ms
inline constexpr unsigned kLife = 0xF05;      ///< x 10 ms
inline constexpr unsigned kBlockTimeout = 0xF06;
inline constexpr unsigned kRetry = 0xF07;
inline constexpr unsigned kWriteProtect = 0xF08;
inline constexpr unsigned kReadProtect = 0xF10;
inline constexpr unsigned kLabel = 0xF18;
inline constexpr unsigned kConfigEnd = 0xF20;
inline constexpr unsigned kProducers = 0xF40;
inline constexpr unsigned kMaps = 0xF80;
inline constexpr unsigned kTablesEnd = 0xFC0;
inline constexpr unsigned kClock = 0xFC0;  ///< TSSTAT, TSOFS, time of the last TRIGGER
inline constexpr unsigned kCounters = 0xFE8;
inline constexpr unsigned kStatus = 0xFF0;
inline constexpr unsigned kIdent = 0xFF8;
inline constexpr unsigned kSize = 0x1000;
}  // namespace remote_map

/// Bits of FLAGS (F01).
namespace remote_flags {
inline constexpr unsigned kErrors = 1;  ///< STATUS follows each refused request
inline constexpr unsigned kWrites = 2;  ///< and each accepted write
inline constexpr unsigned kBoot = 4;    ///< and start and recovery
inline constexpr unsigned kAutoOperate = 8;
}  // namespace remote_flags

/// The last eight values of A are ports (RN-04); this is their order.
enum class RemotePort : std::uint8_t {
  kRead,
  kWrite,
  kBlock,
  kData,
  kSetup,
  kNone,
  kStatus,
  kIdent
};

/// Parameters of can_remote (section 10).
struct RemoteConfig {
  unsigned name_bits = 3;     ///< 3 or 5
  unsigned mem_bytes = 4096;  ///< 1024, 2048, 4096
  unsigned stage_bytes = 8;   ///< 0, 8, 16
  unsigned tx_depth = 1;      ///< 1, 4
  unsigned num_prod = 0;      ///< 0, 4, 8
  unsigned num_map = 0;       ///< 0, 4, 8
  bool protect = false;
  bool block = false;
  bool auto_rate = false;
  bool counters = false;
  bool time_sync = false;  ///< the node has a clock that follows a master (TM-106)
  bool same_id = false;    ///< direct reads are answered with the identifier of the request (RN-16)
  std::uint32_t serial = 0;
  unsigned rate_rows = 8;  ///< rows of the rate table that the clock can do (RN-73)

  /// "small", "standard" or "full". Throws std::invalid_argument for another name.
  [[nodiscard]] static RemoteConfig profile(const std::string &name);
  /// Throws std::invalid_argument that names the parameter and what is allowed.
  void validate() const;

  friend bool operator==(const RemoteConfig &, const RemoteConfig &) = default;

  [[nodiscard]] unsigned address_bits() const { return 10 - name_bits; }
  /// The first A that is a port: beyond the window.
  [[nodiscard]] unsigned first_port() const { return (1U << address_bits()) - 8; }
  [[nodiscard]] unsigned highest_number() const { return (1U << name_bits) - 1; }
  /// IDENT byte 1 (RN-25).
  [[nodiscard]] std::uint8_t features() const;
  /// Identifier {dir, name, A} (RN-02).
  [[nodiscard]] unsigned id(unsigned dir, unsigned name, unsigned a) const {
    return dir << 10 | name << address_bits() | a;
  }
  /// Identifier of a statement of node `number` at a port.
  [[nodiscard]] unsigned id(unsigned number, RemotePort port) const {
    return id(1, number, first_port() + static_cast<unsigned>(port));
  }
};

}  // namespace vericansim

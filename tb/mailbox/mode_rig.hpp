// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ModeRig: a core that is asked to leave the bus, a peer that sends or receives, and a witness that
// acknowledges everything.
#pragma once

#include <cstdint>
#include <string>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {

/// The ways to take a core off the bus (flexcan.md section 2).
enum class Leave : std::uint8_t { kFreeze, kDisable, kSoftReset, kStop };
inline constexpr Leave kAllWays[] = {Leave::kFreeze, Leave::kDisable, Leave::kSoftReset,
                                     Leave::kStop};
std::string to_string(Leave how);

/// Three cores with 16 buffers on one bus, 8 clocks a bit. Buffer kRxMb of each takes any base
/// frame.
class ModeRig {
 public:
  static constexpr unsigned kSubject = 0, kPeer = 1, kWitness = 2;
  static constexpr unsigned kBit = 8;  // clocks
  static constexpr unsigned kRxMb = 3;
  static constexpr std::uint32_t kRunMcr =
      reg::kMcrWrnEn | reg::kMcrBcc | reg::kMcrSrxDis | 15;  ///< MCR on the bus

  explicit ModeRig(std::uint32_t subject_ctrl = kTiming8);

  MailboxRig &rig() { return rig_; }
  /// Runs clocks, and watches the bus: valid frames of each node, dominant clocks of the subject.
  void run(unsigned clocks);
  bool run_until(const std::function<bool()> &done, unsigned clocks);

  /// Asks the subject to leave, without waiting for the access to end.
  void ask(Leave how);
  /// Runs until MCR shows that it has left; the number of clocks since the last ask(), or `limit`
  /// if it has not.
  unsigned left(Leave how, unsigned limit);
  /// Takes the request back and checks nothing; the subject goes to the bus again.
  void come_back(Leave how);
  /// True once the bus has been quiet for 12 bits.
  bool quiet(unsigned limit = 6000);

  /// A register of the subject, watched clock by clock.
  std::uint32_t read(std::uint32_t address) { return access({.address = address}); }

  [[nodiscard]] unsigned valid_frames(unsigned n) const { return valid_[n]; }
  [[nodiscard]] unsigned dominant_clocks() const { return dominant_; }
  void clear_counts();

 private:
  std::uint32_t access(const AhbTransfer &transfer);

  MailboxRig rig_;
  unsigned valid_[3] = {};
  unsigned dominant_ = 0;
  unsigned since_ask_ = 0;
};

}  // namespace vericansim

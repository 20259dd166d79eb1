// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TxRig: a core whose transmissions are counted, and partners on its bus.
#pragma once

#include <cstdint>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {

inline constexpr std::uint32_t kMcrLprioEn = 1u << 13, kMcrAen = 1u << 12;
inline constexpr std::uint32_t kAbortWord = 0x09000000, kInactiveWord = 0x08000000;

/// Node 0 is the one under test; the others acknowledge, and buffer 1 of each takes every frame
/// that node 0 sends.
class TxRig : public MailboxRig {
 public:
  explicit TxRig(unsigned nodes = 2, const RigConfig &config = with_aen());

  /// The usual configuration with MCR.AEN = 1.
  static RigConfig with_aen() {
    RigConfig config;
    config.mcr |= kMcrAen;
    return config;
  }

  /// Leaves freeze mode on all nodes.
  void join();
  /// Runs `clocks` clocks and counts what node 0 does.
  void watch(unsigned clocks);
  /// Writes a word by node 0 and counts meanwhile: as write(), which does not count.
  void write_watched(std::uint32_t address, std::uint32_t data);
  /// Watches until IFLAG of mb is set, which is read in every clock; false after `clocks`.
  bool watch_flag(unsigned mb, unsigned clocks);
  /// Makes node 1 send base frame 0x000 in every gap, or stops that: it wins every arbitration.
  void occupy(bool on);

  /// Counts since reset_counts(): frames node 0 began, sent, and failed to send.
  [[nodiscard]] unsigned starts() const { return starts_; }
  [[nodiscard]] unsigned sent() const { return sent_; }
  [[nodiscard]] unsigned failed() const { return failed_; }
  void reset_counts() { starts_ = sent_ = failed_ = 0; }

  /// Code of a buffer of node 0; counts meanwhile.
  unsigned code(unsigned mb);
  /// Takes what buffer 1 of node 1 has received out of it.
  MbWords received();

 private:
  void count();
  void occupy_next();
  bool occupied_ = false;
  bool next_armed_ = false;  // the frame after the one that node 1 is sending is in its buffer
  unsigned next_ = 0;        // that buffer, the first or the second
  unsigned starts_ = 0, sent_ = 0, failed_ = 0;
};

}  // namespace vericansim

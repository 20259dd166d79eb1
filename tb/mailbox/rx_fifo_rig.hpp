// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RxFifoRig: a core with its Rx FIFO in use and a second one that sends to it; what a filter
// element accepts, told from flexcan.md section 4 bit by bit.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {

/// Settings of the receiver.
struct FifoConfig {
  unsigned format = 2;      ///< MCR.IDAM: 0 A, 1 B, 2 C, 3 D
  unsigned rffn = 0;        ///< 8 x (rffn + 1) filter words
  bool bcc = true;          ///< individual masks
  std::uint32_t ctrl2 = 0;  ///< besides RFFN
  std::uint32_t mcr = reg::kMcrSrxDis;
  std::uint32_t ctrl = kTiming8;
  unsigned num_mb = 64;
};

/// A word of the filter table and its mask (1: compare).
struct FilterWord {
  std::uint32_t word = 0, mask = 0;
};

/// Which element of the word accepts the frame (A: 0, B: 0..1, C: 0..3, upper bits first), if any.
std::optional<unsigned> filter_element(unsigned format, const FilterWord &filter,
                                       const Frame &frame);

/// A frame as the FIFO's output shows it.
struct FifoOutput {
  MbWords words;
  unsigned idhit = 0;
};

/// Node 0 sends, node 1 receives. The table accepts everything until it is set.
class RxFifoRig : public MailboxRig {
 public:
  static constexpr unsigned kSender = 0, kReceiver = 1;

  explicit RxFifoRig(const FifoConfig &config = {});

  /// Writes the settings; in freeze mode. Table and masks: all zero.
  void set(const FifoConfig &config);
  /// Writes word k of the table and its mask, where it has one of its own; in freeze mode.
  void set_filter(unsigned k, const FilterWord &filter);
  /// Both nodes join the bus.
  void join();
  /// Sends a frame and waits until it is through.
  void send(const Frame &frame);

  [[nodiscard]] unsigned first_mailbox() const { return 8 + 2 * config_.rffn; }
  std::uint32_t iflag() { return read(kReceiver, reg::kIflag1); }
  bool available() { return (iflag() & reg::kIflagFifo) != 0; }
  /// The frame at the output.
  FifoOutput output();
  void pop() { write(kReceiver, reg::kIflag1, reg::kIflagFifo); }
  /// Takes all frames out.
  std::vector<Frame> drain();

 private:
  FifoConfig config_;
};

}  // namespace vericansim

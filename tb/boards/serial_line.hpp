// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SerialLine: the other end of a board's serial port, 8N1, by its two wires.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <utility>

namespace vericansim {

/// Sends and receives bytes, clock by clock. `bit_clocks`: clocks of a bit.
class SerialLine {
 public:
  explicit SerialLine(unsigned bit_clocks) : bit_clocks_{bit_clocks} {}

  /// Queues bytes for the board.
  void type(const std::string &bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  /// What the board has sent since the last call.
  std::string said() { return std::exchange(in_, {}); }
  /// Nothing is on its way to the board.
  [[nodiscard]] bool silent() const { return out_.empty() && sending_ == 0; }

  /// Nor has anything been for three bytes, in either direction.
  [[nodiscard]] bool resting() const { return silent() && quiet_ > 30 * bit_clocks_; }

  /// One clock: takes the level that the board sends, returns the one that it receives.
  bool clock(bool from_board) {
    listen(from_board);
    quiet_ = from_board && silent() ? quiet_ + 1 : 0;
    if (sending_ == 0 && !out_.empty()) {
      shift_ = 0x200U | static_cast<std::uint8_t>(out_.front()) << 1U;  // stop, byte, start
      out_.pop_front();
      sending_ = 10 * bit_clocks_;
    }
    if (sending_ == 0) return true;
    const unsigned bit = 10 - (sending_ + bit_clocks_ - 1) / bit_clocks_;
    --sending_;
    return ((shift_ >> bit) & 1U) != 0;
  }

 private:
  // The middle of each bit, from the edge of the start bit on.
  void listen(bool level) {
    if (hearing_ == 0) {
      if (level) return;
      heard_ = 0;
    }
    const unsigned bit = hearing_ / bit_clocks_;
    if (hearing_ % bit_clocks_ == bit_clocks_ / 2) {
      if (bit == 0 && level) {  // no start bit
        hearing_ = 0;
        return;
      }
      if (bit >= 1 && bit <= 8) heard_ |= static_cast<unsigned>(level) << (bit - 1);
      if (bit == 9) {
        if (level) in_.push_back(static_cast<char>(heard_));
        hearing_ = 0;
        return;
      }
    }
    ++hearing_;
  }

  unsigned bit_clocks_;
  unsigned quiet_ = 0;
  std::deque<char> out_;
  std::string in_;
  unsigned shift_ = 0, sending_ = 0;  // clocks left
  unsigned heard_ = 0, hearing_ = 0;  // clocks since the start bit
};

}  // namespace vericansim

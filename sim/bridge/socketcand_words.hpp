// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of a socketcand command, and messages of the bus as socketcand writes them.
// Source: doc/protocol.md of socketcand; what python-can's client reads and writes.
#pragma once

#include <linux/can.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "can_port.hpp"

namespace vericansim {

/// A command cannot be carried out; what() is what the client is told.
class CommandError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a command word by word; each function throws CommandError that names command and word.
class CommandWords {
 public:
  /// `command`: the text between the brackets; must outlive this object.
  explicit CommandWords(std::string_view command);

  /// The first word; empty if there is none.
  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] bool more() const { return !rest_.empty(); }
  /// The next word; `what` is its name in an error.
  std::string_view next(std::string_view what);
  /// A decimal number, 0 to `largest`.
  std::uint64_t decimal(std::string_view what, std::uint64_t largest);
  /// A hexadecimal number, 0 to `largest`.
  std::uint32_t hex(std::string_view what, std::uint32_t largest);
  /// An identifier: 8 digits are 29 bits (CAN_EFF_FLAG is set), up to 3 digits are 11 bits.
  /// python-can up to 4.1 writes 29-bit identifiers without leading zeros, so what has 4 to 7
  /// digits is 29 bits where it does not fit into 11.
  canid_t id();
  /// A DLC and so many bytes.
  void data(can_frame &frame);
  /// Seconds and microseconds, in picoseconds.
  Time interval();
  /// Nothing more may follow.
  void end();
  /// CommandError, with the name of the command in front.
  [[nodiscard]] CommandError error(const std::string &text) const;

 private:
  std::string_view name_;
  std::string_view rest_;
};

/// The rest of "send ID DLC [bytes]". A DLC above 0 without any byte is a remote frame: so does
/// python-can send it, and there is no other meaning it could have.
[[nodiscard]] can_frame send_frame(CommandWords &words);
/// The rest of "sendrtr ID DLC".
[[nodiscard]] can_frame remote_frame(CommandWords &words);

/// "< frame ... >", "< rtr ... >" or "< error CLASS ... >", with a line feed in front. The
/// protocol has the bytes of a frame with `separator` between: a blank in bcmmode, nothing in
/// rawmode.
[[nodiscard]] std::string message_text(const PortMessage &message, std::string_view separator);
/// "< error TEXT >"; brackets in the text become parentheses.
[[nodiscard]] std::string error_text(std::string text);

}  // namespace vericansim

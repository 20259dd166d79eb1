// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CommandSplitter: finds the commands "< ... >" in what a socketcand client sends, however TCP has
// cut or joined it, and names what is none.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vericansim {

/// Bytes in, commands and complaints out. What comes out does not depend on how the bytes were cut
/// into pieces.
class CommandSplitter {
 public:
  /// Longest command without its brackets; a muxfilter of 257 times 8 bytes fits.
  static constexpr std::size_t kLongest = 8192;

  /// A command (the text between the brackets, blanks and printable ASCII only), or what was wrong.
  struct Item {
    bool good = true;
    std::string text;
  };

  /// Adds what has arrived.
  void feed(std::string_view bytes) { input_.append(bytes); }
  /// Says that nothing more will arrive: a command without its end is then a complaint.
  void finish() { finished_ = true; }
  /// The next command or complaint; empty if more bytes are needed.
  [[nodiscard]] std::optional<Item> next();
  /// Bytes that next() has not looked at.
  [[nodiscard]] std::size_t waiting() const { return input_.size() - position_; }

 private:
  enum class State { kOutside, kRubbish, kInside, kSkipping };

  std::optional<Item> outside(char c);
  std::optional<Item> inside(char c);
  Item complain(State next, std::string text);

  std::string input_;
  std::size_t position_ = 0;
  std::string command_;  ///< of kInside
  State state_ = State::kOutside;
  bool finished_ = false;
};

}  // namespace vericansim

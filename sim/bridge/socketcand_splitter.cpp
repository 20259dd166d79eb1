// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Four states: between commands, in rubbish that has been complained about, in a command, in the
// rest of a command that has been complained about.
#include "socketcand_splitter.hpp"

#include <utility>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_printable(char c) { return c >= 0x20 && c < 0x7F; }

}  // namespace

std::optional<CommandSplitter::Item> CommandSplitter::next() {
  std::optional<Item> item;
  while (!item && position_ < input_.size()) {
    const char c = input_[position_++];
    const bool between = state_ == State::kOutside || state_ == State::kRubbish;
    item = between ? outside(c) : inside(c);
  }
  if (position_ == input_.size()) {
    input_.clear();
    position_ = 0;
    if (!item && finished_ && state_ == State::kInside)
      item = complain(State::kOutside, "the connection ended inside a command");
  }
  return item;
}

std::optional<CommandSplitter::Item> CommandSplitter::outside(char c) {
  if (c == '<') {
    command_.clear();
    state_ = State::kInside;
  } else if (!is_blank(c) && state_ == State::kOutside) {
    return complain(State::kRubbish, "text outside of a command: " + in_quotes({c}) +
                                         "; allowed: commands, each in angle brackets");
  }
  return std::nullopt;
}

std::optional<CommandSplitter::Item> CommandSplitter::inside(char c) {
  const bool skipping = state_ == State::kSkipping;
  if (c == '>') {
    state_ = State::kOutside;
    return skipping ? std::nullopt : std::optional<Item>{{true, std::move(command_)}};
  }
  if (c == '<') {
    std::optional<Item> item;
    if (!skipping) item = complain(State::kInside, "a command began inside " + in_quotes(command_));
    command_.clear();
    state_ = State::kInside;
    return item;
  }
  if (skipping) return std::nullopt;
  if (command_.size() == kLongest)
    return complain(State::kSkipping, "a command is longer than " + std::to_string(kLongest) +
                                          " characters: " + in_quotes(command_));
  if (!is_blank(c) && !is_printable(c))
    return complain(State::kSkipping, "a command holds a byte that is not printable ASCII: " +
                                          in_quotes(command_ + c));
  command_ += is_blank(c) ? ' ' : c;
  return std::nullopt;
}

CommandSplitter::Item CommandSplitter::complain(State next, std::string text) {
  state_ = next;
  return {false, std::move(text)};
}

}  // namespace vericansim

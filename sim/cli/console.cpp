// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Console: see console.hpp.
#include "cli/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/cli.hpp"

namespace vericansim::cli {

using firmware::BoardReport;

Console::~Console() {
  for (const auto &[node, line] : lines_)
    if (!line.empty()) fmt::print("{}: {}\n", node, line);
  std::fflush(stdout);
}

void Console::print(std::string_view node, std::string_view text) {
  if (alone_) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
    return;
  }
  std::string &line = lines_[std::string{node}];
  for (const char c : text) {
    line += c;
    if (c != '\n') continue;
    fmt::print("{}: {}", node, line);
    line.clear();
  }
  std::fflush(stdout);
}

void complain(const std::vector<BoardReport> &boards) {
  for (const BoardReport &board : boards)
    if (!board.ok()) fmt::print(stderr, "verican: {}", complaint(board));
}

int exit_code_of(const std::vector<BoardReport> &boards, int other) {
  const auto any = [&](BoardReport::End end) {
    return std::any_of(boards.begin(), boards.end(),
                       [end](const BoardReport &board) { return !board.ok() && board.end == end; });
  };
  if (any(BoardReport::End::kFault)) return kFault;
  return any(BoardReport::End::kLimit) ? kLimit : other;
}

}  // namespace vericansim::cli

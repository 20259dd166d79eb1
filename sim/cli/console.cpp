// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Console: see console.hpp.
#include "cli/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/cli.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"

namespace vericansim::cli {

using firmware::BoardReport;

Console::~Console() {
  for (const auto &[node, line] : lines_)
    if (!line.empty()) std::fputs((node + ": " + line + "\n").c_str(), stdout);
  (void)try_flush_standard_output();  // who ends the command asks again
}

void Console::print(std::string_view node, std::string_view text) {
  if (alone_) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    flush_standard_output();
    return;
  }
  std::string &line = lines_[std::string{node}];
  for (const char c : text) {
    line += c;
    if (c != '\n') continue;
    fmt::print("{}: {}", node, line);
    line.clear();
  }
  flush_standard_output();
}

void complain(const std::vector<BoardReport> &boards) {
  for (const BoardReport &board : boards)
    if (!board.ok()) print_error("verican: {}", complaint(board));
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

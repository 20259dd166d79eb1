// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Console: what the firmware of nodes prints, and how it has ended.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "results/board_report.hpp"

namespace vericansim::cli {

/// Prints what boards print on stdout. A lone board's text comes as it is; of several boards come
/// whole lines, each with the name of its board.
class Console {
 public:
  explicit Console(bool alone) : alone_{alone} {}
  ~Console();
  Console(const Console &) = delete;
  Console &operator=(const Console &) = delete;

  void print(std::string_view node, std::string_view text);

 private:
  bool alone_;
  std::map<std::string, std::string, std::less<>> lines_;  // not yet ended
};

/// Tells on stderr which boards have not ended as they should.
void complain(const std::vector<firmware::BoardReport> &boards);

/// kFault if a CPU was stopped by a fault, kLimit if one should have ended and has not, else
/// `other`.
[[nodiscard]] int exit_code_of(const std::vector<firmware::BoardReport> &boards, int other);

}  // namespace vericansim::cli

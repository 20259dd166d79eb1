// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BoardReport: how the firmware of a node has ended, and what it has printed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim::firmware {

/// One board.
struct BoardReport {
  enum class End { kExit, kFault, kLimit, kInterrupted };
  std::string node;
  std::string file;
  End end = End::kLimit;
  int exit_code = 0;     ///< with kExit
  int wanted_exit = 0;   ///< what the scenario expects; success else
  bool endless = false;  ///< it is not expected to end: kLimit is an end like others
  Time time = 0;         ///< since the start of the firmware
  std::uint64_t clocks = 0, instructions = 0;
  std::string state;   ///< PC, registers and so on, several lines
  std::string output;  ///< all that it has printed
  /// It has ended as it should.
  [[nodiscard]] bool ok() const;
};

/// A table for people, as lines; what the firmware has printed is left out.
[[nodiscard]] std::string to_text(const std::vector<BoardReport> &boards);
/// Everything, times in picoseconds.
[[nodiscard]] nlohmann::ordered_json to_json(const BoardReport &board);

/// Why a board has not ended as it should, with where its CPU is: lines; empty if it has.
[[nodiscard]] std::string complaint(const BoardReport &board);

}  // namespace vericansim::firmware

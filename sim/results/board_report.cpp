// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BoardReport: see board_report.hpp.
#include "results/board_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trace/quantity.hpp"

namespace vericansim::firmware {
namespace {

const char *end_text(BoardReport::End end) {
  switch (end) {
    case BoardReport::End::kExit: return "exit";
    case BoardReport::End::kFault: return "fault";
    case BoardReport::End::kInterrupted: return "interrupted";
    default: return "limit";
  }
}

std::string end_words(const BoardReport &board) {
  switch (board.end) {
    case BoardReport::End::kExit: return fmt::format("exit code {}", board.exit_code);
    case BoardReport::End::kFault: return "stopped by a fault";
    case BoardReport::End::kInterrupted: return "interrupted";
    default: return board.endless ? "runs" : "no end in time";
  }
}

}  // namespace

bool BoardReport::ok() const {
  return end == End::kExit ? exit_code == wanted_exit : end == End::kLimit && endless;
}

std::string to_text(const std::vector<BoardReport> &boards) {
  std::string text = fmt::format("  {:<14} {:>11} {:>12} {:>12}  {}\n", "firmware", "ms", "clocks",
                                 "instructions", "end");
  for (const BoardReport &board : boards)
    text += fmt::format("  {:<14} {:>11.3f} {:>12} {:>12}  {}{}\n", board.node,
                        static_cast<double>(board.time) / kMillisecond, board.clocks,
                        board.instructions, board.ok() ? "" : "FAIL ", end_words(board));
  return text;
}

nlohmann::ordered_json to_json(const BoardReport &board) {
  return {{"node", board.node},
          {"file", board.file},
          {"end", end_text(board.end)},
          {"exit_code", board.exit_code},
          {"time_ps", board.time},
          {"clocks", board.clocks},
          {"instructions", board.instructions},
          {"output", board.output},
          {"state", board.state}};
}

std::string complaint(const BoardReport &board) {
  if (board.ok()) return "";
  const std::string time = readable_time(board.time);
  switch (board.end) {
    case BoardReport::End::kExit:
      return fmt::format("{} ({}) ended with exit code {} after {}\n", board.node, board.file,
                         board.exit_code, time);
    case BoardReport::End::kFault:
      return fmt::format("stopped by a fault after {}\n{}", time, board.state);
    case BoardReport::End::kInterrupted:
      return fmt::format("interrupted after {}\n{}", time, board.state);
    default:
      return fmt::format("no end within the limit of {} (--time, --endless)\n{}", time,
                         board.state);
  }
}

}  // namespace vericansim::firmware

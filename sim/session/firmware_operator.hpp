// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FirmwareOperator: a board whose firmware works a node of a session, and perhaps a second one.
#pragma once

#include <memory>
#include <string>

#include "firmware/board.hpp"
#include "results/board_report.hpp"
#include "session/operator.hpp"

namespace vericansim::firmware {

/// Clocks the board's CPU after its cores. The CPU leaves reset when the scenario begins and stops
/// with it.
class FirmwareOperator : public Operator {
 public:
  /// Reads the ELF file, if that has not been done. A node with SecondCoreRole for this one, on any
  /// bus, is the board's second core. Throws InputError if the file cannot be used.
  explicit FirmwareOperator(const OperatorContext &context);

  void begin(Time now) override { start_ = now; }
  [[nodiscard]] Time next_edge() const override;
  void clock(Time now) override;
  [[nodiscard]] bool idle() const override { return board_->ended(); }
  [[nodiscard]] bool done() const override { return board_->ended(); }
  void end(Time elapsed) override;
  void report(RunReport &report) override;

 private:
  FirmwareRole role_;
  int wanted_exit_ = 0;
  std::unique_ptr<Board> board_;
  std::string printed_;
  Time start_ = 0;
  Time time_ = 0;
};

}  // namespace vericansim::firmware

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Firmware on simulated buses: boards with their CPUs among the nodes of a scenario.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/cortex_m3.hpp"
#include "results/board_report.hpp"
#include "results/report.hpp"
#include "scenario/scenario.hpp"

namespace vericansim::firmware {

/// What to run.
struct FirmwareSetup {
  std::vector<ElfImage> images;  ///< a board for each
  /// The bus, and with a second one the bus of the (only) board's second core.
  std::vector<Scenario> scenarios;
  bool second_core = false;  ///< of the only board, on the same bus; implied by a second bus
  double bitrate = 0;        ///< bit/s; 0: the first of the scenario
  Time limit = 0;            ///< longest simulated time; 0: duration and drain of the scenario
  bool endless = false;      ///< the firmware is not expected to end: the limit is its end
  CortexConfig cpu;
};

struct FirmwareReport {
  std::vector<BoardReport> boards;
  std::vector<RunReport> buses;
  /// Every board has ended as it should, with exit code 0, and all expectations hold.
  [[nodiscard]] bool ok() const;
};

/// Name of the node that core `index` of the set-up is: "firmware", "firmware2", "firmware3"...
/// A node of the scenario with that name (its clock, cable, faults) becomes the board's; otherwise
/// one is added.
[[nodiscard]] std::string firmware_node(std::size_t index);

/// Runs until every board has ended, the limit, or until the user wants the end
/// (stop_request.hpp). `output(board, text)` gets what a board prints
/// as it is printed; `progress` (0..1) may be empty. Throws InputError if set-up and scenario do
/// not fit together.
[[nodiscard]] FirmwareReport run_firmware(
    const FirmwareSetup &setup,
    const std::function<void(std::size_t, std::string_view)> &output = {},
    const std::function<void(double)> &progress = {});

}  // namespace vericansim::firmware

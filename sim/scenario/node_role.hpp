// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeRole: the kinds of nodes of a scenario, by what works their registers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>

namespace vericansim {

class Operator;
struct OperatorContext;
namespace firmware {
struct ElfImage;
}

/// The simulation's own software, which sends the scenario's traffic and receives.
struct TrafficRole {};

/// Cortex-M3 firmware (docs/firmware.md).
struct FirmwareRole {
  std::string file;                                 ///< ELF file
  std::shared_ptr<const firmware::ElfImage> image;  ///< already read; unset: read from `file`
  unsigned clocks_per_instruction = 2;
  bool run_hard_fault_handler = false;  ///< false: a HardFault stops the CPU, as a debugger does
  /// Reaching the end of the run without having called the exit function is no failure.
  bool endless = true;
};

/// The second CAN core of a board, which has the firmware's name, on this bus or another.
struct SecondCoreRole {
  std::string board;  ///< name of the node with the firmware
};

/// A kind of the caller's own: makes what works the node's registers.
struct OwnRole {
  std::function<std::unique_ptr<Operator>(const OperatorContext &)> make;
};

using NodeRole = std::variant<TrafficRole, FirmwareRole, SecondCoreRole, OwnRole>;

/// True if the simulation's own software (Host) works a node of this kind.
[[nodiscard]] bool has_host(const NodeRole &role);

/// What works the nodes of this kind, for messages: "firmware".
[[nodiscard]] const char *name_of(const NodeRole &role);

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: a CPU with its firmware, and the one or two CAN cores behind its fabric interface.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/types.hpp"
#include "firmware/cortex_m3.hpp"
#include "firmware/elf_image.hpp"
#include "firmware/semihosting.hpp"
#include "node/rtl_node.hpp"

namespace vericansim::firmware {

/// The board. CPU and cores share one clock; whoever runs the simulation clocks the cores first and
/// then the CPU, which sees their interrupt lines and answers as of that edge. Its loads and stores
/// are on a core's AHB-Lite pins from the next cycle on.
class Board : private CpuBus {
 public:
  /// `cores`: one or two, which must outlive the board. The CPU is out of reset.
  Board(std::string name, ElfImage image, std::vector<RtlNode *> cores,
        const CortexConfig &config = {});

  /// One clock of the CPU.
  void clock();

  /// Gets what the firmware prints.
  void set_output(std::function<void(std::string_view)> output);

  /// True once the firmware has called the exit function or the CPU has halted after a fault.
  [[nodiscard]] bool ended() const { return exit_code().has_value() || cpu_.halted(); }
  [[nodiscard]] std::optional<int> exit_code() const { return semihosting_.exit_code(); }
  [[nodiscard]] const std::string &name() const { return name_; }
  [[nodiscard]] const ElfImage &image() const { return image_; }
  [[nodiscard]] CortexM3 &cpu() { return cpu_; }
  [[nodiscard]] const CortexM3 &cpu() const { return cpu_; }
  [[nodiscard]] const std::vector<RtlNode *> &cores() const { return cores_; }

  /// Where the CPU is and why, for a fault or an end by the clock: several lines, with PC, address,
  /// registers and status registers.
  [[nodiscard]] std::string report() const;

 private:
  void begin(const DeviceAccess &access, bool privileged) override;
  [[nodiscard]] std::optional<DeviceReply> poll() override;
  void serve_semihosting();
  void reset();
  [[nodiscard]] std::string headline() const;

  std::string name_;
  ElfImage image_;
  std::vector<RtlNode *> cores_;
  CortexM3 cpu_;
  Semihosting semihosting_;
  std::optional<std::string> complaint_;  // of semihosting
  RtlNode *accessed_ = nullptr;
  AhbMaster::Ticket ticket_ = 0;
};

}  // namespace vericansim::firmware

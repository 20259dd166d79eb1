// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CortexRig: the CPU model with programs/cpu.s in its flash and a bus of words as its device.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware/cortex_m3.hpp"

namespace tb {

/// A device that keeps bytes, answers after `wait` clocks, and remembers every access.
class FakeBus : public vericansim::firmware::CpuBus {
 public:
  void begin(const vericansim::firmware::DeviceAccess &access, bool privileged) override;
  [[nodiscard]] std::optional<vericansim::firmware::DeviceReply> poll() override;

  std::vector<vericansim::firmware::DeviceAccess> log;
  std::vector<bool> privileged_log;
  unsigned wait = 3;
  bool error = false;
  std::map<std::uint32_t, std::uint8_t> bytes;

 private:
  unsigned left_ = 0;
};

/// The CPU. The vector table has been copied to SRAM, so that tests can put other handlers in it.
class CortexRig {
 public:
  explicit CortexRig(const vericansim::firmware::CortexConfig &config = {});

  /// Address of a function of cpu.s.
  [[nodiscard]] std::uint32_t address(const std::string &function) const;
  /// The CPU goes on there.
  void go(const std::string &function);
  /// Another handler for an exception.
  void handler(unsigned exception, const std::string &function);
  void clock(unsigned clocks = 1);
  /// Clocks until `done()`; false after `limit`.
  template <typename Done>
  bool run_until(Done done, unsigned limit = 2000) {
    for (unsigned i = 0; i < limit && !done(); ++i) cpu.clock();
    return done();
  }
  /// Runs until R7 has that value, which is how the functions say that they are done.
  bool finish(std::uint32_t r7 = 1) {
    return run_until([&] { return cpu.engine().reg(7) == r7; });
  }
  /// What the handlers have logged.
  [[nodiscard]] std::vector<std::uint32_t> logged() const;
  [[nodiscard]] std::uint32_t word(std::uint32_t address) const;
  [[nodiscard]] std::uint32_t reg(unsigned number) const { return cpu.engine().reg(number); }
  /// Enables an interrupt at a priority byte.
  void enable(unsigned irq, std::uint8_t priority = 0);

  FakeBus bus;
  vericansim::firmware::ElfImage image;
  vericansim::firmware::CortexM3 cpu;
};

}  // namespace tb

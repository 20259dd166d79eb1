// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Engine: the Unicorn engine as a Cortex-M3 that executes one instruction at a time. Exceptions and
// system instructions are not its business (cortex_m3.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "firmware/fault.hpp"
#include "firmware/memory_map.hpp"

namespace vericansim::firmware {

/// A load or store of an instruction to a device.
struct DeviceAccess {
  std::uint32_t address = 0;
  unsigned size = 4;  ///< bytes: 1, 2, 4
  bool write = false;
  std::uint32_t data = 0;  ///< written; right-aligned
};

/// How a device answers.
struct DeviceReply {
  enum class State : std::uint8_t { kDone, kWait, kFault };
  State state = State::kDone;
  std::uint32_t data = 0;                     ///< read; right-aligned
  FaultKind fault = FaultKind::kDeviceError;  ///< with kFault
};

/// Where device accesses go.
class DeviceSpace {
 public:
  virtual ~DeviceSpace() = default;
  /// Access number `index` (0, 1, ...) of the instruction that is being executed. After kWait the
  /// instruction is executed again later, from its beginning; the same accesses come again then.
  virtual DeviceReply access(unsigned index, const DeviceAccess &access) = 0;
};

/// Registers R0-R12, SP, LR, PC and the flags N, Z, C, V, Q in bits 31:27.
struct Registers {
  std::array<std::uint32_t, 16> r{};
  std::uint32_t flags = 0;
};

inline constexpr unsigned kSp = 13, kLr = 14, kPc = 15;

/// Memory, registers and one step. An IT instruction and the block it controls are one step.
class Engine {
 public:
  enum class StepEnd : std::uint8_t {
    kDone,   ///< executed; the registers show it
    kWait,   ///< a device asked for patience; nothing has changed
    kFault,  ///< see fault(); nothing has changed, except that after kInvalidState the branch is
             ///< done
  };

  /// `windows` are mapped besides flash and SRAM, and lead to `devices`.
  Engine(DeviceSpace &devices, std::span<const Region> windows);
  ~Engine();
  Engine(const Engine &) = delete;
  Engine &operator=(const Engine &) = delete;

  [[nodiscard]] StepEnd step();
  [[nodiscard]] const Fault &fault() const;

  [[nodiscard]] std::uint32_t reg(unsigned number) const;
  void set_reg(unsigned number, std::uint32_t value);
  [[nodiscard]] Registers registers() const;
  void set_registers(const Registers &registers);

  /// Flash and SRAM, little-endian, 1, 2 or 4 bytes at any alignment; nothing outside.
  [[nodiscard]] std::optional<std::uint32_t> read(std::uint32_t address, unsigned size) const;
  /// False, and no effect, outside SRAM.
  bool write(std::uint32_t address, unsigned size, std::uint32_t value);
  /// Puts bytes into flash or SRAM, as a programmer does; std::out_of_range outside.
  void load(std::uint32_t address, std::span<const std::uint8_t> bytes);
  /// True if code can be fetched from there.
  [[nodiscard]] static bool executable(std::uint32_t address);

 private:
  struct Impl;  // keeps Unicorn's header out of this one
  std::unique_ptr<Impl> impl_;
};

}  // namespace vericansim::firmware

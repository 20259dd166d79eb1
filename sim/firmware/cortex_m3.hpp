// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CortexM3: the CPU with its NVIC, SysTick and system control block, clock by clock.
//
// Time: an instruction takes `clocks_per_instruction`, an access to a device waits for the device
// on top of that, exception entry takes 12 clocks, return 10, and a tail-chained entry 6 (the
// Cortex-M3's own figures for memory without wait states).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "firmware/elf_image.hpp"
#include "firmware/engine.hpp"
#include "firmware/nvic.hpp"
#include "firmware/system_control.hpp"

namespace vericansim::firmware {

/// Settings of the CPU model.
struct CortexConfig {
  unsigned clocks_per_instruction = 2;
  /// Stop at a HardFault, as a debugger with VC_HARDERR set does, instead of entering its handler.
  bool catch_hard_fault = true;
};

/// Devices beside the system control space.
class CpuBus {
 public:
  virtual ~CpuBus() = default;
  /// Begins an access; `privileged` as HPROT[1] shows it.
  virtual void begin(const DeviceAccess &access, bool privileged) = 0;
  /// The reply, once it is there.
  [[nodiscard]] virtual std::optional<DeviceReply> poll() = 0;
};

/// The CPU.
class CortexM3 : private DeviceSpace {
 public:
  static constexpr unsigned kEntryClocks = 12, kReturnClocks = 10, kTailChainClocks = 6;

  enum class State : std::uint8_t {
    kRunning,
    kSleeping,  ///< WFI or WFE
    kStopped,   ///< HardFault that is caught, see fault()
    kLockUp,    ///< fault at the priority of HardFault or above, see fault()
  };

  /// `windows`: addresses that lead to `bus`.
  CortexM3(CpuBus &bus, std::span<const Region> windows, const CortexConfig &config = {});

  /// Fills flash and SRAM; call reset() afterwards.
  void load(const ElfImage &image);
  /// Power-on reset: registers, exceptions; SP and PC from the words at 0. Memory stays.
  void reset();
  /// One clock.
  void clock();

  /// Halts the CPU between two instructions, for a reason of the caller's.
  void stop_for_debugger() { state_ = State::kStopped; }

  /// Serves BKPT 0xAB; the CPU goes on with the next instruction afterwards. None: a fault.
  std::function<void()> on_semihosting;
  /// Serves AIRCR.SYSRESETREQ, after the instruction.
  std::function<void()> on_reset_request;

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool halted() const {
    return state_ == State::kStopped || state_ == State::kLockUp;
  }
  /// The fault behind kStopped and kLockUp.
  [[nodiscard]] const std::optional<Fault> &fault() const { return fault_; }
  [[nodiscard]] std::uint64_t cycles() const { return cycles_; }
  [[nodiscard]] std::uint64_t instructions() const { return instructions_; }
  [[nodiscard]] Engine &engine() { return engine_; }
  [[nodiscard]] const Engine &engine() const { return engine_; }
  [[nodiscard]] Nvic &nvic() { return nvic_; }
  [[nodiscard]] const Nvic &nvic() const { return nvic_; }
  [[nodiscard]] SystemControl &system() { return system_; }
  [[nodiscard]] const SystemControl &system() const { return system_; }
  /// Number of the exception whose handler runs; 0 outside handlers.
  [[nodiscard]] unsigned ipsr() const { return ipsr_; }
  [[nodiscard]] std::uint32_t xpsr() const;
  /// Main and process stack pointer.
  [[nodiscard]] std::uint32_t msp() const { return process_stack() ? other_sp_ : engine_.reg(kSp); }
  [[nodiscard]] std::uint32_t psp() const { return process_stack() ? engine_.reg(kSp) : other_sp_; }
  [[nodiscard]] std::uint32_t control() const { return control_; }

 private:
  static constexpr std::uint32_t kXpsrThumb = 1U << 24;

  // cortex_m3.cpp
  DeviceReply access(unsigned index, const DeviceAccess &access) override;
  DeviceReply system_access(const DeviceAccess &access);
  void at_boundary();
  void execute();
  void spend(unsigned clocks) { busy_ = clocks - 1; }
  [[nodiscard]] bool handler_mode() const { return ipsr_ != 0; }
  [[nodiscard]] bool privileged() const { return handler_mode() || (control_ & 1) == 0; }
  [[nodiscard]] bool process_stack() const { return !handler_mode() && (control_ & 2) != 0; }

  // cortex_exceptions.cpp
  void take(unsigned exception, std::uint32_t return_address);
  void enter_handler(unsigned exception, std::uint32_t exc_return);
  [[nodiscard]] bool push_frame(std::uint32_t return_address);
  void go_on_at(std::uint32_t pc, bool thumb);
  void exception_return(std::uint32_t exc_return);
  void pop_frame(std::uint32_t exc_return);
  [[nodiscard]] bool return_is_valid(std::uint32_t exc_return) const;
  void raise(const Fault &fault, std::uint32_t return_address);
  [[nodiscard]] std::optional<unsigned> handler_of(const Fault &fault);
  void stop(const Fault &fault, State state);
  void swap_stacks();

  // cortex_instructions.cpp
  [[nodiscard]] bool system_instruction();
  [[nodiscard]] bool narrow_instruction(std::uint32_t code);
  [[nodiscard]] bool wide_instruction(std::uint32_t first, std::uint32_t second);
  void hint(unsigned number);
  void change_state(std::uint32_t code);
  void supervisor_call();
  void breakpoint(unsigned number);
  [[nodiscard]] bool system_in_it(std::uint32_t it) const;
  [[nodiscard]] std::uint32_t read_special(unsigned number) const;
  void write_special(unsigned number, std::uint32_t value);
  void write_control(std::uint32_t value);
  void finish_instruction(unsigned length);

  CpuBus &bus_;
  CortexConfig config_;
  Nvic nvic_;
  SystemControl system_{nvic_};
  Engine engine_;

  State state_ = State::kRunning;
  std::optional<Fault> fault_;
  unsigned ipsr_ = 0;
  std::uint32_t control_ = 0;      // bit 1 SPSEL, bit 0 nPRIV
  std::uint32_t other_sp_ = 0;     // the stack pointer that is not SP now
  std::optional<Fault> no_thumb_;  // EPSR.T is 0: what the next instruction does
  bool event_ = false;             // of SEV and WFE
  bool sleeping_for_event_ = false;

  std::uint64_t cycles_ = 0, instructions_ = 0;
  unsigned busy_ = 0;                 // clocks until the next thing happens
  std::vector<DeviceReply> replies_;  // of the instruction under way
  bool waiting_ = false;              // for the bus
};

}  // namespace vericansim::firmware

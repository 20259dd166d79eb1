// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SystemControl: the registers of the system control space at 0xE000E000 (ARMv7-M, B3.2 to B3.4).
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/fault.hpp"
#include "firmware/nvic.hpp"
#include "firmware/systick.hpp"

namespace vericansim::firmware {

/// SCB and SysTick registers, and the way to those of the NVIC. Addresses in the space that have no
/// register read 0 and ignore writes.
class SystemControl {
 public:
  static constexpr std::uint32_t kCpuid = 0x411F'C231;  ///< Cortex-M3 r1p1, as in the A2F500

  explicit SystemControl(Nvic &nvic) : nvic_{nvic} {}

  void reset();

  /// Aligned access of 1, 2 or 4 bytes. Nothing if the register does not take that size. `ipsr`:
  /// exception that runs now, which ICSR shows.
  [[nodiscard]] std::optional<std::uint32_t> read(std::uint32_t address, unsigned size,
                                                  unsigned ipsr);
  [[nodiscard]] bool write(std::uint32_t address, unsigned size, std::uint32_t value);

  /// One clock of SysTick.
  void clock() {
    if (systick_.clock()) nvic_.pend(kSysTick);
  }

  [[nodiscard]] std::uint32_t vector_table() const { return vtor_; }
  [[nodiscard]] bool sleep_on_exit() const { return (scr_ & 2) != 0; }
  [[nodiscard]] bool event_on_pending() const { return (scr_ & 16) != 0; }
  [[nodiscard]] bool stack_align() const { return (ccr_ & 0x200) != 0; }
  [[nodiscard]] bool any_return_to_thread() const { return (ccr_ & 1) != 0; }
  /// SHCSR has MemManage, BusFault or UsageFault enabled.
  [[nodiscard]] bool fault_enabled(unsigned exception) const;
  /// True once after AIRCR.SYSRESETREQ was written.
  [[nodiscard]] bool take_reset_request();

  /// Puts a fault into CFSR, BFAR.
  void record(const Fault &fault);
  /// HFSR.
  void record_hard(std::uint32_t bits) { hfsr_ |= bits; }
  [[nodiscard]] std::uint32_t cfsr() const { return cfsr_; }
  [[nodiscard]] std::uint32_t hfsr() const { return hfsr_; }
  [[nodiscard]] std::uint32_t bfar() const { return bfar_; }

  static constexpr std::uint32_t kHfsrVector = 1U << 1, kHfsrForced = 1U << 30,
                                 kHfsrDebug = 1U << 31;

 private:
  [[nodiscard]] std::uint32_t read_word(std::uint32_t address, unsigned ipsr);
  void write_word(std::uint32_t address, std::uint32_t value);
  [[nodiscard]] std::uint32_t icsr(unsigned ipsr) const;
  void write_icsr(std::uint32_t value);
  void write_aircr(std::uint32_t value);
  [[nodiscard]] std::uint32_t system_priorities(unsigned word) const;
  void set_system_priorities(unsigned word, std::uint32_t value);
  [[nodiscard]] std::uint32_t shcsr() const;

  Nvic &nvic_;
  SysTick systick_;
  std::uint32_t vtor_ = 0, scr_ = 0, ccr_ = 0, shcsr_enables_ = 0;
  std::uint32_t cfsr_ = 0, hfsr_ = 0, bfar_ = 0;
  bool reset_request_ = false;
};

}  // namespace vericansim::firmware

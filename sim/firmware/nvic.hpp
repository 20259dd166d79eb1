// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nvic: which exceptions are enabled, pending and active, and which one the CPU takes next
// (ARMv7-M, B1.5 and B3.4).
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "firmware/memory_map.hpp"

namespace vericansim::firmware {

/// Exception numbers; interrupt n is kIrq0 + n.
enum Exception : unsigned {
  kNoException = 0,
  kReset = 1,
  kNmi = 2,
  kHardFault = 3,
  kMemManage = 4,
  kBusFault = 5,
  kUsageFault = 6,
  kSvCall = 11,
  kDebugMonitor = 12,
  kPendSv = 14,
  kSysTick = 15,
  kIrq0 = 16,
};
inline constexpr unsigned kExceptions = kIrq0 + kIrqs;

/// "SysTick", "IRQ 31", "none" for 0.
[[nodiscard]] std::string exception_name(unsigned exception);

/// Priorities and states of all exceptions. A smaller number is more urgent; -1 and below cannot
/// be masked; kThreadPriority is that of code outside handlers.
class Nvic {
 public:
  static constexpr int kThreadPriority = 256;

  // ---- Masks and settings of the CPU

  bool primask = false;
  bool faultmask = false;
  std::uint8_t basepri = 0;
  unsigned prigroup = 0;  ///< AIRCR.PRIGROUP: bits 7 .. prigroup+1 preempt

  // ---- States

  void pend(unsigned exception) {
    new_pending_ = new_pending_ || !pending_.test(exception);
    pending_.set(exception);
  }
  void unpend(unsigned exception) { pending_.reset(exception); }
  void enable(unsigned exception, bool on) { enabled_.set(exception, on); }
  void set_priority(unsigned exception, std::uint8_t value);
  [[nodiscard]] std::uint8_t priority_byte(unsigned exception) const {
    return priority_[exception];
  }
  [[nodiscard]] bool pending(unsigned exception) const { return pending_.test(exception); }
  [[nodiscard]] bool active(unsigned exception) const { return active_.test(exception); }
  [[nodiscard]] bool enabled(unsigned exception) const;
  [[nodiscard]] std::size_t active_count() const { return active_.count(); }

  /// Level of an interrupt line, to be told once a clock. A line pends its interrupt when it rises,
  /// and while it is high and the interrupt is not active.
  void line(unsigned irq, bool high);

  // ---- Decisions

  /// Priority of what runs now, masks included (group priorities).
  [[nodiscard]] int execution_priority() const;
  /// The same without PRIMASK: what WFI compares with.
  [[nodiscard]] int wake_priority() const;
  /// Group priority of an exception.
  [[nodiscard]] int group_priority(unsigned exception) const;
  /// The most urgent pending and enabled exception, if any.
  [[nodiscard]] std::optional<unsigned> first_pending() const;
  /// The same, if neither BASEPRI nor FAULTMASK masks it: what ICSR shows.
  [[nodiscard]] std::optional<unsigned> unmasked() const;
  /// The exception that preempts what runs now, if any.
  [[nodiscard]] std::optional<unsigned> preempting() const;
  /// True if an exception, enabled or not, has become pending since the last call.
  [[nodiscard]] bool take_new_pending() { return std::exchange(new_pending_, false); }
  /// True if a WFI ends now.
  [[nodiscard]] bool wakes() const;

  /// The CPU enters or leaves a handler.
  void enter(unsigned exception);
  void leave(unsigned exception) { active_.reset(exception); }

  // ---- NVIC registers, words at 0xE000E100 to 0xE000E4FC

  [[nodiscard]] std::uint32_t read(std::uint32_t address) const;
  void write(std::uint32_t address, std::uint32_t value);

 private:
  using Flags = std::bitset<kExceptions>;

  [[nodiscard]] int active_priority() const;
  [[nodiscard]] int mask_priority() const;
  [[nodiscard]] std::uint32_t word_of(const Flags &flags, unsigned word) const;

  Flags enabled_, pending_, active_, lines_;
  bool new_pending_ = false;
  std::array<std::uint8_t, kExceptions> priority_{};
};

}  // namespace vericansim::firmware

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CortexM3: system instructions, which never get to the engine (ARMv7-M, B5 and A7.7).
#include <utility>

#include "firmware/cortex_m3.hpp"

namespace vericansim::firmware {
namespace {

enum Hint : unsigned { kNop = 0, kYield = 1, kWfe = 2, kWfi = 3, kSev = 4 };

enum Special : unsigned {
  kXpsrLast = 7,  // APSR, IAPSR, EAPSR, XPSR, -, IPSR, EPSR, IEPSR
  kMspNumber = 8,
  kPspNumber = 9,
  kPrimaskNumber = 16,
  kBasepriNumber = 17,
  kBasepriMaxNumber = 18,
  kFaultmaskNumber = 19,
  kControlNumber = 20,
};

constexpr std::uint32_t kApsrMask = 0xF800'0000;

constexpr bool is_wide(std::uint32_t first) { return first >= 0xE800; }
constexpr bool is_it(std::uint32_t code) { return (code & 0xFF00) == 0xBF00 && (code & 0xF) != 0; }
constexpr bool is_breakpoint(std::uint32_t code) { return (code & 0xFF00) == 0xBE00; }
constexpr bool is_svc(std::uint32_t code) { return (code & 0xFF00) == 0xDF00; }
constexpr bool is_hint(std::uint32_t code) { return (code & 0xFF0F) == 0xBF00; }
constexpr bool is_cps(std::uint32_t code) { return (code & 0xFFEC) == 0xB660; }
constexpr bool is_mrs(std::uint32_t first, std::uint32_t second) {
  return first == 0xF3EF && (second & 0xF000) == 0x8000;
}
constexpr bool is_msr(std::uint32_t first, std::uint32_t second) {
  return (first & 0xFFF0) == 0xF380 && (second & 0xF300) == 0x8000;
}
constexpr bool is_wide_hint(std::uint32_t first, std::uint32_t second) {
  return first == 0xF3AF && (second & 0xFF00) == 0x8000;
}

// The engine would execute these, as if the CPU had a floating-point unit.
constexpr bool is_coprocessor(std::uint32_t first) { return (first & 0xEC00) == 0xEC00; }

}  // namespace

/// True if the instruction at the PC is one of them, and has been executed.
bool CortexM3::system_instruction() {
  const std::uint32_t pc = engine_.reg(kPc);
  const auto first = Engine::executable(pc) ? engine_.read(pc, 2) : std::nullopt;
  if (!first) return false;
  if (!is_wide(*first)) return narrow_instruction(*first);
  const auto second = engine_.read(pc + 2, 2);
  return second && wide_instruction(*first, *second);
}

void CortexM3::finish_instruction(unsigned length) {
  engine_.set_reg(kPc, engine_.reg(kPc) + length);
  ++instructions_;
  spend(config_.clocks_per_instruction);
}

bool CortexM3::narrow_instruction(std::uint32_t code) {
  if (is_breakpoint(code)) {
    breakpoint(code & 0xFF);
  } else if (is_svc(code)) {
    supervisor_call();
  } else if (is_cps(code)) {
    change_state(code);
    finish_instruction(2);
  } else if (is_hint(code)) {
    finish_instruction(2);
    hint(code >> 4 & 0xF);
  } else if (is_it(code) && system_in_it(code)) {
    stop({FaultKind::kSystemInIt, engine_.reg(kPc)}, State::kStopped);
  } else {
    return false;
  }
  return true;
}

bool CortexM3::wide_instruction(std::uint32_t first, std::uint32_t second) {
  if (is_mrs(first, second)) {
    engine_.set_reg(second >> 8 & 0xF, read_special(second & 0xFF));
    finish_instruction(4);
  } else if (is_msr(first, second)) {
    write_special(second & 0xFF, engine_.reg(first & 0xF));
    finish_instruction(4);
  } else if (is_wide_hint(first, second)) {
    finish_instruction(4);
    hint(second & 0xFF);
  } else if (is_coprocessor(first)) {
    const std::uint32_t pc = engine_.reg(kPc);
    raise({FaultKind::kNoCoprocessor, pc}, pc);
  } else {
    return false;
  }
  return true;
}

// The engine runs an IT block in one go, so that no system instruction may be in it.
bool CortexM3::system_in_it(std::uint32_t it) const {
  unsigned length = 4;  // the lowest set bit of the mask tells how many instructions follow
  for (unsigned mask = it & 0xF; (mask & 1) == 0; mask >>= 1) --length;
  std::uint32_t at = engine_.reg(kPc) + 2;
  for (unsigned i = 0; i < length; ++i) {
    const auto first = engine_.read(at, 2), second = engine_.read(at + 2, 2);
    if (!first) return false;
    if (!is_wide(*first)) {
      if (is_breakpoint(*first) || is_svc(*first) || is_cps(*first) ||
          (is_hint(*first) && (*first & 0xF0) != 0))
        return true;
      at += 2;
      continue;
    }
    if (is_coprocessor(*first)) return true;
    if (second && (is_mrs(*first, *second) || is_msr(*first, *second))) return true;
    at += 4;
  }
  return false;
}

void CortexM3::hint(unsigned number) {
  if (number == kSev) event_ = true;
  if (number == kWfi || (number == kWfe && !std::exchange(event_, false))) {
    state_ = State::kSleeping;
    sleeping_for_event_ = number == kWfe;
  }
}

// CPSIE, CPSID; without effect for unprivileged code.
void CortexM3::change_state(std::uint32_t code) {
  if (!privileged()) return;
  const bool disable = (code & 0x10) != 0;
  if ((code & 2) != 0) nvic_.primask = disable;
  if ((code & 1) != 0 && (!disable || nvic_.execution_priority() > -1)) nvic_.faultmask = disable;
}

void CortexM3::supervisor_call() {
  const std::uint32_t pc = engine_.reg(kPc);
  if (nvic_.group_priority(kSvCall) >= nvic_.execution_priority())
    return raise({FaultKind::kSvc, pc}, pc);
  ++instructions_;
  take(kSvCall, pc + 2);
}

void CortexM3::breakpoint(unsigned number) {
  constexpr unsigned kSemihosting = 0xAB;
  const std::uint32_t pc = engine_.reg(kPc);
  if (number != kSemihosting || !on_semihosting) return raise({FaultKind::kBreakpoint, pc}, pc);
  finish_instruction(2);
  on_semihosting();
}

std::uint32_t CortexM3::read_special(unsigned number) const {
  if (number <= kXpsrLast) {
    // EPSR reads 0; bit 2 leaves the flags out, bit 0 takes IPSR in.
    const std::uint32_t flags = (number & 4) == 0 ? engine_.registers().flags & kApsrMask : 0;
    return flags | ((number & 1) != 0 ? ipsr_ : 0);
  }
  if (number == kControlNumber) return control_;
  if (!privileged()) return 0;
  switch (number) {
    case kMspNumber: return msp();
    case kPspNumber: return psp();
    case kPrimaskNumber: return nvic_.primask ? 1 : 0;
    case kBasepriNumber:
    case kBasepriMaxNumber: return nvic_.basepri;
    case kFaultmaskNumber: return nvic_.faultmask ? 1 : 0;
    default: return 0;
  }
}

void CortexM3::write_special(unsigned number, std::uint32_t value) {
  if (number <= kXpsrLast) {
    if ((number & 4) != 0) return;
    Registers registers = engine_.registers();
    registers.flags = value & kApsrMask;
    return engine_.set_registers(registers);
  }
  if (!privileged()) return;
  constexpr std::uint32_t kPriorityMask = 0xFF << (8 - kPriorityBits) & 0xFF;
  const auto priority = static_cast<std::uint8_t>(value & kPriorityMask);
  switch (number) {
    case kMspNumber:
    case kPspNumber:
      if ((number == kPspNumber) == process_stack())
        engine_.set_reg(kSp, value & ~3U);
      else
        other_sp_ = value & ~3U;
      break;
    case kPrimaskNumber: nvic_.primask = (value & 1) != 0; break;
    case kBasepriNumber: nvic_.basepri = priority; break;
    case kBasepriMaxNumber:
      if (priority != 0 && (nvic_.basepri == 0 || priority < nvic_.basepri))
        nvic_.basepri = priority;
      break;
    case kFaultmaskNumber:
      if (nvic_.execution_priority() > -1 || (value & 1) == 0) nvic_.faultmask = (value & 1) != 0;
      break;
    case kControlNumber: write_control(value); break;
    default: break;
  }
}

// SPSEL can be changed in Thread mode only.
void CortexM3::write_control(std::uint32_t value) {
  const bool process = process_stack();
  control_ = (value & 1) | (handler_mode() ? control_ & 2 : value & 2);
  if (process_stack() != process) swap_stacks();
}

}  // namespace vericansim::firmware

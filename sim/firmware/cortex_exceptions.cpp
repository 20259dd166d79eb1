// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CortexM3: exception entry and return, faults (ARMv7-M, B1.5.6 to B1.5.14).
#include <array>

#include "firmware/cortex_m3.hpp"

namespace vericansim::firmware {
namespace {

constexpr std::uint32_t kReturnHandler = 0xFFFF'FFF1, kReturnMain = 0xFFFF'FFF9,
                        kReturnProcess = 0xFFFF'FFFD;
constexpr unsigned kFrameWords = 8;
constexpr std::uint32_t kAligned = 1U << 9;  // of the stacked xPSR: SP was moved by 4

}  // namespace

void CortexM3::take(unsigned exception, std::uint32_t return_address) {
  const std::uint32_t exc_return = handler_mode()    ? kReturnHandler
                                   : process_stack() ? kReturnProcess
                                                     : kReturnMain;
  const auto frame = push_frame(return_address);
  if (!frame) {
    // The handler that would have to deal with it needs a stack as well.
    nvic_.pend(exception);
    return escalate({FaultKind::kStacking, return_address, engine_.reg(kSp) - 4 * kFrameWords},
                    return_address);
  }
  spend(kEntryClocks);
  enter_handler(exception, exc_return);
}

// R0-R3, R12, LR, return address, xPSR; the stack pointer after it, or nothing without memory.
std::optional<std::uint32_t> CortexM3::push_frame(std::uint32_t return_address) {
  const Registers now = engine_.registers();
  const bool align = system_.stack_align() && (now.r[kSp] & 4) != 0;
  const std::uint32_t sp = now.r[kSp] - 4 * kFrameWords - (align ? 4 : 0);
  const std::array<std::uint32_t, kFrameWords> frame{
      now.r[0],  now.r[1],   now.r[2],       now.r[3],
      now.r[12], now.r[kLr], return_address, xpsr() | (align ? kAligned : 0)};
  for (unsigned i = 0; i < kFrameWords; ++i)
    if (!engine_.write(sp + 4 * i, 4, frame[i])) return {};
  engine_.set_reg(kSp, sp);
  return sp;
}

void CortexM3::enter_handler(unsigned exception, std::uint32_t exc_return) {
  const std::uint32_t vector_address = system_.vector_table() + 4 * exception;
  const auto vector = engine_.read(vector_address, 4);
  if (!vector || (*vector & 1) == 0) {
    system_.record_hard(SystemControl::kHfsrVector);
    return stop({FaultKind::kVector, engine_.reg(kPc), vector_address},
                exception == kHardFault || exception == kNmi ? State::kLockUp : State::kStopped);
  }
  if (process_stack()) swap_stacks();
  nvic_.enter(exception);
  ipsr_ = exception;
  event_ = true;
  engine_.set_reg(kLr, exc_return);
  engine_.set_reg(kPc, *vector & ~1U);
}

void CortexM3::swap_stacks() {
  const std::uint32_t sp = engine_.reg(kSp);
  engine_.set_reg(kSp, other_sp_);
  other_sp_ = sp;
}

// ---- Return

bool CortexM3::return_is_valid(std::uint32_t exc_return) const {
  if (!nvic_.active(ipsr_)) return false;
  const bool last = nvic_.active_count() == 1;
  switch (exc_return) {
    case kReturnHandler: return !last;
    case kReturnMain:
    case kReturnProcess: return last || system_.any_return_to_thread();
    default: return false;
  }
}

void CortexM3::exception_return(std::uint32_t exc_return) {
  const Fault invalid{FaultKind::kInvalidReturn, exc_return, exc_return};
  if (!return_is_valid(exc_return)) {
    nvic_.leave(ipsr_);
    engine_.set_reg(kLr, 0xF000'0000 | exc_return);
    return raise(invalid, engine_.reg(kPc));
  }
  nvic_.leave(ipsr_);
  if (ipsr_ != kNmi) nvic_.faultmask = false;
  // Tail-chaining: the next handler takes over the frame that is on the stack.
  if (const auto next = nvic_.preempting()) {
    spend(kTailChainClocks);
    return enter_handler(*next, exc_return);
  }
  pop_frame(exc_return);
}

void CortexM3::pop_frame(std::uint32_t exc_return) {
  const bool process = exc_return == kReturnProcess;
  if (process) swap_stacks();
  const std::uint32_t sp = engine_.reg(kSp);
  std::array<std::uint32_t, kFrameWords> frame{};
  for (unsigned i = 0; i < kFrameWords; ++i) {
    const auto word = engine_.read(sp + 4 * i, 4);
    if (!word || !kSram.contains(sp + 4 * i, 4))
      return escalate({FaultKind::kUnstacking, engine_.reg(kPc), sp}, engine_.reg(kPc));
    frame[i] = *word;
  }
  Registers next = engine_.registers();
  for (unsigned i = 0; i < 4; ++i) next.r[i] = frame[i];
  next.r[12] = frame[4];
  next.r[kLr] = frame[5];
  next.r[kPc] = frame[6] & ~1U;
  next.flags = frame[7];
  next.r[kSp] = sp + 4 * kFrameWords + ((frame[7] & kAligned) != 0 ? 4 : 0);
  engine_.set_registers(next);
  ipsr_ = frame[7] & 0x1FF;
  if (exc_return != kReturnHandler) {
    ipsr_ = 0;
    control_ = (control_ & ~2U) | (process ? 2U : 0U);
  }
  event_ = true;
  spend(kReturnClocks);
  if (ipsr_ == 0 && system_.sleep_on_exit()) {
    state_ = State::kSleeping;
    sleeping_for_event_ = false;
  }
}

// ---- Faults

void CortexM3::raise(const Fault &fault, std::uint32_t return_address) {
  const unsigned exception = fault_exception(fault.kind);
  system_.record(fault);
  const bool taken = system_.fault_enabled(exception) &&
                     nvic_.group_priority(exception) < nvic_.execution_priority();
  if (!taken) return escalate(fault, return_address);
  fault_ = fault;
  take(exception, return_address);
}

void CortexM3::escalate(const Fault &fault, std::uint32_t return_address) {
  system_.record(fault);
  system_.record_hard(fault.kind == FaultKind::kBreakpoint ? SystemControl::kHfsrDebug
                                                           : SystemControl::kHfsrForced);
  if (nvic_.execution_priority() <= -1) return stop(fault, State::kLockUp);
  if (config_.catch_hard_fault) return stop(fault, State::kStopped);
  if (fault.kind == FaultKind::kStacking) return stop(fault, State::kLockUp);
  fault_ = fault;
  take(kHardFault, return_address);
}

void CortexM3::stop(const Fault &fault, State state) {
  fault_ = fault;
  state_ = state;
}

}  // namespace vericansim::firmware

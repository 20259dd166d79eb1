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
constexpr std::uint32_t kExceptionNumber = 0x1FF;  // of xPSR
constexpr std::uint32_t kAligned = 1U << 9;        // of the stacked xPSR: SP was moved by 4

std::uint32_t hard_fault_status(FaultKind kind) {
  switch (kind) {
    case FaultKind::kVector: return SystemControl::kHfsrVector;
    case FaultKind::kBreakpoint: return SystemControl::kHfsrDebug;
    default: return SystemControl::kHfsrForced;
  }
}

}  // namespace

void CortexM3::take(unsigned exception, std::uint32_t return_address) {
  const std::uint32_t exc_return = handler_mode()    ? kReturnHandler
                                   : process_stack() ? kReturnProcess
                                                     : kReturnMain;
  spend(kEntryClocks);
  if (push_frame(return_address)) return enter_handler(exception, exc_return);
  // The more urgent one of the two is served first; neither gets a frame.
  const auto derived = handler_of({FaultKind::kStacking, return_address, engine_.reg(kSp)});
  nvic_.pend(exception);
  if (!derived) return;
  nvic_.pend(*derived);
  enter_handler(*nvic_.first_pending(), exc_return);
}

// R0-R3, R12, LR, return address, xPSR. False without memory for it; the stack pointer has moved
// nevertheless.
bool CortexM3::push_frame(std::uint32_t return_address) {
  const Registers now = engine_.registers();
  const bool align = system_.stack_align() && (now.r[kSp] & 4) != 0;
  const std::uint32_t sp = now.r[kSp] - 4 * kFrameWords - (align ? 4 : 0);
  const std::array<std::uint32_t, kFrameWords> frame{
      now.r[0],  now.r[1],   now.r[2],       now.r[3],
      now.r[12], now.r[kLr], return_address, xpsr() | (align ? kAligned : 0)};
  bool whole = true;
  for (unsigned i = 0; i < kFrameWords; ++i) whole &= engine_.write(sp + 4 * i, 4, frame[i]);
  engine_.set_reg(kSp, sp);
  return whole;
}

void CortexM3::enter_handler(unsigned exception, std::uint32_t exc_return) {
  const std::uint32_t vector_address = system_.vector_table() + 4 * exception;
  const auto vector = engine_.read(vector_address, 4);
  if (!vector) {
    const Fault fault{FaultKind::kVector, engine_.reg(kPc), vector_address};
    const bool urgent = exception == kHardFault || exception == kNmi;
    const auto derived = handler_of(fault);
    if (urgent) return stop(fault, State::kLockUp);
    nvic_.pend(exception);
    if (derived) enter_handler(*derived, exc_return);
    return;
  }
  if (process_stack()) swap_stacks();
  nvic_.enter(exception);
  ipsr_ = exception;
  event_ = true;
  engine_.set_reg(kLr, exc_return);
  go_on_at(*vector & ~1U, (*vector & 1) != 0);
}

// Without Thumb state the next instruction is a fault.
void CortexM3::go_on_at(std::uint32_t pc, bool thumb) {
  engine_.set_reg(kPc, pc);
  no_thumb_.reset();
  if (!thumb) no_thumb_ = Fault{FaultKind::kNoThumb, pc, pc};
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
  const std::uint32_t sp = process ? other_sp_ : engine_.reg(kSp);
  std::array<std::uint32_t, kFrameWords> frame{};
  for (unsigned i = 0; i < kFrameWords; ++i) {
    const auto word = engine_.read(sp + 4 * i, 4);
    if (!word || !kSram.contains(sp + 4 * i, 4)) {
      spend(kTailChainClocks);
      const auto derived = handler_of({FaultKind::kUnstacking, engine_.reg(kPc), sp});
      if (derived) enter_handler(*derived, exc_return);
      return;
    }
    frame[i] = *word;
  }
  const std::uint32_t xpsr = frame[7];
  if ((exc_return == kReturnHandler) != ((xpsr & kExceptionNumber) != 0))
    return raise({FaultKind::kInvalidReturn, exc_return, exc_return}, engine_.reg(kPc));
  if (process) swap_stacks();
  Registers next = engine_.registers();
  for (unsigned i = 0; i < 4; ++i) next.r[i] = frame[i];
  next.r[12] = frame[4];
  next.r[kLr] = frame[5];
  next.flags = xpsr;
  next.r[kSp] = sp + 4 * kFrameWords + ((xpsr & kAligned) != 0 ? 4 : 0);
  engine_.set_registers(next);
  go_on_at(frame[6] & ~1U, (xpsr & kXpsrThumb) != 0);
  ipsr_ = xpsr & kExceptionNumber;
  if (ipsr_ == 0) control_ = (control_ & ~2U) | (process ? 2U : 0U);
  event_ = true;
  spend(kReturnClocks);
  if (ipsr_ == 0 && system_.sleep_on_exit()) {
    state_ = State::kSleeping;
    sleeping_for_event_ = false;
  }
}

// ---- Faults

void CortexM3::raise(const Fault &fault, std::uint32_t return_address) {
  if (const auto exception = handler_of(fault)) take(*exception, return_address);
}

// Nothing if the CPU has stopped.
std::optional<unsigned> CortexM3::handler_of(const Fault &fault) {
  const unsigned exception = fault_exception(fault.kind);
  const int running = nvic_.execution_priority();
  system_.record(fault);
  fault_ = fault;
  if (system_.fault_enabled(exception) && nvic_.group_priority(exception) < running)
    return exception;
  system_.record_hard(hard_fault_status(fault.kind));
  if (running > -1 && !config_.catch_hard_fault) return kHardFault;
  stop(fault, running > -1 ? State::kStopped : State::kLockUp);
  return {};
}

void CortexM3::stop(const Fault &fault, State state) {
  fault_ = fault;
  state_ = state;
}

}  // namespace vericansim::firmware

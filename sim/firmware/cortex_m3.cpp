// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CortexM3: the clock and the accesses; see cortex_m3.hpp.
#include "firmware/cortex_m3.hpp"

#include <utility>

namespace vericansim::firmware {
namespace {

std::vector<Region> with_system_space(std::span<const Region> windows) {
  std::vector<Region> all{windows.begin(), windows.end()};
  all.push_back(kSystem);
  return all;
}

}  // namespace

CortexM3::CortexM3(CpuBus &bus, std::span<const Region> windows, const CortexConfig &config)
    : bus_{bus}, config_{config}, engine_{*this, with_system_space(windows)} {}

void CortexM3::load(const ElfImage &image) {
  for (const ElfSegment &segment : image.segments) engine_.load(segment.address, segment.bytes);
}

void CortexM3::reset() {
  nvic_ = {};
  system_.reset();
  state_ = State::kRunning;
  fault_.reset();
  ipsr_ = control_ = other_sp_ = 0;
  no_thumb_.reset();
  event_ = sleeping_for_event_ = waiting_ = false;
  replies_.clear();
  busy_ = 0;
  Registers registers;
  registers.r[kSp] = *engine_.read(kFlash.base, 4) & ~3U;
  const std::uint32_t vector = *engine_.read(kFlash.base + 4, 4);
  registers.r[kLr] = 0xFFFF'FFFF;
  registers.r[kPc] = vector & ~1U;
  engine_.set_registers(registers);
  if ((vector & 1) == 0) stop({FaultKind::kNoThumb, vector, vector}, State::kLockUp);
}

std::uint32_t CortexM3::xpsr() const {
  return engine_.registers().flags | (no_thumb_ ? 0 : kXpsrThumb) | ipsr_;
}

void CortexM3::clock() {
  ++cycles_;
  if (halted()) return;
  system_.clock();
  if (nvic_.take_new_pending() && system_.event_on_pending()) event_ = true;
  if (busy_ > 0) {
    --busy_;
    return;
  }
  if (waiting_) {
    const auto reply = bus_.poll();
    if (!reply) return;
    replies_.push_back(*reply);
    waiting_ = false;
    return execute();
  }
  at_boundary();
}

// Between two instructions: wake up, take an exception, or go on.
void CortexM3::at_boundary() {
  if (state_ == State::kSleeping) {
    const bool awake =
        sleeping_for_event_ ? event_ || nvic_.preempting().has_value() : nvic_.wakes();
    if (!awake) return;
    if (sleeping_for_event_) event_ = false;
    state_ = State::kRunning;
  }
  if (const auto exception = nvic_.preempting()) return take(*exception, engine_.reg(kPc));
  const std::uint32_t pc = engine_.reg(kPc);
  if (no_thumb_) return raise(*no_thumb_, pc);
  if (handler_mode() && pc >= 0xFFFF'FFE0) return exception_return(pc | 1);
  execute();
}

void CortexM3::execute() {
  if (replies_.empty() && system_instruction()) return;
  switch (engine_.step()) {
    case Engine::StepEnd::kWait: waiting_ = true; return;
    case Engine::StepEnd::kFault: {
      replies_.clear();
      const Fault fault = engine_.fault();
      if (fault.kind != FaultKind::kInvalidState) return raise(fault, fault.pc);
      no_thumb_ = fault;
      return raise(fault, fault.address);
    }
    case Engine::StepEnd::kDone: break;
  }
  replies_.clear();
  ++instructions_;
  spend(config_.clocks_per_instruction);
  if (system_.take_reset_request() && on_reset_request) on_reset_request();
}

// An instruction that had to wait is executed again from its beginning: what it did at the devices
// is remembered, so that nothing happens twice.
DeviceReply CortexM3::access(unsigned index, const DeviceAccess &access) {
  if (index < replies_.size()) return replies_[index];
  if (kSystem.contains(access.address)) {
    replies_.push_back(system_access(access));
    return replies_.back();
  }
  bus_.begin(access, privileged());
  return {DeviceReply::State::kWait};
}

DeviceReply CortexM3::system_access(const DeviceAccess &access) {
  constexpr DeviceReply kWrongSize{DeviceReply::State::kFault, 0, FaultKind::kSystemSize};
  if (access.write) {
    if (!system_.write(access.address, access.size, access.data)) return kWrongSize;
    return {};
  }
  const auto value = system_.read(access.address, access.size, ipsr_);
  return value ? DeviceReply{DeviceReply::State::kDone, *value} : kWrongSize;
}

}  // namespace vericansim::firmware

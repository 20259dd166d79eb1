// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nvic: see nvic.hpp.
#include "firmware/nvic.hpp"

#include <algorithm>

namespace vericansim::firmware {
namespace {

constexpr std::uint32_t kSetEnable = 0xE000'E100, kClearEnable = 0xE000'E180,
                        kSetPending = 0xE000'E200, kClearPending = 0xE000'E280,
                        kActive = 0xE000'E300, kPriority = 0xE000'E400;
constexpr std::uint8_t kPriorityMask = 0xFF << (8 - kPriorityBits) & 0xFF;

/// Calls `use(exception)` for each interrupt whose bit is set in word `word` of a register bank.
template <typename Use>
void for_each_irq(unsigned word, std::uint32_t bits, Use use) {
  for (unsigned bit = 0; bit < 32; ++bit)
    if ((bits >> bit & 1) != 0 && word * 32 + bit < kIrqs) use(kIrq0 + word * 32 + bit);
}

/// Calls `use(exception)` for each that is set, from 0 up. The CPU asks in each of its clocks, when
/// few are set: libstdc++ finds them by the word.
template <std::size_t N, typename Use>
void for_each_set(const std::bitset<N> &flags, Use use) {
  for (std::size_t e = flags._Find_first(); e < N; e = flags._Find_next(e))
    use(static_cast<unsigned>(e));
}

/// Number of the word at `address` in the bank that begins at `base`, at most 32 words long.
constexpr unsigned word_in(std::uint32_t address, std::uint32_t base) {
  return (address - base) / 4;
}

}  // namespace

std::string exception_name(unsigned exception) {
  switch (exception) {
    case kNoException: return "none";
    case kReset: return "Reset";
    case kNmi: return "NMI";
    case kHardFault: return "HardFault";
    case kMemManage: return "MemManage";
    case kBusFault: return "BusFault";
    case kUsageFault: return "UsageFault";
    case kSvCall: return "SVCall";
    case kDebugMonitor: return "DebugMonitor";
    case kPendSv: return "PendSV";
    case kSysTick: return "SysTick";
    default: break;
  }
  return exception < kIrq0 ? "reserved exception " + std::to_string(exception)
                           : "IRQ " + std::to_string(exception - kIrq0);
}

void Nvic::set_priority(unsigned exception, std::uint8_t value) {
  priority_[exception] = value & kPriorityMask;
}

// The system exceptions have no enable bit here; those of the configurable faults are SHCSR's and
// are looked at where a fault is raised.
bool Nvic::enabled(unsigned exception) const {
  return exception < kIrq0 || enabled_.test(exception);
}

void Nvic::line(unsigned irq, bool high) {
  const unsigned exception = kIrq0 + irq;
  if (high && (!lines_.test(exception) || !active_.test(exception))) pend(exception);
  lines_.set(exception, high);
}

int Nvic::group_priority(unsigned exception) const {
  switch (exception) {
    case kReset: return -3;
    case kNmi: return -2;
    case kHardFault: return -1;
    default: break;
  }
  return priority_[exception] & (0xFF << (prigroup + 1));
}

int Nvic::active_priority() const {
  int most_urgent = kThreadPriority;
  for_each_set(active_,
               [&](unsigned e) { most_urgent = std::min(most_urgent, group_priority(e)); });
  return most_urgent;
}

int Nvic::mask_priority() const {
  int priority = kThreadPriority;
  if (basepri != 0) priority = basepri & (0xFF << (prigroup + 1));
  if (faultmask) priority = std::min(priority, -1);
  return priority;
}

int Nvic::wake_priority() const { return std::min(active_priority(), mask_priority()); }

int Nvic::execution_priority() const {
  return primask ? std::min(wake_priority(), 0) : wake_priority();
}

// Equal group priorities: the sub-priority decides, then the smaller number (B1.5.4).
std::optional<unsigned> Nvic::first_pending() const {
  constexpr Flags kSystemExceptions{(1U << kIrq0) - 1};  // as enabled() has it
  const Flags ready = pending_ & (enabled_ | kSystemExceptions);
  std::optional<unsigned> best;
  const auto rank = [this](unsigned e) {
    return e < kMemManage ? group_priority(e) : static_cast<int>(priority_[e]);
  };
  for_each_set(ready, [&](unsigned e) {
    if (!best || rank(e) < rank(*best)) best = e;
  });
  return best;
}

std::optional<unsigned> Nvic::preempting() const {
  const auto first = first_pending();
  if (first && group_priority(*first) < execution_priority()) return first;
  return {};
}

std::optional<unsigned> Nvic::unmasked() const {
  const auto first = first_pending();
  if (first && group_priority(*first) < mask_priority()) return first;
  return {};
}

bool Nvic::wakes() const {
  const auto first = first_pending();
  return first && group_priority(*first) < wake_priority();
}

void Nvic::enter(unsigned exception) {
  pending_.reset(exception);
  active_.set(exception);
}

std::uint32_t Nvic::word_of(const Flags &flags, unsigned word) const {
  std::uint32_t value = 0;
  for_each_irq(word, ~0U, [&](unsigned e) {
    if (flags.test(e)) value |= 1U << ((e - kIrq0) % 32);
  });
  return value;
}

std::uint32_t Nvic::read(std::uint32_t address) const {
  if (address >= kPriority) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned irq = address - kPriority + i;
      if (irq < kIrqs) value |= static_cast<std::uint32_t>(priority_[kIrq0 + irq]) << 8 * i;
    }
    return value;
  }
  if (address >= kActive) return word_of(active_, word_in(address, kActive));
  if (address >= kSetPending) return word_of(pending_, word_in(address & ~0x80U, kSetPending));
  return word_of(enabled_, word_in(address & ~0x80U, kSetEnable));
}

void Nvic::write(std::uint32_t address, std::uint32_t value) {
  if (address >= kPriority) {
    for (unsigned i = 0; i < 4; ++i)
      if (address - kPriority + i < kIrqs)
        set_priority(kIrq0 + address - kPriority + i, static_cast<std::uint8_t>(value >> 8 * i));
  } else if (address >= kActive) {
    return;  // read-only
  } else if (address >= kClearPending) {
    for_each_irq(word_in(address, kClearPending), value, [this](unsigned e) { unpend(e); });
  } else if (address >= kSetPending) {
    for_each_irq(word_in(address, kSetPending), value, [this](unsigned e) { pend(e); });
  } else if (address >= kClearEnable) {
    for_each_irq(word_in(address, kClearEnable), value, [this](unsigned e) { enable(e, false); });
  } else {
    for_each_irq(word_in(address, kSetEnable), value, [this](unsigned e) { enable(e, true); });
  }
}

}  // namespace vericansim::firmware

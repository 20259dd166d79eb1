// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SystemControl: see system_control.hpp.
#include "firmware/system_control.hpp"

#include <utility>

namespace vericansim::firmware {
namespace {

enum Register : std::uint32_t {
  kInterruptLines = 0xE000'E004,
  kSysTickBase = 0xE000'E010,
  kSysTickEnd = 0xE000'E020,
  kNvicBase = 0xE000'E100,
  kPriorities = 0xE000'E400,
  kNvicEnd = 0xE000'E500,
  kCpuidAddress = 0xE000'ED00,
  kIcsr = 0xE000'ED04,
  kVtor = 0xE000'ED08,
  kAircr = 0xE000'ED0C,
  kScr = 0xE000'ED10,
  kCcr = 0xE000'ED14,
  kShpr1 = 0xE000'ED18,
  kShprEnd = 0xE000'ED24,
  kShcsr = 0xE000'ED24,
  kCfsr = 0xE000'ED28,
  kHfsr = 0xE000'ED2C,
  kBfar = 0xE000'ED38,
  kStir = 0xE000'EF00,
};

constexpr std::uint32_t kVectKey = 0x05FA, kVectKeyRead = 0xFA05;
constexpr std::uint32_t kFaultEnables = 7U << 16;  // SHCSR: MemManage, BusFault, UsageFault
constexpr std::uint32_t kCcrMask = 0x31B, kScrMask = 0x16;

/// Arrays of bytes: priorities, and CFSR, which is three registers of 1, 1 and 2 bytes.
bool takes_any_size(std::uint32_t address) {
  return (address >= kPriorities && address < kNvicEnd) ||
         (address >= kShpr1 && address < kShprEnd) || (address & ~3U) == kCfsr;
}

constexpr std::uint32_t mask_of(unsigned size) { return size == 4 ? ~0U : (1U << 8 * size) - 1; }

}  // namespace

void SystemControl::reset() {
  systick_ = {};
  vtor_ = scr_ = ccr_ = shcsr_enables_ = cfsr_ = hfsr_ = bfar_ = 0;
  reset_request_ = false;
}

std::optional<std::uint32_t> SystemControl::read(std::uint32_t address, unsigned size,
                                                 unsigned ipsr) {
  if (size != 4 && !takes_any_size(address)) return {};
  return read_word(address & ~3U, ipsr) >> 8 * (address & 3) & mask_of(size);
}

bool SystemControl::write(std::uint32_t address, unsigned size, std::uint32_t value) {
  const std::uint32_t word = address & ~3U;
  if (size == 4) {
    write_word(word, value);
    return true;
  }
  if (!takes_any_size(address)) return false;
  const unsigned shift = 8 * (address & 3);
  // Bits of CFSR are cleared by ones; the other bytes of priorities keep what they have.
  const std::uint32_t others = word == kCfsr ? 0 : read_word(word, 0) & ~(mask_of(size) << shift);
  write_word(word, others | (value & mask_of(size)) << shift);
  return true;
}

std::uint32_t SystemControl::read_word(std::uint32_t address, unsigned ipsr) {
  if (address >= kNvicBase && address < kNvicEnd) return nvic_.read(address);
  if (address >= kSysTickBase && address < kSysTickEnd)
    return systick_.read(address - kSysTickBase);
  if (address >= kShpr1 && address < kShprEnd) return system_priorities((address - kShpr1) / 4);
  switch (address) {
    case kInterruptLines: return (kIrqs + 31) / 32 - 1;
    case kCpuidAddress: return kCpuid;
    case kIcsr: return icsr(ipsr);
    case kVtor: return vtor_;
    case kAircr: return kVectKeyRead << 16 | nvic_.prigroup << 8;
    case kScr: return scr_;
    case kCcr: return ccr_;
    case kShcsr: return shcsr();
    case kCfsr: return cfsr_;
    case kHfsr: return hfsr_;
    case kBfar: return bfar_;
    default: return 0;
  }
}

void SystemControl::write_word(std::uint32_t address, std::uint32_t value) {
  if (address >= kNvicBase && address < kNvicEnd) return nvic_.write(address, value);
  if (address >= kSysTickBase && address < kSysTickEnd)
    return systick_.write(address - kSysTickBase, value);
  if (address >= kShpr1 && address < kShprEnd)
    return set_system_priorities((address - kShpr1) / 4, value);
  switch (address) {
    case kIcsr: write_icsr(value); break;
    case kVtor: vtor_ = value & 0x3FFF'FF80; break;  // 128 bytes at least
    case kAircr: write_aircr(value); break;
    case kScr: scr_ = value & kScrMask; break;
    case kCcr: ccr_ = value & kCcrMask; break;
    case kShcsr: shcsr_enables_ = value & kFaultEnables; break;
    case kCfsr: cfsr_ &= ~value; break;
    case kHfsr: hfsr_ &= ~value; break;
    case kStir:
      if ((value & 0x1FF) < kIrqs) nvic_.pend(kIrq0 + (value & 0x1FF));
      break;
    default: break;
  }
}

std::uint32_t SystemControl::icsr(unsigned ipsr) const {
  std::uint32_t value = ipsr;
  const auto flag = [&](bool on, unsigned bit) { value |= static_cast<std::uint32_t>(on) << bit; };
  flag(nvic_.active_count() <= 1, 11);  // RETTOBASE
  value |= nvic_.unmasked().value_or(0) << 12;
  for (unsigned e = kIrq0; e < kExceptions; ++e)
    if (nvic_.pending(e)) flag(true, 22);  // ISRPENDING
  flag(nvic_.pending(kSysTick), 26);
  flag(nvic_.pending(kPendSv), 28);
  flag(nvic_.pending(kNmi), 31);
  return value;
}

void SystemControl::write_icsr(std::uint32_t value) {
  if ((value & 1U << 31) != 0) nvic_.pend(kNmi);
  if ((value & 1U << 28) != 0) nvic_.pend(kPendSv);
  if ((value & 1U << 27) != 0) nvic_.unpend(kPendSv);
  if ((value & 1U << 26) != 0) nvic_.pend(kSysTick);
  if ((value & 1U << 25) != 0) nvic_.unpend(kSysTick);
}

void SystemControl::write_aircr(std::uint32_t value) {
  if (value >> 16 != kVectKey) return;
  nvic_.prigroup = value >> 8 & 7;
  if ((value & 4) != 0) reset_request_ = true;
}

bool SystemControl::take_reset_request() { return std::exchange(reset_request_, false); }

// SHPR1-3: exceptions 4 to 15.
std::uint32_t SystemControl::system_priorities(unsigned word) const {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(nvic_.priority_byte(4 + 4 * word + i)) << 8 * i;
  return value;
}

void SystemControl::set_system_priorities(unsigned word, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i)
    nvic_.set_priority(4 + 4 * word + i, static_cast<std::uint8_t>(value >> 8 * i));
}

std::uint32_t SystemControl::shcsr() const {
  std::uint32_t value = shcsr_enables_;
  const auto flag = [&](bool on, unsigned bit) { value |= static_cast<std::uint32_t>(on) << bit; };
  flag(nvic_.active(kMemManage), 0);
  flag(nvic_.active(kBusFault), 1);
  flag(nvic_.active(kUsageFault), 3);
  flag(nvic_.active(kSvCall), 7);
  flag(nvic_.active(kPendSv), 10);
  flag(nvic_.active(kSysTick), 11);
  return value;
}

bool SystemControl::fault_enabled(unsigned exception) const {
  switch (exception) {
    case kMemManage: return (shcsr_enables_ & 1U << 16) != 0;
    case kBusFault: return (shcsr_enables_ & 1U << 17) != 0;
    case kUsageFault: return (shcsr_enables_ & 1U << 18) != 0;
    default: return false;
  }
}

void SystemControl::record(const Fault &fault) {
  constexpr std::uint32_t kBfarValid = 1U << 15;
  cfsr_ |= fault_status(fault.kind);
  if (!fault_has_address(fault.kind)) return;
  cfsr_ |= kBfarValid;
  bfar_ = fault.address;
}

}  // namespace vericansim::firmware

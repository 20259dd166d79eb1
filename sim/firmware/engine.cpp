// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Engine: see engine.hpp.
//
// Unicorn stops after one instruction by looking at the next one, so a bad target of a branch is
// reported while the branch is executed; that is found again, and then believed, in the next step.
#include "firmware/engine.hpp"

#include <unicorn/unicorn.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace vericansim::firmware {
namespace {

constexpr std::uint32_t kFlagsMask = 0xF800'0000, kThumb = 0x20;
constexpr std::uint64_t kNowhere = 0xFFFF'FFFE;  // never reached: "run until"

/// Exception numbers of QEMU's ARM target, as UC_HOOK_INTR gives them.
enum QemuException : std::uint32_t { kQemuNoCp = 17, kQemuInvState = 18 };

void check(uc_err error, const char *what) {
  if (error != UC_ERR_OK)
    throw std::runtime_error(std::string("Unicorn, ") + what + ": " + uc_strerror(error));
}

/// Memory for uc_mem_map_ptr, which wants whole pages.
struct Pages {
  explicit Pages(std::size_t length)
      : bytes{static_cast<std::uint8_t *>(std::aligned_alloc(4096, length))} {
    if (bytes == nullptr) throw std::bad_alloc();
    std::memset(bytes, 0, length);
  }
  ~Pages() { std::free(bytes); }
  Pages(const Pages &) = delete;
  Pages &operator=(const Pages &) = delete;
  std::uint8_t *bytes;
};

}  // namespace

struct Engine::Impl {
  struct Window {
    Impl *impl;
    Region region;
    std::unique_ptr<Pages> pages;  // a load finds the device's answer here
  };
  struct OldByte {
    std::uint8_t *place;
    std::uint8_t value;
  };

  Impl(DeviceSpace &space, std::span<const Region> windows);
  ~Impl() { uc_close(uc); }

  void map(const Region &region, Pages &pages, std::uint32_t access);
  void add_hook(int type, void *callback, void *user, std::uint64_t begin, std::uint64_t end);
  void device_access(Window &window, const DeviceAccess &access);
  void fail(FaultKind kind, std::uint32_t address, unsigned size, bool write);
  void classify_stop(bool error);
  void roll_back();
  [[nodiscard]] std::uint8_t *memory(std::uint32_t address, unsigned size, bool write);
  [[nodiscard]] Registers registers() const;
  void set_registers(const Registers &registers);
  [[nodiscard]] std::uint32_t pc() const;
  [[nodiscard]] bool thumb() const;

  static void on_device(uc_engine *, uc_mem_type, std::uint64_t, int, std::int64_t, void *);
  static void on_store(uc_engine *, uc_mem_type, std::uint64_t, int, std::int64_t, void *);
  static bool on_bad_access(uc_engine *, uc_mem_type, std::uint64_t, int, std::int64_t, void *);
  static void on_exception(uc_engine *, std::uint32_t, void *);

  uc_engine *uc = nullptr;
  DeviceSpace &devices;
  Pages flash{kFlash.size}, sram{kSram.size};
  std::vector<std::unique_ptr<Window>> windows;

  // The step under way.
  Registers before;
  std::vector<OldByte> undo;  // SRAM bytes that have been overwritten
  unsigned accesses = 0;
  bool waiting = false;
  std::optional<Fault> fault;
  std::uint32_t exception = 0;
};

Engine::Impl::Impl(DeviceSpace &space, std::span<const Region> wanted) : devices{space} {
  check(uc_open(UC_ARCH_ARM, static_cast<uc_mode>(UC_MODE_THUMB | UC_MODE_MCLASS), &uc), "open");
  check(uc_ctl_set_cpu_model(uc, UC_CPU_ARM_CORTEX_M3), "Cortex-M3");
  map(kFlash, flash, UC_PROT_READ | UC_PROT_EXEC);
  map(kFlashMirror, flash, UC_PROT_READ | UC_PROT_EXEC);
  map(kSram, sram, UC_PROT_ALL);
  for (const Region &region : wanted) {
    windows.push_back(
        std::make_unique<Window>(Window{this, region, std::make_unique<Pages>(region.size)}));
    Window &window = *windows.back();
    map(region, *window.pages, UC_PROT_READ | UC_PROT_WRITE);
    add_hook(UC_HOOK_MEM_READ | UC_HOOK_MEM_WRITE, reinterpret_cast<void *>(on_device), &window,
             region.base, region.base + (region.size - 1));
  }
  add_hook(UC_HOOK_MEM_WRITE, reinterpret_cast<void *>(on_store), this, kSram.base,
           kSram.base + (kSram.size - 1));
  add_hook(UC_HOOK_MEM_INVALID, reinterpret_cast<void *>(on_bad_access), this, 1, 0);
  add_hook(UC_HOOK_INTR, reinterpret_cast<void *>(on_exception), this, 1, 0);
}

void Engine::Impl::map(const Region &region, Pages &pages, std::uint32_t access) {
  check(uc_mem_map_ptr(uc, region.base, region.size, access, pages.bytes), region.name);
}

void Engine::Impl::add_hook(int type, void *callback, void *user, std::uint64_t begin,
                            std::uint64_t end) {
  uc_hook handle = 0;
  check(uc_hook_add(uc, &handle, type, callback, user, begin, end), "hook");
}

// ---- Called by Unicorn

void Engine::Impl::on_device(uc_engine *, uc_mem_type type, std::uint64_t address, int size,
                             std::int64_t value, void *user) {
  auto &window = *static_cast<Window *>(user);
  DeviceAccess access{static_cast<std::uint32_t>(address), static_cast<unsigned>(size),
                      type == UC_MEM_WRITE, static_cast<std::uint32_t>(value)};
  if (access.size < 4) access.data &= (1U << 8 * access.size) - 1;
  window.impl->device_access(window, access);
}

void Engine::Impl::on_store(uc_engine *, uc_mem_type, std::uint64_t address, int size, std::int64_t,
                            void *user) {
  auto &impl = *static_cast<Impl *>(user);
  for (int i = 0; i < size; ++i) {
    std::uint8_t *const place = impl.memory(static_cast<std::uint32_t>(address) + i, 1, true);
    if (place != nullptr) impl.undo.push_back({place, *place});
  }
}

bool Engine::Impl::on_bad_access(uc_engine *, uc_mem_type type, std::uint64_t address, int size,
                                 std::int64_t, void *user) {
  auto &impl = *static_cast<Impl *>(user);
  const auto where = static_cast<std::uint32_t>(address);
  const auto length = static_cast<unsigned>(size);
  if (type == UC_MEM_READ_UNMAPPED || type == UC_MEM_READ_PROT)
    impl.fail(FaultKind::kAccess, where, length, false);
  if (type == UC_MEM_WRITE_UNMAPPED) impl.fail(FaultKind::kAccess, where, length, true);
  if (type == UC_MEM_WRITE_PROT) impl.fail(FaultKind::kReadOnly, where, length, true);
  return false;
}

void Engine::Impl::on_exception(uc_engine *uc, std::uint32_t number, void *user) {
  static_cast<Impl *>(user)->exception = number;
  uc_emu_stop(uc);
}

// ---- Accesses

void Engine::Impl::device_access(Window &window, const DeviceAccess &access) {
  if (waiting || fault) return;  // the instruction runs on, but what it does will be undone
  if (access.address % access.size != 0)
    return fail(FaultKind::kUnaligned, access.address, access.size, access.write);
  const DeviceReply reply = devices.access(accesses++, access);
  if (reply.state == DeviceReply::State::kFault)
    return fail(reply.fault, access.address, access.size, access.write);
  if (reply.state == DeviceReply::State::kWait) {
    waiting = true;
    uc_emu_stop(uc);
  } else if (!access.write) {
    std::memcpy(window.pages->bytes + (access.address - window.region.base), &reply.data,
                access.size);
  }
}

void Engine::Impl::fail(FaultKind kind, std::uint32_t address, unsigned size, bool write) {
  if (!fault) fault = Fault{kind, before.r[kPc], address, size, write};
  uc_emu_stop(uc);
}

// An error with the PC still on the instruction is the instruction's; otherwise it is the next
// one's and comes again, except that the CPU forgets that it has left Thumb state.
void Engine::Impl::classify_stop(bool error) {
  const std::uint32_t at = pc();
  if (exception == kQemuInvState || !thumb()) {
    fault = Fault{FaultKind::kInvalidState, at, at, 0, false};
  } else if (at == before.r[kPc] && (error || exception != 0)) {
    const bool whole = memory(at, 4, false) != nullptr;
    fail(exception == kQemuNoCp ? FaultKind::kNoCoprocessor
         : whole                ? FaultKind::kUndefined
                                : FaultKind::kFetch,
         at, 4, false);
  }
}

void Engine::Impl::roll_back() {
  for (auto old = undo.rbegin(); old != undo.rend(); ++old) *old->place = old->value;
  set_registers(before);
}

std::uint8_t *Engine::Impl::memory(std::uint32_t address, unsigned size, bool write) {
  if (kSram.contains(address, size)) return sram.bytes + (address - kSram.base);
  if (write) return nullptr;
  if (kFlash.contains(address, size)) return flash.bytes + (address - kFlash.base);
  if (kFlashMirror.contains(address, size)) return flash.bytes + (address - kFlashMirror.base);
  return nullptr;
}

// ---- Registers

namespace {

const std::array<int, 17> kUnicornRegisters{
    UC_ARM_REG_R0,  UC_ARM_REG_R1,  UC_ARM_REG_R2,  UC_ARM_REG_R3,  UC_ARM_REG_R4,  UC_ARM_REG_R5,
    UC_ARM_REG_R6,  UC_ARM_REG_R7,  UC_ARM_REG_R8,  UC_ARM_REG_R9,  UC_ARM_REG_R10, UC_ARM_REG_R11,
    UC_ARM_REG_R12, UC_ARM_REG_R13, UC_ARM_REG_R14, UC_ARM_REG_R15, UC_ARM_REG_CPSR};

}  // namespace

Registers Engine::Impl::registers() const {
  Registers result;
  std::array<void *, 17> places{};
  for (unsigned i = 0; i < 16; ++i) places[i] = &result.r[i];
  places[16] = &result.flags;
  auto numbers = kUnicornRegisters;
  check(uc_reg_read_batch(uc, numbers.data(), places.data(), 17), "registers");
  result.flags &= kFlagsMask;
  return result;
}

void Engine::Impl::set_registers(const Registers &registers) {
  Registers copy = registers;
  std::uint32_t cpsr = 0;
  check(uc_reg_read(uc, UC_ARM_REG_CPSR, &cpsr), "flags");
  // Outside an IT block, in Thumb state.
  constexpr std::uint32_t kItBits = 0x0600'FC00;
  copy.flags = (cpsr & ~(kFlagsMask | kItBits)) | kThumb | (registers.flags & kFlagsMask);
  std::array<void *, 17> places{};
  for (unsigned i = 0; i < 16; ++i) places[i] = &copy.r[i];
  places[16] = &copy.flags;
  auto numbers = kUnicornRegisters;
  check(uc_reg_write_batch(uc, numbers.data(), places.data(), 17), "registers");
}

std::uint32_t Engine::Impl::pc() const {
  std::uint32_t value = 0;
  check(uc_reg_read(uc, UC_ARM_REG_PC, &value), "PC");
  return value;
}

bool Engine::Impl::thumb() const {
  std::uint32_t value = 0;
  check(uc_reg_read(uc, UC_ARM_REG_CPSR, &value), "flags");
  return (value & kThumb) != 0;
}

// ---- Engine

Engine::Engine(DeviceSpace &devices, std::span<const Region> windows)
    : impl_{std::make_unique<Impl>(devices, windows)} {}

Engine::~Engine() = default;

const Fault &Engine::fault() const { return *impl_->fault; }

Engine::StepEnd Engine::step() {
  Impl &m = *impl_;
  m.undo.clear();
  m.accesses = 0;
  m.waiting = false;
  m.fault.reset();
  m.exception = 0;
  m.before = m.registers();
  const std::uint32_t pc = m.before.r[kPc];
  if (!executable(pc)) {
    const bool there = std::any_of(m.windows.begin(), m.windows.end(),
                                   [&](const auto &w) { return w->region.contains(pc); });
    m.fault = Fault{there ? FaultKind::kNotExecutable : FaultKind::kFetch, pc, pc, 2, false};
    return StepEnd::kFault;
  }
  const uc_err error = uc_emu_start(m.uc, pc | 1, kNowhere, 0, 1);
  if (m.waiting && !m.fault) {
    m.roll_back();
    return StepEnd::kWait;
  }
  if (!m.fault) m.classify_stop(error != UC_ERR_OK);
  if (!m.fault) return StepEnd::kDone;
  if (m.fault->kind != FaultKind::kInvalidState) m.roll_back();
  return StepEnd::kFault;
}

std::uint32_t Engine::reg(unsigned number) const {
  std::uint32_t value = 0;
  check(uc_reg_read(impl_->uc, kUnicornRegisters[number], &value), "register");
  return value;
}

void Engine::set_reg(unsigned number, std::uint32_t value) {
  check(uc_reg_write(impl_->uc, kUnicornRegisters[number], &value), "register");
}

Registers Engine::registers() const { return impl_->registers(); }
void Engine::set_registers(const Registers &registers) { impl_->set_registers(registers); }

std::optional<std::uint32_t> Engine::read(std::uint32_t address, unsigned size) const {
  const std::uint8_t *const place = impl_->memory(address, size, false);
  if (place == nullptr) return {};
  std::uint32_t value = 0;
  std::memcpy(&value, place, size);
  return value;
}

bool Engine::write(std::uint32_t address, unsigned size, std::uint32_t value) {
  std::uint8_t *const place = impl_->memory(address, size, true);
  if (place == nullptr) return false;
  std::memcpy(place, &value, size);
  return true;
}

void Engine::load(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  const auto size = static_cast<unsigned>(bytes.size());
  std::uint8_t *const place = impl_->memory(address, size, false);
  if (place == nullptr) throw std::out_of_range("no memory at " + hex32(address));
  std::copy(bytes.begin(), bytes.end(), place);
}

bool Engine::executable(std::uint32_t address) {
  return kFlash.contains(address, 2) || kFlashMirror.contains(address, 2) ||
         kSram.contains(address, 2);
}

}  // namespace vericansim::firmware

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: see board.hpp.
#include "firmware/board.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>
#include <utility>

namespace vericansim::firmware {
namespace {

std::span<const Region> windows_of(const std::vector<RtlNode *> &cores) {
  if (cores.empty() || cores.size() > kCan.size())
    throw std::invalid_argument(fmt::format("a board has 1 to {} CAN cores", kCan.size()));
  return {kCan.data(), cores.size()};
}

AhbSize size_of(const DeviceAccess &access) {
  return access.size == 1 ? AhbSize::kByte : access.size == 2 ? AhbSize::kHalf : AhbSize::kWord;
}

}  // namespace

Board::Board(std::string name, ElfImage image, std::vector<RtlNode *> cores,
             const CortexConfig &config)
    : name_{std::move(name)},
      image_{std::move(image)},
      cores_{std::move(cores)},
      cpu_{*this, windows_of(cores_), config} {
  semihosting_.on_output = [](std::string_view) {};
  semihosting_.microseconds = [this] {
    const double clocks = static_cast<double>(cpu_.cycles());
    return static_cast<std::uint64_t>(clocks * 1e6 / cores_[0]->oscillator().nominal_hz());
  };
  cpu_.on_semihosting = [this] { serve_semihosting(); };
  cpu_.on_reset_request = [this] { reset(); };
  cpu_.load(image_);
  cpu_.reset();
}

void Board::set_output(std::function<void(std::string_view)> output) {
  semihosting_.on_output = std::move(output);
}

void Board::clock() {
  if (ended()) return;
  for (std::size_t i = 0; i < cores_.size(); ++i) cpu_.nvic().line(kCanIrq[i], cores_[i]->irq());
  cpu_.clock();
}

void Board::serve_semihosting() {
  complaint_ = semihosting_.serve(cpu_.engine());
  if (complaint_) cpu_.stop_for_debugger();
}

// SYSRESETREQ resets the fabric as well.
void Board::reset() {
  for (RtlNode *core : cores_) core->reset();
  cpu_.reset();
}

void Board::begin(const DeviceAccess &access, bool privileged) {
  for (std::size_t i = 0; i < cores_.size(); ++i) {
    if (!kCan[i].contains(access.address)) continue;
    constexpr std::uint8_t kData = 1, kPrivileged = 2;
    accessed_ = cores_[i];
    ticket_ = accessed_->ahb().submit(
        {.address = access.address - kCan[i].base,
         .write = access.write,
         .size = size_of(access),
         .data = access.data,
         .hprot = static_cast<std::uint8_t>(kData | (privileged ? kPrivileged : 0))});
  }
}

std::optional<DeviceReply> Board::poll() {
  if (!accessed_->ahb().done(ticket_)) return {};
  const AhbResult &result = accessed_->ahb().result(ticket_);
  if (result.error) return DeviceReply{DeviceReply::State::kFault, 0, FaultKind::kDeviceError};
  return DeviceReply{DeviceReply::State::kDone, result.data, FaultKind::kDeviceError};
}

// ---- Report

std::string Board::headline() const {
  const std::string who = fmt::format("{} ({})", name_, image_.file);
  if (complaint_) return fmt::format("{}: semihosting: {}", who, *complaint_);
  const auto exit = exit_code();
  if (exit) return fmt::format("{}: ended with exit code {}", who, *exit);
  switch (cpu_.state()) {
    case CortexM3::State::kStopped:
    case CortexM3::State::kLockUp: {
      const bool lock_up = cpu_.state() == CortexM3::State::kLockUp;
      const unsigned raised = fault_exception(cpu_.fault()->kind);
      const std::string name =
          raised == kHardFault ? "HardFault" : exception_name(raised) + " escalated to HardFault";
      return fmt::format("{}: {}: {}", who, lock_up ? "lock-up" : name,
                         fault_text(*cpu_.fault(), cores_.size()));
    }
    case CortexM3::State::kSleeping: return who + ": asleep (WFI or WFE)";
    default: return who + ": running";
  }
}

std::string Board::report() const {
  std::string text = headline() + "\n";
  auto out = std::back_inserter(text);
  const Registers regs = cpu_.engine().registers();
  const auto place = [&](std::uint32_t address) {
    const std::string name = image_.place(address & ~1U);
    return name.empty() ? "" : " (" + name + ")";
  };
  const std::uint32_t pc = cpu_.fault() && cpu_.halted() ? cpu_.fault()->pc : regs.r[kPc];
  fmt::format_to(out, "  pc   {}{}\n  lr   {}{}\n", hex32(pc), place(pc), hex32(regs.r[kLr]),
                 place(regs.r[kLr]));
  fmt::format_to(out, "  sp   {}  msp {}  psp {}\n", hex32(regs.r[kSp]), hex32(cpu_.msp()),
                 hex32(cpu_.psp()));
  for (unsigned i = 0; i <= 12; ++i)
    fmt::format_to(out, "  r{:<3} {}{}", i, hex32(regs.r[i]), i % 4 == 3 || i == 12 ? "\n" : "");
  const unsigned handler = cpu_.ipsr();
  fmt::format_to(out, "  xpsr {}  {}  control {}  primask {}  faultmask {}  basepri 0x{:02X}\n",
                 hex32(cpu_.xpsr()),
                 handler == 0 ? "thread mode" : "handler of " + exception_name(handler),
                 cpu_.control(), cpu_.nvic().primask ? 1 : 0, cpu_.nvic().faultmask ? 1 : 0,
                 cpu_.nvic().basepri);
  fmt::format_to(out, "  cfsr {}  hfsr {}  bfar {}  vtor {}\n", hex32(cpu_.system().cfsr()),
                 hex32(cpu_.system().hfsr()), hex32(cpu_.system().bfar()),
                 hex32(cpu_.system().vector_table()));
  fmt::format_to(out, "  {} clocks, {} instructions\n", cpu_.cycles(), cpu_.instructions());
  return text;
}

}  // namespace vericansim::firmware

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See cortex_rig.hpp.
#include "firmware/cortex_rig.hpp"

#include <stdexcept>

#include "firmware/tool_run.hpp"

namespace tb {

using namespace vericansim::firmware;

namespace {

constexpr std::uint32_t kLog = 0x2000'0000, kVectors = 0x2000'6000;
constexpr unsigned kVectorCount = kIrq0 + 33;

}  // namespace

void FakeBus::begin(const DeviceAccess &access, bool privileged) {
  log.push_back(access);
  privileged_log.push_back(privileged);
  left_ = wait;
}

std::optional<DeviceReply> FakeBus::poll() {
  if (left_ > 0) {
    --left_;
    return {};
  }
  if (error) return DeviceReply{DeviceReply::State::kFault, 0, FaultKind::kDeviceError};
  const DeviceAccess &access = log.back();
  std::uint32_t data = 0;
  for (unsigned i = 0; i < access.size; ++i) {
    std::uint8_t &byte = bytes[access.address + i];
    if (access.write) byte = static_cast<std::uint8_t>(access.data >> 8 * i);
    data |= static_cast<std::uint32_t>(byte) << 8 * i;
  }
  return DeviceReply{DeviceReply::State::kDone, data, FaultKind::kDeviceError};
}

CortexRig::CortexRig(const CortexConfig &config)
    : image{read_elf(test_elf("cpu"))}, cpu{bus, {kCan.data(), 1}, config} {
  cpu.load(image);
  cpu.reset();
  cpu.engine().write(kLog, 4, kLog + 4);
  for (unsigned i = 0; i < kVectorCount; ++i)
    cpu.engine().write(kVectors + 4 * i, 4, *cpu.engine().read(4 * i, 4));
  (void)cpu.system().write(0xE000'ED08, 4, kVectors);
}

std::uint32_t CortexRig::address(const std::string &function) const {
  for (const ElfSymbol &symbol : image.functions)
    if (symbol.name == function) return symbol.address;
  throw std::logic_error("no function " + function + " in cpu.s");
}

void CortexRig::go(const std::string &function) { cpu.engine().set_reg(kPc, address(function)); }

void CortexRig::handler(unsigned exception, const std::string &function) {
  cpu.engine().write(kVectors + 4 * exception, 4, address(function) | 1);
}

void CortexRig::clock(unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) cpu.clock();
}

std::vector<std::uint32_t> CortexRig::logged() const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t at = kLog + 4; at < word(kLog); at += 4) result.push_back(word(at));
  return result;
}

std::uint32_t CortexRig::word(std::uint32_t address) const {
  return cpu.engine().read(address, 4).value_or(0);
}

void CortexRig::enable(unsigned irq, std::uint8_t priority) {
  cpu.nvic().set_priority(kIrq0 + irq, priority);
  cpu.nvic().enable(kIrq0 + irq, true);
}

}  // namespace tb

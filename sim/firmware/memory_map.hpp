// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The part of the SmartFusion A2F500's memory map that firmware sees here, and its interrupts.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace vericansim::firmware {

/// A range of addresses, [base, base + size).
struct Region {
  const char *name;
  std::uint32_t base;
  std::uint32_t size;
  [[nodiscard]] constexpr bool contains(std::uint32_t address, std::uint32_t length = 1) const {
    return address >= base && address - base < size && length <= size - (address - base);
  }
};

inline constexpr Region kFlash{"flash", 0x0000'0000, 512 * 1024};
/// The same memory, where the flash's own bus port shows it.
inline constexpr Region kFlashMirror{"flash mirror", 0x6000'0000, 512 * 1024};
inline constexpr Region kSram{"SRAM", 0x2000'0000, 64 * 1024};
/// Windows of the controllers behind the fabric interface; the second one is optional.
inline constexpr std::array<Region, 2> kCan{
    {{"CAN core", 0x4005'0000, 8 * 1024}, {"second CAN core", 0x4005'2000, 8 * 1024}}};
/// System control space of the Cortex-M3: SysTick, NVIC, SCB.
inline constexpr Region kSystem{"system control space", 0xE000'E000, 4 * 1024};

/// Interrupt numbers of the NVIC: the fabric interrupt, and GPIO 0 for the second core.
inline constexpr std::array<unsigned, 2> kCanIrq{31, 32};
/// Interrupt lines of the A2F500's NVIC.
inline constexpr unsigned kIrqs = 151;
/// Bits of a priority that exist (the upper ones of the byte).
inline constexpr unsigned kPriorityBits = 5;

/// "0x12345678".
[[nodiscard]] std::string hex32(std::uint32_t value);
/// Every region on one line, for messages; `cores` of the CAN windows are there.
[[nodiscard]] std::string map_text(std::size_t cores);

}  // namespace vericansim::firmware

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ElfImage: a firmware file (ELF32, little-endian, ARM, executable), checked before anything of it
// is used.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vericansim::firmware {

/// Bytes for one place in flash or SRAM.
struct ElfSegment {
  std::uint32_t address = 0;  ///< load address (p_paddr)
  std::vector<std::uint8_t> bytes;
};

/// A function of the symbol table.
struct ElfSymbol {
  std::uint32_t address = 0;  ///< without the Thumb bit
  std::uint32_t size = 0;     ///< 0: unknown
  std::string name;
};

struct ElfImage {
  std::string file;
  std::uint32_t entry = 0;           ///< e_entry; the reset vector is what starts the CPU
  std::vector<ElfSegment> segments;  ///< in flash or SRAM, without overlap
  std::vector<ElfSymbol> functions;  ///< by address; empty if the file has been stripped

  /// "main+0x12", or nothing if no function holds the address.
  [[nodiscard]] std::string place(std::uint32_t address) const;
};

/// Reads and checks a file. Throws InputError: which header or segment, what it holds and what is
/// allowed.
[[nodiscard]] ElfImage read_elf(const std::string &path);
/// Reads `bytes` as if they were the file `path`.
[[nodiscard]] ElfImage parse_elf(const std::string &path, const std::vector<std::uint8_t> &bytes);

}  // namespace vericansim::firmware

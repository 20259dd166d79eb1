// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Target: ELF files.
#include <algorithm>
#include <vector>

#include "firmware/elf_image.hpp"
#include "firmware/memory_map.hpp"
#include "fuzz/target.hpp"
#include "trace/input_error.hpp"

namespace vericansim::fuzz {

void fuzz_elf(Bytes input) {
  using namespace firmware;
  try {
    const ElfImage image = parse_elf("input.elf", {input.begin(), input.end()});
    std::size_t total = 0;
    for (const ElfSegment &segment : image.segments) {
      const auto size = static_cast<std::uint32_t>(segment.bytes.size());
      require(kFlash.contains(segment.address, size) || kSram.contains(segment.address, size),
              "segments within the memory");
      total += size;
    }
    require(total <= kFlash.size + kSram.size, "no more bytes than the memory has");
    require(std::is_sorted(image.functions.begin(), image.functions.end(),
                           [](const auto &a, const auto &b) { return a.address < b.address; }),
            "functions by address");
    for (const std::uint32_t address : {0U, 8U, kFlash.size - 1, kSram.base, 0xFFFFFFFFU})
      static_cast<void>(image.place(address));
  } catch (const InputError &) {
  }
}

}  // namespace vericansim::fuzz

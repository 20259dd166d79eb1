// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The memory map in words.
#include "firmware/memory_map.hpp"

#include <fmt/format.h>

namespace vericansim::firmware {

std::string hex32(std::uint32_t value) { return fmt::format("0x{:08X}", value); }

std::string map_text(std::size_t cores) {
  std::string text;
  const auto add = [&](const Region &region) {
    text += fmt::format("{}{} 0x{:08X}-0x{:08X}", text.empty() ? "" : ", ", region.name,
                        region.base, region.base + (region.size - 1));
  };
  add(kFlash);
  add(kSram);
  for (std::size_t core = 0; core < cores; ++core) add(kCan[core]);
  add(kFlashMirror);
  add(kSystem);
  return text;
}

}  // namespace vericansim::firmware

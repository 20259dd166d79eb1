// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Frame: see frame.hpp.
#include "model/frame.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "bus/range.hpp"

namespace vericansim {

void refuse_id(const char *what, std::uint32_t id, bool extended) {
  throw std::invalid_argument(fmt::format("{} must be 0 to 0x{:X} ({} bits), got 0x{:X}", what,
                                          highest_id(extended), extended ? 29 : 11, id));
}

void Frame::validate() const {
  require_id("frame: identifier", id, extended);
  require_range("frame: DLC", dlc, 0, 15);
}

}  // namespace vericansim

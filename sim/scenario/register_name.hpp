// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Names of registers and words of buffers, as scenario files write them: MCR, IFLAG1, MB5.CS,
// RXIMR3, FILTER0.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vericansim {

/// The address that a name or a number (a multiple of 4 in the window) stands for.
[[nodiscard]] std::optional<std::uint32_t> register_address(std::string_view name);
/// The name of an address, or the address as a number. The filter table of the Rx FIFO is shown as
/// the buffers that it lies in.
[[nodiscard]] std::string register_name(std::uint32_t address);

}  // namespace vericansim

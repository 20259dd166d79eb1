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

/// Message buffers of the largest core.
inline constexpr unsigned kMostBuffers = 64;

/// The address that a name or a number (a multiple of 4 in the window) stands for. Only `buffers`
/// buffers and masks have names.
[[nodiscard]] std::optional<std::uint32_t> register_address(std::string_view name,
                                                            unsigned buffers = kMostBuffers);
/// The name of an address, or the address as a number. The filter table of the Rx FIFO is shown as
/// the buffers that it lies in; those behind `buffers` have no name.
[[nodiscard]] std::string register_name(std::uint32_t address, unsigned buffers = kMostBuffers);

}  // namespace vericansim

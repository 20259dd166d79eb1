// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// How long frames of CAN FD are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace vericansim {

/// Bytes of a CAN FD frame by its DLC.
inline constexpr std::array<std::size_t, 16> kFdLengths = {0, 1,  2,  3,  4,  5,  6,  7,
                                                           8, 12, 16, 20, 24, 32, 48, 64};

/// Whether some DLC stands for so many bytes.
[[nodiscard]] constexpr bool is_fd_length(std::size_t bytes) {
  return std::ranges::binary_search(kFdLengths, bytes);
}

}  // namespace vericansim

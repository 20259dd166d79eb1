// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What reader and writer of PCAN-View trace files share: start times and lengths of CAN FD.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vericansim::trc {

/// Bytes of a CAN FD frame by its DLC.
inline constexpr std::array<std::size_t, 16> kFdLengths = {0, 1,  2,  3,  4,  5,  6,  7,
                                                           8, 12, 16, 20, 24, 32, 48, 64};

/// $STARTTIME, days of local time since the end of 1899, in nanoseconds since the Unix epoch, to
/// the microsecond; 0 if it lies before 1970, nothing if it is no number of days.
[[nodiscard]] std::optional<std::int64_t> start_ns(std::string_view days);
/// The inverse of start_ns(); cuts to microseconds.
[[nodiscard]] std::string days_text(std::int64_t ns);

}  // namespace vericansim::trc

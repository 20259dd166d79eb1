// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What reader and writer of PCAN-View trace files share: start times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vericansim::trc {

/// $STARTTIME, days of local time since the end of 1899, in nanoseconds since the Unix epoch, to
/// the microsecond; 0 if it lies before 1970, nothing if it is no number of days or beyond 2262.
[[nodiscard]] std::optional<std::int64_t> start_ns(std::string_view days);
/// The inverse of start_ns(); cuts to microseconds.
[[nodiscard]] std::string days_text(std::int64_t ns);

}  // namespace vericansim::trc

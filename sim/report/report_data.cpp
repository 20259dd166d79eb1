// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportData: see report_data.hpp.
#include "report/report_data.hpp"

#include <algorithm>

namespace vericansim {

std::uint32_t ReportData::segment_at(double time_ns) const {
  const auto &starts = segments.start;
  const auto after = std::upper_bound(starts.begin(), starts.end(), time_ns);
  return after == starts.begin() ? kNoSegment
                                 : static_cast<std::uint32_t>(after - starts.begin() - 1);
}

}  // namespace vericansim

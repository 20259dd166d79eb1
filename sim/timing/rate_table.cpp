// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rate table: see rate_table.hpp.
#include "timing/rate_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "timing/bittime.hpp"

namespace vericansim {
namespace {

constexpr unsigned kRates[] = {1'000'000, 800'000, 500'000, 250'000,
                               125'000,   50'000,  20'000,  10'000};
constexpr unsigned kRowBits = 19, kTableBits = 15 * kRowBits;

}  // namespace

std::vector<RateRow> rate_table(double clock_hz) {
  std::vector<RateRow> rows;
  for (const unsigned bitrate : kRates) {
    const auto timings = find_bit_timings(bit_timing_request(clock_hz, bitrate));
    const auto fits = std::find_if(
        timings.begin(), timings.end(),
        [](const BitTimingResult &result) { return result.usable() && result.rate_fits(); });
    if (fits != timings.end()) rows.push_back({bitrate, fits->timing});
  }
  return rows;
}

std::string rate_parameters(const std::vector<RateRow> &rows) {
  std::string text = fmt::format(".RateRows({}),\n.RateTable({{\n", rows.size());
  const std::size_t unused = kTableBits - kRowBits * rows.size();
  if (unused != 0) text += fmt::format("  {}'d0,\n", unused);
  for (std::size_t i = rows.size(); i-- != 0;) {
    const BitTiming &t = rows[i].timing;
    text += fmt::format("  8'd{}, 2'd{}, 3'd{}, 3'd{}, 3'd{}{}  // {} kbit/s\n", t.prescaler - 1,
                        t.sjw - 1, t.ps1 - 1, t.ps2 - 1, t.prop - 1, i == 0 ? "" : ",",
                        rows[i].bitrate / 1000);
  }
  return text + "})\n";
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bit timing calculator: search over all prescalers and segments.
#include "timing/bittime.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <tuple>

#include "timing/timing_limits.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

// Limits of the registers (flexcan.md 1.2) and of a bit (BT-02).
constexpr unsigned kMaxPrescaler = 256;
constexpr unsigned kMinTseg1 = 4, kMaxTseg1 = 16, kMinTseg2 = 2, kMaxTseg2 = 8;
constexpr unsigned kMinQuanta = 8, kMaxQuanta = 25;
constexpr unsigned kMaxSegment = 8, kMaxSjw = 4;
constexpr double kDelayPerMetreNs = 5.0;

void check(const BitTimingRequest &r) {
  const auto require = [](bool ok, const std::string &message) {
    if (!ok) throw std::invalid_argument(message);
  };
  require(r.clock_hz >= 1'000 && r.clock_hz <= 1'000'000'000,
          fmt::format("clock {} Hz is out of range; allowed: 1000 to 1000000000", r.clock_hz));
  require(r.bitrate >= 1'000 && r.bitrate <= 1'000'000,
          fmt::format("bit rate {} is out of range; allowed: 1000 to 1000000 bit/s", r.bitrate));
  require(!r.sample_point || (*r.sample_point >= 0.5 && *r.sample_point <= 0.9),
          fmt::format("sample point {} is out of range; allowed: 0.5 to 0.9",
                      r.sample_point.value_or(0)));
  require(!r.sjw || (*r.sjw >= 1 && *r.sjw <= kMaxSjw),
          fmt::format("SJW {} is out of range; allowed: 1 to 4", r.sjw.value_or(0)));
  require(r.cable_m >= 0 && r.cable_m <= 10'000,
          fmt::format("cable {} m is out of range; allowed: 0 to 10000", r.cable_m));
  require(r.node_delay_ns >= 0 && r.node_delay_ns <= 100'000,
          fmt::format("node delay {} ns is out of range; allowed: 0 to 100000", r.node_delay_ns));
  const double controller = r.controller_delay_ns.value_or(0);
  require(controller >= 0 && controller <= 100'000,
          fmt::format("controller delay {} ns is out of range; allowed: 0 to 100000", controller));
  require(
      r.clock_error_ppm >= 0 && r.clock_error_ppm <= 50'000,
      fmt::format("clock error {} ppm is out of range; allowed: 0 to 50000", r.clock_error_ppm));
  require(r.max_rate_error_ppm >= 0 && r.max_rate_error_ppm <= 1'000'000,
          fmt::format("largest bit-rate error {} ppm is out of range; allowed: 0 to 1000000",
                      r.max_rate_error_ppm));
}

double controller_delay(const BitTimingRequest &r) {
  return r.controller_delay_ns.value_or(core_delay_ns(r.clock_hz));
}

BusDelays delays_of(const BitTimingRequest &r, double cable_m) {
  return {.one_way_ns = cable_m * kDelayPerMetreNs + r.node_delay_ns,
          .core_ns = controller_delay(r),
          .this_core = !r.controller_delay_ns};
}

/// The largest value from `low` to `high` with which `holds` is true; `low` if there is none.
template <typename Holds>
double largest(double low, double high, Holds holds) {
  constexpr int kHalvings = 48;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

bool holds(const BitTiming &timing, const BitTimingRequest &r, double error, double cable_m) {
  const double quantum_ns = 1e9 * timing.prescaler / r.clock_hz;
  return clocks_hold(timing, quantum_ns, delays_of(r, cable_m), error);
}

/// Largest error of the clocks with the cable asked for.
double largest_error(const BitTiming &timing, const BitTimingRequest &r) {
  return largest(0, textbook_limit(timing),
                 [&](double error) { return holds(timing, r, error, r.cable_m); });
}

/// Longest cable with clocks of this error, m, from the one asked for on.
double longest_cable(const BitTiming &timing, const BitTimingRequest &r, double error) {
  const double bit_m = timing.clocks_per_bit() * 1e9 / r.clock_hz / kDelayPerMetreNs;
  return largest(r.cable_m, r.cable_m + bit_m,
                 [&](double cable_m) { return holds(timing, r, error, cable_m); });
}

/// How TSEG1 is shared between PROP and PS1.
unsigned choose_prop(const BitTimingRequest &r, unsigned prescaler, unsigned tseg1) {
  const unsigned least = tseg1 > kMaxSegment ? tseg1 - kMaxSegment : 1;
  const unsigned most = std::min(kMaxSegment, tseg1 - 1);
  if (r.cable_m == 0) return std::clamp(tseg1 / 2, least, most);
  const double quantum_ns = 1e9 * prescaler / r.clock_hz;
  const BusDelays delays = delays_of(r, r.cable_m);
  const double returned = delays.this_core ? std::min(quantum_ns, delays.core_ns) : 0;
  const double loop = 2 * (delays.one_way_ns + delays.core_ns) - returned;
  const double needed = std::ceil(loop / quantum_ns - 1e-9);
  return static_cast<unsigned>(std::clamp<double>(needed, least, most));
}

/// Order of preference; smaller is better.
auto rank(const BitTimingResult &result, const BitTimingRequest &r) {
  const unsigned quanta = result.timing.quanta();
  const double wanted = r.sample_point.value_or(recommended_sample_point(r.bitrate));
  // Whole bit/s and whole per mille, cut, as can-utils and the kernel compare them.
  const auto rate = static_cast<long>(r.clock_hz / (result.timing.prescaler * quanta));
  const long rate_error = std::labs(rate - static_cast<long>(r.bitrate));
  const long point = 1000L * (quanta - result.timing.ps2) / quanta;
  const long distance = std::lround(wanted * 1000) - point;
  return std::make_tuple(rate_error, distance < 0, std::labs(distance), result.timing.prescaler);
}

void search_prescaler(const BitTimingRequest &r, unsigned quanta, unsigned prescaler,
                      std::vector<BitTimingResult> &found) {
  for (unsigned tseg2 = kMinTseg2; tseg2 <= kMaxTseg2; ++tseg2) {
    if (quanta < 1 + tseg2 + kMinTseg1 || quanta > 1 + tseg2 + kMaxTseg1) continue;
    const unsigned tseg1 = quanta - 1 - tseg2;
    const unsigned prop = choose_prop(r, prescaler, tseg1);
    BitTiming timing{prescaler, prop, tseg1 - prop, tseg2, 1};
    const unsigned widest = std::min({kMaxSjw, timing.ps1, timing.ps2});  // BT-03
    timing.sjw = std::min(r.sjw.value_or(kMaxSjw), widest);
    if (r.sjw && *r.sjw > widest) continue;
    const BitTimingResult result = rate_bit_timing(timing, r);
    if (std::abs(result.rate_error_ppm) <= r.max_rate_error_ppm) found.push_back(result);
  }
}

}  // namespace

BitTimingRequest bit_timing_request(double clock_hz, double bitrate) {
  const auto whole = [](const char *name, const char *unit, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw std::invalid_argument(fmt::format("{} {} {} is out of range; allowed: {:.0f} to {:.0f}",
                                              name, plain_number(value), unit, low, high));
    return static_cast<std::uint32_t>(std::llround(value));
  };
  BitTimingRequest request;
  request.clock_hz = whole("clock", "Hz", clock_hz, 1e3, 1e9);
  request.bitrate = whole("bit rate", "bit/s", bitrate, 1e3, 1e6);
  return request;
}

double recommended_sample_point(std::uint32_t bitrate) {
  if (bitrate > 800'000) return 0.75;
  return bitrate > 500'000 ? 0.80 : 0.875;
}

double oscillator_tolerance(const BitTiming &timing) {
  timing.validate();
  return textbook_limit(timing);
}

std::string rate_mismatch(const BitTiming &timing, double clock_hz, double bitrate) {
  const double rate = clock_hz / timing.clocks_per_bit();
  const double tolerance = oscillator_tolerance(timing);
  if (std::abs(rate / bitrate - 1) <= tolerance) return {};
  return fmt::format("gives {:.0f} bit/s from {:.0f} Hz; allowed: {:.0f} bit/s within {:.2f} %",
                     rate, clock_hz, bitrate, tolerance * 100);
}

bool BitTimingResult::rate_fits() const {
  return std::abs(rate_error_ppm) <= oscillator_tolerance * 1e6;
}

BitTimingResult rate_bit_timing(const BitTiming &timing, const BitTimingRequest &request) {
  timing.validate();
  BitTimingResult result;
  result.timing = timing;
  result.bitrate = static_cast<double>(request.clock_hz) / timing.clocks_per_bit();
  result.rate_error_ppm = (result.bitrate / request.bitrate - 1.0) * 1e6;
  result.sample_point = 1.0 - static_cast<double>(timing.ps2) / timing.quanta();
  result.controller_delay_ns = controller_delay(request);
  result.oscillator_tolerance = largest_error(timing, request);
  result.cable_m = longest_cable(timing, request, result.oscillator_tolerance);
  const double crystal = request.clock_error_ppm * 1e-6;
  if (crystal <= result.oscillator_tolerance)
    result.crystal_cable_m = longest_cable(timing, request, crystal);
  return result;
}

std::vector<BitTimingResult> find_bit_timings(const BitTimingRequest &request) {
  check(request);
  std::vector<BitTimingResult> found;
  for (unsigned quanta = kMaxQuanta; quanta >= kMinQuanta; --quanta) {
    // Only the two prescalers around the exact one can be best for this number of quanta.
    const auto below =
        static_cast<unsigned>(request.clock_hz / (std::uint64_t{quanta} * request.bitrate));
    for (const unsigned prescaler : {below, below + 1})
      if (prescaler >= 1 && prescaler <= kMaxPrescaler)
        search_prescaler(request, quanta, prescaler, found);
  }
  std::stable_sort(found.begin(), found.end(), [&](const auto &a, const auto &b) {
    return rank(a, request) < rank(b, request);
  });
  return found;
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ServoReference: fit, correction and history of the servo as the rules say them (TM-80 to TM-83),
// written anew with 128-bit integers and long doubles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vericansim {

__extension__ using Wide = __int128;

inline Wide floor_of(Wide value, Wide divisor) {
  const Wide quotient = value / divisor;
  return value % divisor != 0 && (value < 0) != (divisor < 0) ? quotient - 1 : quotient;
}

class ServoReference {
 public:
  struct Point {
    std::int64_t local, x;  ///< ns, 1/256 ns
  };
  struct Line {
    std::int64_t a, b;  ///< 1/256 ns, 2^-44
  };
  struct Correction {
    std::int64_t shift;
    std::uint64_t increment;
    std::int64_t exact;  ///< A of TM-82, 1/256 ns
  };

  /// TM-80.
  static std::int64_t input(std::uint64_t local, std::uint64_t master, std::int64_t delay,
                            unsigned latency, std::uint64_t increment) {
    const Wide behind = floor_of(Wide{128} * latency * Wide{increment}, Wide{1} << 32);
    return static_cast<std::int64_t>(256 * (Wide{local} - Wide{master} - delay) - behind);
  }

  /// TM-81, over the last n pairs (oldest first).
  [[nodiscard]] Line fit(std::size_t n) const {
    Wide st = 0, stt = 0, sx = 0, stx = 0;
    const std::int64_t newest = points.back().local;
    for (std::size_t i = points.size() - n; i < points.size(); ++i) {
      const Wide t = floor_of(Wide{points[i].local} - newest, 4096);
      st += t;
      stt += t * t;
      sx += points[i].x;
      stx += t * points[i].x;
    }
    const Wide count = static_cast<Wide>(n);
    Wide d = count * stt - st * st, b = 0;
    if (n > 1) {
      const Wide m = count * stx - st * sx, q = m / d;
      Wide r = m - q * d;
      for (; d >= Wide{1} << 38; d /= 2) r /= 2;
      b = (Wide{1} << 24) * q + (Wide{1} << 24) * r / d;
      const Wide limit = (Wide{1} << 34) - 1;  // 977 ppm
      b = b > limit ? limit : b < -limit ? -limit : b;
    }
    const Wide a = (sx - floor_of(b * st, Wide{1} << 24)) / count;
    return {static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)};
  }

  /// The same line in long doubles, with times that are not rounded to ticks: offset in ns, rate.
  struct ExactLine {
    long double a, b;
  };
  [[nodiscard]] ExactLine exact_fit(std::size_t n) const {
    long double st = 0, stt = 0, sx = 0, stx = 0;
    for (std::size_t i = points.size() - n; i < points.size(); ++i) {
      const long double t = static_cast<long double>(points[i].local - points.back().local);
      const long double x = static_cast<long double>(points[i].x) / 256;
      st += t;
      stt += t * t;
      sx += x;
      stx += t * x;
    }
    const long double count = static_cast<long double>(n);
    const long double b = (count * stx - st * sx) / (count * stt - st * st);
    return {(sx - b * st) / count, b};
  }

  /// TM-82 and TM-83; without the correction of the offset or of the rate.
  Correction correct(std::size_t n, std::int64_t now, std::uint64_t increment,
                     bool keep_offset = false, bool keep_rate = false) {
    const Line line = fit(n);
    const Wide ahead = floor_of(Wide{now} - points.back().local, 4096);
    const Wide due = line.a + floor_of(line.b * ahead, Wide{1} << 24);
    const Wide shift = keep_offset ? 0 : -floor_of(due + 128, 256);
    const Wide rate = keep_rate ? 0 : line.b;
    for (Point &point : points) {
      const Wide t = floor_of(Wide{point.local} - now, 4096);
      const Wide x = point.x + 256 * shift - floor_of(rate * t, Wide{1} << 24);
      point = {static_cast<std::int64_t>(point.local + shift), static_cast<std::int64_t>(x)};
    }
    const Wide less = floor_of(floor_of(Wide{increment}, 1 << 16) * rate, Wide{1} << 28);
    return {static_cast<std::int64_t>(shift), static_cast<std::uint64_t>(Wide{increment} - less),
            static_cast<std::int64_t>(due)};
  }

  std::vector<Point> points;
};

}  // namespace vericansim

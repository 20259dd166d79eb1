/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo's line of least squares, in integers (TM-81).
 */
#include "servo_internal.h"

/* 2^24 m / d without the bits that 2^24 m would not have: the whole part, then the rest. */
static int64_t rate_of(int64_t m, int64_t d) {
  const int64_t whole = m / d;
  int64_t rest = m - whole * d;
  while (d >= TWO_POW(38)) {
    d /= 2;
    rest /= 2;
  }
  const int64_t kept = verican_limit(whole, TWO_POW(10));
  return verican_limit(TWO_POW(24) * kept + TWO_POW(24) * rest / d, RATE_LIMIT);
}

verican_servo_line_t verican_servo_fit(const verican_servo_point_t *points, unsigned count) {
  const int32_t n = (int32_t)count;
  int32_t t = 0;
  int64_t tt = 0, x = 0, tx = 0;
  for (int32_t i = 0; i < n; ++i) {
    const int32_t ticks = verican_ticks(points[0].local, points[i].local);
    t += ticks;
    tt += (int64_t)ticks * ticks;
    x += points[i].offset;
    tx += ticks * points[i].offset;
  }
  const int64_t d = n * tt - (int64_t)t * t;
  verican_servo_line_t line = {0, 0};
  if (d > 0) line.rate = rate_of(n * tx - t * x, d);
  line.offset = (x - verican_drift(line.rate, t)) / n;
  return line;
}

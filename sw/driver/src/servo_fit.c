/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo's line of least squares, in integers (TM-81).
 */
#include "servo_internal.h"

int64_t verican_floor(int64_t value, unsigned power) {
  if (value >= 0) return (int64_t)((uint64_t)value >> power);
  return -1 - (int64_t)((uint64_t)(-1 - value) >> power);
}

void verican_sums_add(verican_sums_t *sums, int64_t ticks, int64_t offset) {
  ++sums->n;
  sums->t += ticks;
  sums->tt += ticks * ticks;
  sums->x += offset;
  sums->tx += ticks * offset;
}

/* 2^24 m / d without the bits that 2^24 m would not have: the whole part, then the rest. */
static int64_t rate_of(int64_t m, int64_t d) {
  const int64_t whole = m / d;
  if (verican_magnitude(whole) >= TWO_POW(10)) return whole < 0 ? -RATE_LIMIT : RATE_LIMIT;
  int64_t rest = m - whole * d;
  while (d >= TWO_POW(38)) {
    d /= 2;
    rest /= 2;
  }
  return verican_limit(TWO_POW(24) * whole + TWO_POW(24) * rest / d, RATE_LIMIT);
}

verican_servo_line_t verican_sums_line(const verican_sums_t *sums) {
  const int64_t d = sums->n * sums->tt - sums->t * sums->t;
  verican_servo_line_t line = {0, 0};
  if (d > 0) line.rate = rate_of(sums->n * sums->tx - sums->t * sums->x, d);
  line.offset = (sums->x - verican_drift(line.rate, sums->t)) / sums->n;
  return line;
}

verican_servo_line_t verican_servo_fit(const verican_servo_point_t *points, unsigned count) {
  verican_sums_t sums = {0, 0, 0, 0, 0};
  for (unsigned i = 0; i < count; ++i)
    verican_sums_add(&sums, verican_ticks(points[0].local, points[i].local), points[i].offset);
  return verican_sums_line(&sums);
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the parts of the servo share: its arithmetic in integers (TM-81). Offsets are in 1/256 ns,
 * times of the fit in ticks of 4,096 ns, rates in 2^-44.
 */
#ifndef VERICAN_SRC_SERVO_INTERNAL_H
#define VERICAN_SRC_SERVO_INTERNAL_H

#include "verican/servo.h"

#define TWO_POW(k) ((int64_t)1 << (k))

/* Nothing exceeds 63 bits: rates below 977 ppm, ages below 137 s, old offsets below 1 ms. */
#define RATE_LIMIT (TWO_POW(34) - 1)
#define TICKS_LIMIT (TWO_POW(25) - 1)
#define OLD_OFFSET_LIMIT TWO_POW(28)

/* servo_fit.c: value / 2^power, rounded down for negative values too. */
int64_t verican_floor(int64_t value, unsigned power);

static inline int64_t verican_magnitude(int64_t value) { return value < 0 ? -value : value; }
static inline int64_t verican_limit(int64_t value, int64_t limit) {
  if (value > limit) return limit;
  return value < -limit ? -limit : value;
}

/* What a mean over `limit` pairs divides the newest by, while there are `count` so far. */
static inline int64_t verican_weight(unsigned count, unsigned limit) {
  return (int64_t)(count < limit ? count : limit);
}

/* Ticks from `from` to `to`. */
static inline int64_t verican_ticks(int64_t from, int64_t to) {
  const int64_t distance = (int64_t)((uint64_t)to - (uint64_t)from);
  return verican_limit(verican_floor(distance, 12), TICKS_LIMIT);
}
/* What the rate makes of so many ticks. */
static inline int64_t verican_drift(int64_t rate, int64_t ticks) {
  return verican_floor(rate * ticks, 24);
}

/* Sums over points, the newest of which is at tick 0. */
typedef struct verican_sums {
  int64_t n, t, tt, x, tx;
} verican_sums_t;

/* servo_fit.c */
void verican_sums_add(verican_sums_t *sums, int64_t ticks, int64_t offset);
verican_servo_line_t verican_sums_line(const verican_sums_t *sums);

/* servo_filter.c */
/* Points that the filter in use looks at. */
unsigned verican_filter_points(const verican_servo_t *servo);
/* The filters before the first pair: all equal, off by a clock. */
void verican_filter_start(verican_servo_t *servo, uint64_t increment);
/* Learns from a pair, before it is in the history, which filter predicts best. */
void verican_filter_learn(verican_servo_t *servo, const verican_servo_point_t *point);

/* servo_correct.c */
/* Puts a point into the history. */
void verican_servo_push(verican_servo_t *servo, const verican_servo_point_t *point);
/* Corrects by the history; `correction` has the increment that holds and the shift so far. */
void verican_servo_correct(verican_servo_t *servo, int64_t now, verican_correction_t *correction);

#endif /* VERICAN_SRC_SERVO_INTERNAL_H */

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

/* value / 2^power, rounded down for negative values too; 2^63 moves all values to where a shift is
 * defined. */
static inline int64_t verican_floor(int64_t value, unsigned power) {
  const uint64_t half = (uint64_t)1 << 63;
  return (int64_t)((((uint64_t)value + half) >> power) - (half >> power));
}
static inline int64_t verican_magnitude(int64_t value) { return value < 0 ? -value : value; }

/* servo_ticks.c: apart from who calls them, so that they are in the code once */
/* The value, or -limit or limit if it is beyond. */
int64_t verican_limit(int64_t value, int64_t limit);
/* Ticks from `from` to `to`, ns. */
int32_t verican_ticks(int64_t from, int64_t to);
/* What the rate makes of so many ticks. */
int64_t verican_drift(int64_t rate, int32_t ticks);

/* servo_filter.c */
/* Points that a filter of that length looks at. */
unsigned verican_filter_points(const verican_servo_t *servo, unsigned length);
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

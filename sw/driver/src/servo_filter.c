/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The length of the servo's filter (TM-84): fixed, or the longest one that predicts about as
 * well as the best.
 */
#include "servo_internal.h"

unsigned verican_filter_points(const verican_servo_t *servo, unsigned length) {
  const unsigned wanted = length + 1u;
  return wanted < servo->count ? wanted : servo->count;
}

/* Pairs whose mean the error of a filter is, with the clock that it begins with. */
enum { MISS_PAIRS = 16 };

static uint8_t longest_good(const int32_t *misses) {
  int32_t best = misses[0];
  for (unsigned i = 1; i < VERICAN_SERVO_FILTERS; ++i)
    if (misses[i] < best) best = misses[i];
  unsigned chosen = VERICAN_SERVO_FILTERS - 1u;
  while (4 * (int64_t)misses[chosen] > 5 * (int64_t)best) --chosen;
  return (uint8_t)(1u << chosen);
}

/* Where the history is shorter than a filter, that one has what there is. */
void verican_filter_learn(verican_servo_t *servo, const verican_servo_point_t *point) {
  if (servo->config.filter != 0u || servo->count < 2u) return;
  const int32_t ahead = verican_ticks(servo->points[0].local, point->local);
  const int32_t pairs = servo->learned + 2;
  const int32_t weight = pairs < MISS_PAIRS ? pairs : MISS_PAIRS;
  for (unsigned i = 0; i < VERICAN_SERVO_FILTERS; ++i) {
    const unsigned points = verican_filter_points(servo, 1u << i);
    const verican_servo_line_t line = verican_servo_fit(servo->points, points);
    const int64_t off = line.offset + verican_drift(line.rate, ahead) - point->offset;
    const int32_t miss = (int32_t)verican_magnitude(verican_limit(off, INT32_MAX));
    servo->misses[i] += (miss - servo->misses[i]) / weight;
  }
  servo->filter = longest_good(servo->misses);
}

/* One clock counts as much as a pair: one that fits by chance must not decide. */
void verican_filter_start(verican_servo_t *servo, uint64_t increment) {
  servo->learned = 0;
  servo->errors = 0;
  for (unsigned i = 0; i < VERICAN_SERVO_FILTERS; ++i)
    servo->misses[i] = (int32_t)(increment / ((uint64_t)1 << 24));
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The length of the servo's filter (TM-84): fixed, or the longest one that predicts about as
 * well as the best.
 */
#include "servo_internal.h"

unsigned verican_filter_points(const verican_servo_t *servo) {
  const unsigned wanted = servo->filter + 1u;
  return wanted < servo->count ? wanted : servo->count;
}

/* Pairs whose mean the error of a filter is. */
enum { MISS_PAIRS = 16 };

/* How much the line is off at the point. */
static int64_t miss_of(const verican_servo_line_t *line, int64_t ticks, int64_t offset) {
  const int64_t predicted = line->offset + verican_drift(line->rate, ticks);
  return verican_limit(verican_magnitude(predicted - offset), INT32_MAX);
}

static uint8_t longest_good(const int32_t *misses) {
  int32_t best = misses[0];
  for (unsigned i = 1; i < VERICAN_SERVO_FILTERS; ++i)
    if (misses[i] < best) best = misses[i];
  unsigned chosen = VERICAN_SERVO_FILTERS - 1u;
  while (4 * (int64_t)misses[chosen] > 5 * (int64_t)best) --chosen;
  return (uint8_t)(1u << chosen);
}

/* The lines of all lengths come from one walk through the history. Where it is shorter than a
 * filter, that one has what there is. */
void verican_filter_learn(verican_servo_t *servo, const verican_servo_point_t *point) {
  if (servo->config.filter != 0u || servo->count < 2u) return;
  const verican_servo_point_t *points = servo->points;
  const int64_t ahead = verican_ticks(points[0].local, point->local);
  const int64_t weight = verican_weight(servo->learned + 2u, MISS_PAIRS);
  verican_sums_t sums = {0, 0, 0, 0, 0};
  verican_servo_line_t line = {0, 0};
  unsigned n = 0;
  for (unsigned i = 0; i < VERICAN_SERVO_FILTERS; ++i) {
    const unsigned before = n;
    for (; n <= (1u << i) && n < servo->count; ++n)
      verican_sums_add(&sums, verican_ticks(points[0].local, points[n].local), points[n].offset);
    if (n > before) line = verican_sums_line(&sums);
    const int64_t miss = miss_of(&line, ahead, point->offset);
    servo->misses[i] += (int32_t)((miss - servo->misses[i]) / weight);
  }
  servo->filter = longest_good(servo->misses);
}

/* One clock counts as much as a pair: one that fits by chance must not decide. */
void verican_filter_start(verican_servo_t *servo, uint64_t increment) {
  servo->learned = 0;
  for (unsigned i = 0; i < VERICAN_SERVO_FILTERS; ++i)
    servo->misses[i] = (int32_t)(increment / ((uint64_t)1 << 24));
}

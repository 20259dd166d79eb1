/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo's correction, and its history, which is then as if the new setting had always held
 * (TM-82, TM-83).
 */
#include "servo_internal.h"

/* Offsets up to it are worked off in LOCKED, so that time stays monotonic there. */
#define SLEW_LIMIT (256 * (int64_t)1000)
#define INCREMENT_LIMIT (TWO_POW(40) - 1)

void verican_servo_push(verican_servo_t *servo, const verican_servo_point_t *point) {
  const uint8_t room = servo->config.filter == 0u ? (uint8_t)VERICAN_SERVO_PAIRS
                                                  : (uint8_t)(servo->config.filter + 1u);
  if (servo->count < room) ++servo->count;
  for (unsigned i = servo->count - 1u; i > 0u; --i) servo->points[i] = servo->points[i - 1u];
  servo->points[0] = *point;
}

/* A point that is too old or too far away by now ends the history: it would not help the fit. */
static void re_reference(verican_servo_t *servo, int64_t now, int64_t shift, int64_t rate) {
  const int64_t newest = servo->points[0].local;
  for (unsigned i = 0; i < servo->count; ++i) {
    verican_servo_point_t *point = &servo->points[i];
    const bool old = verican_ticks(newest, point->local) <= -TICKS_LIMIT;
    point->offset += 256 * shift - verican_drift(rate, verican_ticks(now, point->local));
    point->local = (int64_t)((uint64_t)point->local + (uint64_t)shift);
    if (old || verican_magnitude(point->offset) >= OLD_OFFSET_LIMIT)
      servo->count = (uint8_t)(i > 0u ? i : 1u);
  }
}

static uint64_t slower(uint64_t increment, int64_t rate) {
  const int64_t less = verican_floor((int64_t)(increment / 65536u) * rate, 28);
  const int64_t wanted = (int64_t)increment - less;
  return (uint64_t)(wanted < INCREMENT_LIMIT ? wanted : INCREMENT_LIMIT);
}

void verican_servo_correct(verican_servo_t *servo, int64_t now, verican_correction_t *correction) {
  const unsigned points = verican_filter_points(servo, servo->filter);
  const verican_servo_line_t line = verican_servo_fit(servo->points, points);
  const int64_t due =
      line.offset + verican_drift(line.rate, verican_ticks(servo->points[0].local, now));
  const int64_t shift = servo->config.keep_offset ? 0 : -verican_floor(due + 128, 8);
  const int64_t rate = servo->config.keep_rate ? 0 : line.rate;
  re_reference(servo, now, shift, rate);
  correction->shift = (int64_t)((uint64_t)correction->shift + (uint64_t)shift);
  correction->increment = slower(correction->increment, rate);
  correction->slew =
      servo->state == (uint8_t)VERICAN_SYNC_LOCKED && verican_magnitude(due) <= SLEW_LIMIT;
}

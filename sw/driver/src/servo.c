/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo: which pairs count, and its states (TM-80, TM-85 to TM-87).
 */
#include "servo_internal.h"

/* Pairs until LOCKED; pairs that a filter is judged by until it counts as chosen; leaps that agree
 * until the clock follows them. */
enum { PAIRS_TO_LOCK = 4, PAIRS_TO_CHOOSE = 10, LEAPS_TO_STEP = 3 };
/* Pairs whose mean the mean error is. */
enum { ERROR_PAIRS = 8 };
/* An offset beyond 18 minutes is as good as 18 minutes: it fits 1/256 ns. */
#define OFFSET_LIMIT TWO_POW(40)

verican_result_t verican_servo_config_default(verican_servo_config_t *config) {
  if (config == NULL) return VERICAN_ERR_NULL;
  *config = (verican_servo_config_t){0};
  config->interval_us = 1000000;
  config->leap_ns = 100000;
  config->drift_ppb = 100;
  config->hold_after = 3;
  return VERICAN_OK;
}

static bool valid(const verican_servo_config_t *config) {
  const uint8_t n = config->filter;
  return config->interval_us >= 50000u && config->interval_us <= 5000000u &&
         config->leap_ns <= 10000000u && config->drift_ppb <= 1000000u && n <= 16u &&
         (n & (n - 1u)) == 0u && config->hold_after > 0u;
}

verican_result_t verican_servo_init(verican_servo_t *servo, const verican_servo_config_t *config) {
  if (servo == NULL || config == NULL) return VERICAN_ERR_NULL;
  if (!valid(config)) return VERICAN_ERR_RANGE;
  *servo = (verican_servo_t){0};
  servo->config = *config;
  servo->filter = config->filter != 0u ? config->filter : 16u;
  return VERICAN_OK;
}

static bool is_in(const verican_servo_t *servo, verican_sync_state_t state) {
  return servo->state == (uint8_t)state;
}

/* Modulo 2^64, as the clock counts. */
static int64_t add(int64_t a, int64_t b) { return (int64_t)((uint64_t)a + (uint64_t)b); }
static int64_t sub(int64_t a, int64_t b) { return (int64_t)((uint64_t)a - (uint64_t)b); }

/* The own time less the master's, whole ns. */
static int64_t offset_of(const verican_servo_t *servo, const verican_sync_pair_t *pair) {
  const int64_t distance = (int64_t)(pair->local - pair->master);
  return sub(distance, add(servo->config.delay_ns, servo->base));
}

static int64_t latency_of(const verican_sync_pair_t *pair) {
  return (int64_t)(pair->latency * pair->increment / ((uint64_t)1 << 25));
}

/* Largest error of a good pair. */
static int64_t gate_of(const verican_servo_t *servo, const verican_sync_pair_t *pair) {
  return 6 * servo->error + 2 * (int64_t)(pair->increment / ((uint64_t)1 << 24));
}

static bool has_leapt(const verican_servo_t *servo, int64_t offset) {
  uint32_t limit = servo->config.leap_ns;
  if (!is_in(servo, VERICAN_SYNC_LOCKED)) limit += servo->config.interval_us;
  return verican_magnitude(offset) > 256 * (int64_t)limit;
}

/* Whether enough leaps in a row agree: then the master means it. */
static bool is_confirmed(verican_servo_t *servo, int64_t offset, int64_t gate) {
  const int64_t away = verican_limit(sub(offset, servo->leap), OFFSET_LIMIT);
  const bool agrees = servo->leaps > 0u && 256 * verican_magnitude(away) <= gate;
  servo->leaps = agrees ? (uint8_t)(servo->leaps + 1u) : 1u;
  servo->leap = offset;
  return servo->leaps >= (uint8_t)LEAPS_TO_STEP;
}

static bool has_history(const verican_servo_t *servo) {
  return is_in(servo, VERICAN_SYNC_LOCKED) || servo->pairs >= (uint8_t)PAIRS_TO_LOCK;
}

/* True: the pair is dropped. The mean error learns from it nevertheless, within the gate. */
static bool is_outlier(verican_servo_t *servo, int64_t offset, int64_t gate) {
  const int64_t size = verican_magnitude(offset);
  const bool far = has_history(servo) && size > gate && !servo->dropped;
  if (servo->count >= 2u) {
    if (servo->errors < (uint8_t)ERROR_PAIRS) ++servo->errors;
    servo->error += ((size < gate ? size : gate) - servo->error) / servo->errors;
  }
  servo->dropped = far;
  return far;
}

/* Whole ns go at once: the rest is a first pair like others, and fits 1/256 ns. */
static void step(verican_servo_t *servo, int64_t offset, verican_correction_t *correction) {
  (void)verican_servo_forget(servo);
  servo->state = (uint8_t)VERICAN_SYNC_ACQUIRING;
  correction->events |= VERICAN_SERVO_STEP;
  if (servo->config.keep_offset) {
    servo->base = add(servo->base, offset);
  } else {
    correction->shift = sub(0, offset);
  }
}

static void accept(verican_servo_t *servo, const verican_sync_pair_t *pair, int64_t offset,
                   verican_correction_t *correction) {
  const int64_t shifted = correction->shift;
  const verican_servo_point_t point = {add((int64_t)pair->local, shifted), offset};
  verican_filter_learn(servo, &point);
  if (servo->count >= 2u && servo->learned < UINT8_MAX) ++servo->learned;
  verican_servo_push(servo, &point);
  verican_servo_correct(servo, add((int64_t)pair->now, shifted), correction);
  servo->last = servo->points[0].local;
  correction->events |= VERICAN_SERVO_ACCEPTED;
  if (is_in(servo, VERICAN_SYNC_LOCKED)) return;
  ++servo->pairs;
  const bool chosen = servo->config.filter != 0u || servo->learned >= (uint8_t)PAIRS_TO_CHOOSE;
  servo->state =
      (uint8_t)(has_history(servo) && chosen ? VERICAN_SYNC_LOCKED : VERICAN_SYNC_ACQUIRING);
}

static void take(verican_servo_t *servo, const verican_sync_pair_t *pair,
                 verican_correction_t *correction) {
  const int64_t whole = offset_of(servo, pair);
  const int64_t latency = latency_of(pair);
  const int64_t offset = 256 * verican_limit(whole, OFFSET_LIMIT) - latency;
  const int64_t gate = gate_of(servo, pair);
  const bool first = is_in(servo, VERICAN_SYNC_UNSYNCHRONISED);
  int64_t rest = offset;
  if (first || has_leapt(servo, offset)) {
    if (is_in(servo, VERICAN_SYNC_LOCKED) && !is_confirmed(servo, whole, gate)) {
      correction->events |= VERICAN_SERVO_LEAP;
      return;
    }
    if (first) verican_filter_start(servo, pair->increment);
    step(servo, whole, correction);
    rest = -latency;
  } else {
    servo->leaps = 0;
    if (is_outlier(servo, offset, gate)) {
      correction->events |= VERICAN_SERVO_OUTLIER;
      return;
    }
  }
  accept(servo, pair, rest, correction);
}

verican_result_t verican_servo_pair(verican_servo_t *servo, const verican_sync_pair_t *pair,
                                    verican_correction_t *correction) {
  if (servo == NULL || pair == NULL || correction == NULL) return VERICAN_ERR_NULL;
  const uint8_t before = servo->state;
  *correction = (verican_correction_t){0, pair->increment, false, 0};
  take(servo, pair, correction);
  if (servo->state != before) correction->events |= VERICAN_SERVO_STATE;
  return VERICAN_OK;
}

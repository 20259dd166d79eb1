/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo without pairs: holdover, and another master (TM-87, TM-89).
 */
#include "servo_internal.h"

static uint64_t silence(const verican_servo_t *servo, uint64_t now) {
  const int64_t distance = (int64_t)(now - (uint64_t)servo->last);
  return distance > 0 ? (uint64_t)distance : 0u;
}

/* Who was never locked has no rate to hold. */
bool verican_servo_poll(verican_servo_t *servo, uint64_t now) {
  const verican_sync_state_t state = (verican_sync_state_t)servo->state;
  if (state != VERICAN_SYNC_LOCKED && state != VERICAN_SYNC_ACQUIRING) return false;
  const uint64_t interval = (uint64_t)servo->config.interval_us * 1000u;
  if (silence(servo, now) <= servo->config.hold_after * interval) return false;
  servo->state =
      (uint8_t)(state == VERICAN_SYNC_LOCKED ? VERICAN_SYNC_HOLDOVER : VERICAN_SYNC_UNSYNCHRONISED);
  return verican_servo_forget(servo) == VERICAN_OK;
}

verican_result_t verican_servo_forget(verican_servo_t *servo) {
  if (servo == NULL) return VERICAN_ERR_NULL;
  servo->count = 0;
  servo->pairs = 0;
  servo->leaps = 0;
  servo->dropped = false;
  return VERICAN_OK;
}

uint64_t verican_servo_bound(const verican_servo_t *servo, uint64_t now) {
  const uint64_t error = ((uint64_t)servo->error + 255u) / 256u;
  if (servo->state != (uint8_t)VERICAN_SYNC_HOLDOVER) return error;
  const uint64_t milliseconds = silence(servo, now) / 1000000u + 1u;
  return error + milliseconds * servo->config.drift_ppb / 1000u + 1u;
}

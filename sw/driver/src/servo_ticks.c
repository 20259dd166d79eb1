/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Times and rates of the servo's fit (TM-81).
 */
#include "servo_internal.h"

int64_t verican_limit(int64_t value, int64_t limit) {
  if (value > limit) return limit;
  return value < -limit ? -limit : value;
}

int32_t verican_ticks(int64_t from, int64_t to) {
  const int64_t distance = (int64_t)((uint64_t)to - (uint64_t)from);
  return (int32_t)verican_limit(verican_floor(distance, 12), TICKS_LIMIT);
}

int64_t verican_drift(int64_t rate, int32_t ticks) { return verican_floor(rate * ticks, 24); }

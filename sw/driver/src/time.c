/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Time: TIMER and time stamps have 16 bits (flexcan.md 6); here they get 64.
 */
#include "internal.h"

/* The value with these low 16 bits that is nearest to the latest one known: right as long as that
 * is less than 32,768 bit times away. A stamp may be older than what is known. */
uint64_t verican_extend(verican_t *dev, uint32_t stamp) {
  const uint32_t ahead = (stamp - (uint32_t)dev->time) & 0xFFFFu;
  if (ahead < 0x8000u) {
    dev->time += ahead;
    return dev->time;
  }
  const uint64_t behind = 0x10000u - ahead;
  return dev->time >= behind ? dev->time - behind : 0u;
}

uint64_t verican_now(verican_t *dev) {
  return verican_extend(dev, verican_read(dev, VERICAN_TIMER_OFFSET) & 0xFFFFu);
}

verican_result_t verican_time(verican_t *dev, uint64_t *bits) {
  const verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  if (bits == NULL) return VERICAN_ERR_NULL;
  const uint32_t token = verican_lock(dev);
  *bits = verican_now(dev);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

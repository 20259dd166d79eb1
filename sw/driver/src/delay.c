/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The delay from the master to here, measured by the way back (TM-58). Forth and back by both
 * clocks: what one clock is ahead of the other cancels out, as long as it stays the same.
 */
#include "verican/delay.h"

/* A request that went so much behind a SYNC or more was sent by a clock that was set meanwhile. */
#define SYNC_TO_REQUEST_NS 0x80000000u

verican_result_t verican_delay_start(verican_delay_t *delay, uint8_t exchanges) {
  if (delay == NULL) return VERICAN_ERR_NULL;
  if (exchanges == 0u) return VERICAN_ERR_RANGE;
  *delay = (verican_delay_t){0};
  delay->wanted = exchanges;
  return VERICAN_OK;
}

bool verican_delay_pair(verican_delay_t *delay, const verican_sync_pair_t *pair, int64_t shift) {
  if (delay->wanted == 0u) return false;
  if (delay->sent != 0u && delay->sent - pair->local < SYNC_TO_REQUEST_NS) return false;
  delay->master = pair->master;
  delay->forth = (int64_t)(pair->local + (uint64_t)shift - pair->master);
  delay->sent = 0;
  delay->paired = true;
  return true;
}

void verican_delay_sent(verican_delay_t *delay, uint64_t stamp) { delay->sent = stamp; }

/* Half of the sum of n exchanges, to the nearest. */
static int32_t mean(int64_t sum, unsigned count) {
  const int32_t n = (int32_t)count;
  return (int32_t)((sum + (sum < 0 ? -n : n)) / (2 * n));
}

/* An exchange of 2.1 s or more is of a response that is none, or of clocks one of which was set
 * meanwhile: it does not count. */
bool verican_delay_response(verican_delay_t *delay, uint64_t master, int32_t *delay_ns) {
  if (!delay->paired || delay->sent == 0u || (int64_t)(master - delay->master) < 0) return false;
  const int64_t both = (int64_t)((uint64_t)delay->forth + master - delay->sent);
  delay->sent = 0;
  delay->paired = false;
  if (both != (int32_t)both) return false;
  delay->sum += both;
  if (++delay->count < delay->wanted) return false;
  *delay_ns = mean(delay->sum, delay->count);
  delay->wanted = 0;
  return true;
}

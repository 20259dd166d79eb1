/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Several masters: which one to follow, and when a candidate may send (TM-89).
 */
#include "verican/tsyn.h"

void verican_masters_start(verican_masters_t *masters, uint32_t interval_us, uint64_t now) {
  *masters = (verican_masters_t){0};
  masters->interval = (uint64_t)interval_us * 1000u;
  masters->since = now;
  masters->current = VERICAN_MASTER_NONE;
}

/* Whether `at` is at most 3 R and `rank` times R / 2 ago. */
static bool is_late(const verican_masters_t *masters, uint64_t at, uint64_t now, unsigned rank) {
  return (int64_t)(now - at) <= (int64_t)(masters->interval * (6u + rank) / 2u);
}

/* The best of the first `count` that was heard so late, or `count`. */
static unsigned best(const verican_masters_t *masters, unsigned count, uint64_t now,
                     unsigned rank) {
  unsigned n = 0;
  while (n < count &&
         ((masters->known >> n & 1u) == 0u || !is_late(masters, masters->heard[n], now, rank)))
    ++n;
  return n;
}

bool verican_masters_hear(verican_masters_t *masters, uint8_t rank, uint64_t stamp) {
  masters->heard[rank] = stamp;
  masters->known |= (uint8_t)(1u << rank);
  return best(masters, rank, stamp, 0) == rank;
}

bool verican_masters_may_send(const verican_masters_t *masters, uint8_t rank, uint64_t now) {
  return !is_late(masters, masters->since, now, rank) && best(masters, rank, now, rank) == rank;
}

bool verican_masters_alive(const verican_masters_t *masters, uint64_t now) {
  return best(masters, VERICAN_MASTERS, now, 0) < VERICAN_MASTERS;
}

void verican_masters_shift(verican_masters_t *masters, int64_t shift) {
  for (unsigned rank = 0; rank < VERICAN_MASTERS; ++rank) masters->heard[rank] += (uint64_t)shift;
  masters->since += (uint64_t)shift;
}

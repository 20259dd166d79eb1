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

/* Whether master `rank` was heard in the last `span` ns. */
static bool heard(const verican_masters_t *masters, unsigned rank, uint64_t now, uint64_t span) {
  if ((masters->known >> rank & 1u) == 0u) return false;
  return (int64_t)(now - masters->heard[rank]) <= (int64_t)span;
}

/* The best of the first `count` that was heard in the last `span` ns, or `count`. */
static unsigned best(const verican_masters_t *masters, unsigned count, uint64_t now,
                     uint64_t span) {
  unsigned rank = 0;
  while (rank < count && !heard(masters, rank, now, span)) ++rank;
  return rank;
}

bool verican_masters_hear(verican_masters_t *masters, uint8_t rank, uint64_t stamp) {
  masters->heard[rank] = stamp;
  masters->known |= (uint8_t)(1u << rank);
  return best(masters, rank, stamp, 3u * masters->interval) == rank;
}

bool verican_masters_may_send(const verican_masters_t *masters, uint8_t rank, uint64_t now) {
  const uint64_t span = 3u * masters->interval + rank * masters->interval / 2u;
  return (int64_t)(now - masters->since) > (int64_t)span && best(masters, rank, now, span) == rank;
}

bool verican_masters_alive(const verican_masters_t *masters, uint64_t now) {
  return best(masters, VERICAN_MASTERS, now, 3u * masters->interval) < VERICAN_MASTERS;
}

void verican_masters_shift(verican_masters_t *masters, int64_t shift) {
  for (unsigned rank = 0; rank < VERICAN_MASTERS; ++rank) masters->heard[rank] += (uint64_t)shift;
  masters->since += (uint64_t)shift;
}

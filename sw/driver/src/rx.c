/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reception into mailboxes. They fill in any order; the ring sorts them by time stamp.
 */
#include "internal.h"

/* A move takes some clocks: no more reads than that for one mailbox. */
enum { BUSY_LIMIT = 64 };

/* C/S (which locks), ID, data, clear the flag, TIMER (which unlocks): a frame that waits for this
 * mailbox moves in after the clear and raises the flag again (flexcan.md 3.6). */
static void read_mailbox(verican_t *dev, unsigned mb) {
  uint32_t cs = verican_read(dev, VERICAN_MB_CS_OFFSET(mb));
  for (unsigned n = 0; (cs & CS_RX_BUSY) != 0u && n < (unsigned)BUSY_LIMIT; ++n)
    cs = verican_read(dev, VERICAN_MB_CS_OFFSET(mb));
  const uint32_t code = cs & VERICAN_MB_CS_CODE_MASK;
  verican_frame_t frame;
  const bool full = code == CS_CODE(RX_FULL) || code == CS_CODE(RX_OVERRUN);
  if (full) verican_frame_read(dev, mb, cs, &frame);
  verican_clear_flag(dev, mb);
  (void)verican_now(dev);
  if (!full) return;
  if (code == CS_CODE(RX_OVERRUN)) ++dev->stats.rx_overruns;
  verican_ring_insert(dev, &frame);
}

bool verican_rx_mailboxes(verican_t *dev, const uint32_t flags[2]) {
  bool any = false;
  for (unsigned mb = 0; mb < dev->first_tx; ++mb) {
    if ((flags[mb / 32u] & dev->rx_mask[mb / 32u] & verican_bit(mb)) == 0u) continue;
    read_mailbox(dev, mb);
    any = true;
  }
  return any;
}

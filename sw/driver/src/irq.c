/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The interrupt handler.
 */
#include "internal.h"

/* On a saturated bus with a slow processor there is always more: the line stays high then, and the
 * handler is called again after others had their turn. */
enum { PASSES = 8 };

/* The flags of one moment: a frame that comes between two reads could otherwise be served before
 * an older one. Frames are so far apart that one repetition does. */
static void read_flags(const verican_t *dev, uint32_t flags[2]) {
  flags[0] = verican_read(dev, VERICAN_IFLAG1_OFFSET);
  flags[1] = 0;
  if (dev->num_mb <= 32u) return;
  for (unsigned n = 0; n < (unsigned)PASSES; ++n) {
    flags[1] = verican_read(dev, VERICAN_IFLAG2_OFFSET);
    const uint32_t again = verican_read(dev, VERICAN_IFLAG1_OFFSET);
    if (again == flags[0]) return;
    flags[0] = again;
  }
}

static bool serve_buffers(verican_t *dev) {
  uint32_t flags[2];
  read_flags(dev, flags);
  bool any = dev->rx_mode == (uint8_t)VERICAN_RX_FIFO ? verican_rx_fifo(dev, flags[0])
                                                      : verican_rx_mailboxes(dev, flags);
  if (verican_ring_commit(dev) && dev->callbacks.on_receive != NULL)
    dev->callbacks.on_receive(dev->callbacks.user, dev);
  if (verican_tx_serve(dev, flags)) any = true;
  return any;
}

bool verican_serve(verican_t *dev) {
  bool any = (verican_state_serve(dev) & ESR_FLAGS) != 0u;
  for (unsigned n = 0; n < (unsigned)PASSES && serve_buffers(dev); ++n) any = true;
  return any;
}

verican_result_t verican_irq_handler(verican_t *dev) {
  const verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  return verican_serve(dev) ? VERICAN_OK : VERICAN_ERR_EMPTY;
}

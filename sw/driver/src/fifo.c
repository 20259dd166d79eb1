/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reception through the FIFO (flexcan.md 4): six frames deep, already in order.
 */
#include "internal.h"

bool verican_rx_fifo(verican_t *dev, uint32_t flags) {
  bool any = false;
  for (unsigned n = 0; (flags & VERICAN_IFLAG1_FIFO_AVAILABLE_MASK) != 0u && n < VERICAN_FIFO_DEPTH;
       ++n) {
    verican_frame_t frame;
    verican_frame_read(
        dev, 0, verican_read(dev, VERICAN_MB_CS_OFFSET(0)) & ~VERICAN_MB_CS_CODE_MASK, &frame);
    frame.source = (uint8_t)verican_read(dev, VERICAN_RXFIR_OFFSET);
    verican_write(dev, VERICAN_IFLAG1_OFFSET,
                  VERICAN_IFLAG1_FIFO_AVAILABLE_MASK); /* the next one appears */
    verican_ring_insert(dev, &frame);
    any = true;
    flags =
        (flags & ~VERICAN_IFLAG1_FIFO_AVAILABLE_MASK) | verican_read(dev, VERICAN_IFLAG1_OFFSET);
  }
  if ((flags & VERICAN_IFLAG1_FIFO_OVERFLOW_MASK) != 0u) ++dev->stats.rx_overruns;
  if ((flags & (VERICAN_IFLAG1_FIFO_OVERFLOW_MASK | VERICAN_IFLAG1_FIFO_WARNING_MASK)) == 0u)
    return any;
  verican_write(dev, VERICAN_IFLAG1_OFFSET,
                flags & (VERICAN_IFLAG1_FIFO_OVERFLOW_MASK | VERICAN_IFLAG1_FIFO_WARNING_MASK));
  return true;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reception through the FIFO (flexcan.md 4): six frames deep, already in order.
 */
#include "internal.h"

enum { DEPTH = 6 };

bool verican_rx_fifo(verican_t *dev, uint32_t flags) {
  bool any = false;
  for (unsigned n = 0; (flags & FIFO_AVAILABLE) != 0u && n < (unsigned)DEPTH; ++n) {
    verican_frame_t frame;
    verican_frame_read(dev, 0, verican_read(dev, MB_CS(0)) & ~CS_CODE_MASK, &frame);
    frame.source = (uint8_t)verican_read(dev, VERICAN_RXFIR_OFFSET);
    verican_write(dev, VERICAN_IFLAG1_OFFSET, FIFO_AVAILABLE); /* the next one appears */
    verican_ring_insert(dev, &frame);
    any = true;
    flags = (flags & ~FIFO_AVAILABLE) | verican_read(dev, VERICAN_IFLAG1_OFFSET);
  }
  if ((flags & FIFO_OVERFLOW) != 0u) ++dev->stats.rx_overruns;
  if ((flags & (FIFO_OVERFLOW | FIFO_WARNING)) == 0u) return any;
  verican_write(dev, VERICAN_IFLAG1_OFFSET, flags & (FIFO_OVERFLOW | FIFO_WARNING));
  return true;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Frames: between verican_frame_t and the words of a message buffer (flexcan.md 3.1).
 */
#include "internal.h"

static unsigned payload(uint32_t flags, unsigned dlc) {
  if ((flags & VERICAN_FRAME_REMOTE) != 0u) return 0;
  return dlc < 8u ? dlc : 8u;
}

verican_result_t verican_frame_check(const verican_frame_t *frame) {
  const unsigned known = VERICAN_FRAME_EXTENDED | VERICAN_FRAME_REMOTE | VERICAN_FRAME_OVERRUN |
                         VERICAN_FRAME_ONE_SHOT;
  const uint32_t limit = (frame->flags & VERICAN_FRAME_EXTENDED) != 0u ? 0x1FFFFFFFu : 0x7FFu;
  const bool ok = frame->id <= limit && frame->dlc <= 15u && (frame->flags & ~known) == 0u &&
                  frame->priority <= 7u;
  return ok ? VERICAN_OK : VERICAN_ERR_RANGE;
}

static void unpack(uint32_t word, uint8_t *data) {
  data[0] = (uint8_t)(word >> 24);
  data[1] = (uint8_t)(word >> 16);
  data[2] = (uint8_t)(word >> 8);
  data[3] = (uint8_t)word;
}

static uint32_t pack(const uint8_t *data) {
  return (uint32_t)data[0] << 24 | (uint32_t)data[1] << 16 | (uint32_t)data[2] << 8 |
         (uint32_t)data[3];
}

void verican_frame_read(verican_t *dev, unsigned mb, uint32_t cs, verican_frame_t *frame) {
  const uint32_t id = verican_read(dev, VERICAN_MB_ID_OFFSET(mb));
  *frame = (verican_frame_t){0};
  if ((cs & VERICAN_MB_CS_IDE_MASK) != 0u) {
    frame->flags = VERICAN_FRAME_EXTENDED;
    frame->id = id & 0x1FFFFFFFu;
  } else {
    frame->id = (id >> VERICAN_MB_ID_STD_SHIFT) & 0x7FFu;
  }
  if ((cs & VERICAN_MB_CS_RTR_MASK) != 0u) frame->flags |= VERICAN_FRAME_REMOTE;
  if ((cs & VERICAN_MB_CS_CODE_MASK) == CS_CODE(RX_OVERRUN)) frame->flags |= VERICAN_FRAME_OVERRUN;
  frame->dlc = (uint8_t)((cs >> VERICAN_MB_CS_DLC_SHIFT) & 0xFu);
  frame->source = (uint8_t)mb;
  const unsigned bytes = payload(frame->flags, frame->dlc);
  if (bytes > 0u) unpack(verican_read(dev, VERICAN_MB_DATA0_OFFSET(mb)), &frame->data[0]);
  if (bytes > 4u) unpack(verican_read(dev, VERICAN_MB_DATA1_OFFSET(mb)), &frame->data[4]);
  for (unsigned i = bytes; i < 8u; ++i) frame->data[i] = 0;
  frame->time_ns = verican_stamp(dev, mb, dev->rx_latency);
  frame->timestamp = verican_extend(dev, cs & VERICAN_MB_CS_TIME_STAMP_MASK);
}

/* Data, ID, and the C/S word last, which hands the buffer over (flexcan.md 3.3). */
void verican_frame_write(const verican_t *dev, unsigned mb, const verican_frame_t *frame) {
  const unsigned bytes = payload(frame->flags, frame->dlc);
  uint32_t cs = CS_CODE(TX_DATA) | (uint32_t)frame->dlc << VERICAN_MB_CS_DLC_SHIFT;
  uint32_t id = frame->id;
  if ((frame->flags & VERICAN_FRAME_EXTENDED) != 0u) {
    cs |= VERICAN_MB_CS_IDE_MASK | VERICAN_MB_CS_SRR_MASK;
  } else {
    id <<= VERICAN_MB_ID_STD_SHIFT;
  }
  if ((frame->flags & VERICAN_FRAME_REMOTE) != 0u) cs |= VERICAN_MB_CS_RTR_MASK;
  if ((frame->flags & VERICAN_FRAME_ONE_SHOT) != 0u) cs |= VERICAN_MB_CS_OS_MASK;
  if (dev->tx_order == (uint8_t)VERICAN_TX_BY_PRIORITY)
    id |= (uint32_t)frame->priority << VERICAN_MB_ID_PRIO_SHIFT;
  if (bytes > 0u) verican_write(dev, VERICAN_MB_DATA0_OFFSET(mb), pack(&frame->data[0]));
  if (bytes > 4u) verican_write(dev, VERICAN_MB_DATA1_OFFSET(mb), pack(&frame->data[4]));
  verican_write(dev, VERICAN_MB_ID_OFFSET(mb), id);
  verican_write(dev, VERICAN_MB_CS_OFFSET(mb), cs);
}

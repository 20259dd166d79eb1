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
  const unsigned known = VERICAN_FRAME_EXTENDED | VERICAN_FRAME_REMOTE | VERICAN_FRAME_OVERRUN;
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
  const uint32_t id = verican_read(dev, MB_ID(mb));
  *frame = (verican_frame_t){0};
  if ((cs & CS_IDE) != 0u) {
    frame->flags = VERICAN_FRAME_EXTENDED;
    frame->id = id & 0x1FFFFFFFu;
  } else {
    frame->id = (id >> ID_STANDARD_SHIFT) & 0x7FFu;
  }
  if ((cs & CS_RTR) != 0u) frame->flags |= VERICAN_FRAME_REMOTE;
  if ((cs & CS_CODE_MASK) == CS_RX_OVERRUN) frame->flags |= VERICAN_FRAME_OVERRUN;
  frame->dlc = (uint8_t)((cs >> CS_DLC_SHIFT) & 0xFu);
  frame->source = (uint8_t)mb;
  const unsigned bytes = payload(frame->flags, frame->dlc);
  if (bytes > 0u) unpack(verican_read(dev, MB_DATA0(mb)), &frame->data[0]);
  if (bytes > 4u) unpack(verican_read(dev, MB_DATA1(mb)), &frame->data[4]);
  for (unsigned i = bytes; i < 8u; ++i) frame->data[i] = 0;
  frame->timestamp = verican_extend(dev, cs & CS_STAMP_MASK);
}

/* Data, ID, and the C/S word last, which hands the buffer over (flexcan.md 3.3). */
void verican_frame_write(const verican_t *dev, unsigned mb, const verican_frame_t *frame) {
  const unsigned bytes = payload(frame->flags, frame->dlc);
  uint32_t cs = CS_TX_DATA | (uint32_t)frame->dlc << CS_DLC_SHIFT;
  uint32_t id = frame->id;
  if ((frame->flags & VERICAN_FRAME_EXTENDED) != 0u) {
    cs |= CS_IDE | CS_SRR;
  } else {
    id <<= ID_STANDARD_SHIFT;
  }
  if ((frame->flags & VERICAN_FRAME_REMOTE) != 0u) cs |= CS_RTR;
  if (dev->tx_order == (uint8_t)VERICAN_TX_BY_PRIORITY)
    id |= (uint32_t)frame->priority << ID_PRIORITY_SHIFT;
  if (bytes > 0u) verican_write(dev, MB_DATA0(mb), pack(&frame->data[0]));
  if (bytes > 4u) verican_write(dev, MB_DATA1(mb), pack(&frame->data[4]));
  verican_write(dev, MB_ID(mb), id);
  verican_write(dev, MB_CS(mb), cs);
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The ring of received frames. The handler sorts a batch by time stamp in the free places behind
 * the head, then moves the head over it: the reader never sees a frame before an older one.
 */
#include "internal.h"

static verican_frame_t *slot(const verican_t *dev, uint32_t behind_head) {
  uint32_t index = (uint32_t)dev->ring_head + behind_head;
  if (index >= dev->ring_size) index -= dev->ring_size;
  return &dev->ring[index];
}

static uint16_t used(const verican_t *dev) {
  const uint16_t head = dev->ring_head;
  const uint16_t tail = dev->ring_tail;
  return (uint16_t)(head >= tail ? head - tail : head + dev->ring_size - tail);
}

/* Without room the newest frame of the batch goes. */
void verican_ring_insert(verican_t *dev, const verican_frame_t *frame) {
  uint32_t place = dev->batch;
  if (place + used(dev) + 1u >= dev->ring_size) {
    ++dev->stats.rx_dropped;
    if (place == 0u || slot(dev, place - 1u)->timestamp <= frame->timestamp) return;
    --place;
  } else {
    ++dev->batch;
  }
  for (; place > 0u && slot(dev, place - 1u)->timestamp > frame->timestamp; --place)
    *slot(dev, place) = *slot(dev, place - 1u);
  *slot(dev, place) = *frame;
}

bool verican_ring_commit(verican_t *dev) {
  const uint16_t batch = dev->batch;
  if (batch == 0u) return false;
  uint32_t head = (uint32_t)dev->ring_head + batch;
  if (head >= dev->ring_size) head -= dev->ring_size;
  dev->stats.received += batch;
  dev->batch = 0;
  VERICAN_BARRIER();
  dev->ring_head = (uint16_t)head;
  return true;
}

verican_result_t verican_receive(verican_t *dev, verican_frame_t *frame) {
  const verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (frame == NULL) return VERICAN_ERR_NULL;
  const uint16_t tail = dev->ring_tail;
  if (tail == dev->ring_head) return VERICAN_ERR_EMPTY;
  VERICAN_BARRIER();
  *frame = dev->ring[tail];
  VERICAN_BARRIER();
  dev->ring_tail = (uint16_t)(tail + 1u == dev->ring_size ? 0u : tail + 1u);
  return VERICAN_OK;
}

verican_result_t verican_rx_waiting(const verican_t *dev, uint16_t *count) {
  const verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (count == NULL) return VERICAN_ERR_NULL;
  *count = used(dev);
  return VERICAN_OK;
}

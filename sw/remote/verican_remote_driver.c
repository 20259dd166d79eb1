/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The client of can_remote over the VeriCAN driver.
 */
#include "verican_remote_driver.h"

#include <string.h>

enum { SEND_US = 1000000 };

static void idle(const verican_remote_driver_t *d) {
  if (d->idle != NULL) d->idle(d->context);
}

/* By bus-off, or because somebody has stopped the device. */
static bool is_off(verican_t *device) {
  verican_status_t status;
  return verican_get_status(device, &status) != VERICAN_OK ||
         status.state == VERICAN_STATE_BUS_OFF || status.state == VERICAN_STATE_STOPPED;
}

/* Hands the frame to the driver unless it could overtake one that waits. */
static verican_result_t hand_over(verican_t *device, const verican_frame_t *frame) {
  uint8_t waiting = 0;
  const verican_result_t result = verican_tx_waiting(device, &waiting);
  if (result != VERICAN_OK) return result;
  if (waiting != 0 && device->tx_order != VERICAN_TX_IN_ORDER) return VERICAN_ERR_BUSY;
  return verican_send(device, frame, NULL);
}

static verican_remote_result_t driver_send(void *context, const verican_remote_frame_t *frame) {
  const verican_remote_driver_t *d = context;
  verican_frame_t out = {
      .id = frame->id, .flags = frame->remote ? VERICAN_FRAME_REMOTE : 0, .dlc = frame->dlc};
  memcpy(out.data, frame->data, sizeof out.data);
  const uint32_t start = d->now_us(d->context);
  const uint32_t limit = d->send_us != 0 ? d->send_us : SEND_US;
  for (;;) {
    if (is_off(d->device)) return VERICAN_REMOTE_BUS_OFF;
    const verican_result_t result = hand_over(d->device, &out);
    if (result == VERICAN_OK) return VERICAN_REMOTE_OK;
    if (result != VERICAN_ERR_BUSY) return VERICAN_REMOTE_BUS_OFF; /* or it listens only */
    if (d->now_us(d->context) - start >= limit) return VERICAN_REMOTE_TIMEOUT;
    idle(d);
  }
}

static verican_remote_result_t driver_receive(void *context, verican_remote_frame_t *frame,
                                              uint32_t timeout_us) {
  const verican_remote_driver_t *d = context;
  const uint32_t start = d->now_us(d->context);
  for (;;) {
    verican_frame_t in;
    const bool got = verican_receive(d->device, &in) == VERICAN_OK;
    if (got && (in.flags & VERICAN_FRAME_EXTENDED) == 0) {
      *frame = (verican_remote_frame_t){.id = (uint16_t)in.id,
                                        .remote = (in.flags & VERICAN_FRAME_REMOTE) != 0,
                                        .dlc = in.dlc < 8 ? in.dlc : 8};
      memcpy(frame->data, in.data, sizeof frame->data);
      return VERICAN_REMOTE_OK;
    }
    if (!got && is_off(d->device)) return VERICAN_REMOTE_BUS_OFF;
    const uint32_t limit = got ? verican_remote_skip_us(timeout_us) : timeout_us;
    if (d->now_us(d->context) - start >= limit) return VERICAN_REMOTE_TIMEOUT;
    if (!got) idle(d);
  }
}

static uint32_t driver_now(void *context) {
  const verican_remote_driver_t *d = context;
  return d->now_us(d->context);
}

verican_remote_port_t verican_remote_driver_port(verican_remote_driver_t *driver) {
  return (verican_remote_port_t){
      .send = driver_send, .receive = driver_receive, .now_us = driver_now, .context = driver};
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Sending for CANopenNode. The core sends what would win on the bus first; a buffer of the stack
 * has one frame in a mailbox at most, or two of one identifier could change places.
 */
#include "301/CO_driver.h"
#include "co_verican.h"

CO_CANtx_t *CO_CANtxBufferInit(CO_CANmodule_t *module, uint16_t index, uint16_t ident, bool_t rtr,
                               uint8_t length, bool_t syncFlag) {
  if (module == NULL || index >= module->txSize || length > 8u) return NULL;
  CO_CANtx_t *buffer = &module->txArray[index];
  CO_LOCK_CAN_SEND(module);
  if (buffer->bufferFull) --module->CANtxCount;
  buffer->ident = ident & 0x7FFu;
  buffer->DLC = length;
  buffer->rtr = rtr;
  buffer->bufferFull = false;
  buffer->syncFlag = syncFlag;
  CO_UNLOCK_CAN_SEND(module);
  return buffer;
}

/* Under lock. False: its frame before has not left, no mailbox is free, or filters are due. A
 * client that is told of a new COB-ID may use it at once, so the answer leaves when its filter is
 * in place; and a node that sends all the time would never have nothing under way, as new filters
 * need. */
static bool put(co_verican_t *can, CO_CANtx_t *buffer) {
  if (can->filters_changed || buffer->mailbox != CO_VERICAN_NO_MAILBOX) return false;
  verican_frame_t frame = {.id = buffer->ident, .dlc = buffer->DLC};
  if (buffer->rtr) frame.flags = VERICAN_FRAME_REMOTE;
  for (size_t i = 0; i < sizeof frame.data; ++i) frame.data[i] = buffer->data[i];
  uint8_t mailbox = 0;
  if (verican_send(&can->device, &frame, &mailbox) != VERICAN_OK) return false;
  buffer->mailbox = mailbox;
  can->in_mailbox[mailbox] = buffer;
  return true;
}

CO_ReturnError_t CO_CANsend(CO_CANmodule_t *module, CO_CANtx_t *buffer) {
  CO_ReturnError_t result = CO_ERROR_NO;
  if (module == NULL || buffer == NULL) return CO_ERROR_ILLEGAL_ARGUMENT;
  co_verican_t *can = module->CANptr;
  CO_LOCK_CAN_SEND(module);
  if (buffer->bufferFull) {
    /* A node that is alone on its bus is no error: the boot-up message waits for company. */
    if (!module->firstCANtxMessage) can->tx_errors |= CO_CAN_ERRTX_OVERFLOW;
    result = CO_ERROR_TX_OVERFLOW;
  } else if (!put(can, buffer)) {
    buffer->bufferFull = true;
    ++module->CANtxCount;
  }
  CO_UNLOCK_CAN_SEND(module);
  return result;
}

/* Lowest buffer first. */
void co_verican_send_waiting(CO_CANmodule_t *module) {
  for (uint16_t i = 0; i < module->txSize && module->CANtxCount != 0u; ++i) {
    CO_CANtx_t *buffer = &module->txArray[i];
    if (!buffer->bufferFull || !put(module->CANptr, buffer)) continue;
    buffer->bufferFull = false;
    --module->CANtxCount;
  }
}

void co_verican_sent(void *user, verican_t *dev, const verican_tx_event_t *event) {
  co_verican_t *can = user;
  CO_CANmodule_t *module = can->module;
  (void)dev;
  const uint32_t token = can->port.lock(can->port.context);
  CO_CANtx_t *buffer = can->in_mailbox[event->mailbox];
  can->in_mailbox[event->mailbox] = NULL;
  if (buffer != NULL) buffer->mailbox = CO_VERICAN_NO_MAILBOX;
  if (event->outcome == VERICAN_TX_SENT) module->firstCANtxMessage = false;
  if (module->CANnormal) co_verican_send_waiting(module);
  can->port.unlock(can->port.context, token);
}

void CO_CANclearPendingSyncPDOs(CO_CANmodule_t *module) {
  if (module == NULL) return;
  co_verican_t *can = module->CANptr;
  bool late = false;
  CO_LOCK_CAN_SEND(module);
  for (uint16_t i = 0; i < module->txSize; ++i) {
    CO_CANtx_t *buffer = &module->txArray[i];
    if (!buffer->syncFlag) continue;
    if (buffer->bufferFull) {
      buffer->bufferFull = false;
      --module->CANtxCount;
      late = true;
    }
    if (buffer->mailbox == CO_VERICAN_NO_MAILBOX) continue;
    late = verican_abort(&can->device, buffer->mailbox) == VERICAN_OK || late;
  }
  if (late) can->tx_errors |= CO_CAN_ERRTX_PDO_LATE;
  CO_UNLOCK_CAN_SEND(module);
}

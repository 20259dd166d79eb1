/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The port of CANopenNode (sw/canopennode) on a driver that does as it is told: order of frames,
 * overflow, synchronous window, filters, error state. On the RTL see drive_cases.py.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "301/CO_driver.h"
#include "check.h"

enum { MAILBOXES = 2, RECEIVERS = 4, SENDERS = 4 };

/* ---- The driver ---- */

static verican_config_t configured;
static verican_frame_t mailbox[MAILBOXES];
static bool full[MAILBOXES];
static verican_filter_t filters[64];
static unsigned filter_count;
static verican_status_t state;
static const verican_frame_t *arrived;
static verican_result_t start_result, stop_result; /* what the core lets happen */
static bool started;
static unsigned interrupts;

verican_result_t verican_config_default(verican_config_t *config) {
  memset(config, 0, sizeof *config);
  return VERICAN_OK;
}
verican_result_t verican_init(verican_t *dev, const verican_config_t *config) {
  (void)dev;
  configured = *config;
  return VERICAN_OK;
}
verican_result_t verican_start(verican_t *dev) {
  if (dev == NULL || started) return VERICAN_ERR_STATE;
  started = start_result == VERICAN_OK;
  return start_result;
}
verican_result_t verican_stop(verican_t *dev) {
  if (dev == NULL || !started) return VERICAN_ERR_STATE;
  started = stop_result != VERICAN_OK;
  return stop_result;
}
verican_result_t verican_deinit(verican_t *dev) { return started ? verican_stop(dev) : VERICAN_OK; }
verican_result_t verican_poll(verican_t *dev, uint32_t now_ms) {
  (void)dev, (void)now_ms;
  return VERICAN_OK;
}
verican_result_t verican_irq_handler(verican_t *dev) {
  if (dev == NULL || !started) return VERICAN_ERR_STATE;
  ++interrupts;
  return VERICAN_OK;
}
verican_result_t verican_set_filters(verican_t *dev, const verican_filter_t *of, uint16_t count) {
  if (dev == NULL || started) return VERICAN_ERR_STATE;
  memcpy(filters, of, count * sizeof *of);
  filter_count = count;
  return VERICAN_OK;
}
verican_result_t verican_send(verican_t *dev, const verican_frame_t *frame, uint8_t *number) {
  if (dev == NULL || !started) return VERICAN_ERR_STATE;
  for (uint8_t i = 0; i < MAILBOXES; ++i) {
    if (full[i]) continue;
    full[i] = true;
    mailbox[i] = *frame;
    *number = i;
    return VERICAN_OK;
  }
  return VERICAN_ERR_BUSY;
}
static void ended(verican_t *dev, uint8_t number, verican_tx_outcome_t outcome) {
  const verican_tx_event_t event = {.mailbox = number, .outcome = outcome};
  full[number] = false;
  configured.callbacks.on_sent(configured.callbacks.user, dev, &event);
}
verican_result_t verican_abort(verican_t *dev, uint8_t number) {
  ended(dev, number, VERICAN_TX_ABORTED);
  return VERICAN_OK;
}
verican_result_t verican_tx_waiting(const verican_t *dev, uint8_t *count) {
  (void)dev;
  *count = (uint8_t)(full[0] + full[1]);
  return VERICAN_OK;
}
verican_result_t verican_receive(verican_t *dev, verican_frame_t *frame) {
  (void)dev;
  if (arrived == NULL) return VERICAN_ERR_EMPTY;
  *frame = *arrived;
  arrived = NULL;
  return VERICAN_OK;
}
verican_result_t verican_get_status(verican_t *dev, verican_status_t *status) {
  (void)dev;
  *status = state;
  return VERICAN_OK;
}

/* ---- The checks ---- */

static co_verican_t can;
static CO_CANmodule_t module;
static CO_CANrx_t receivers[RECEIVERS];
static CO_CANtx_t senders[SENDERS];
static unsigned heard[RECEIVERS];

static uint32_t lock(void *context) { return context == NULL ? 0u : 1u; }
static void unlock(void *context, uint32_t token) { (void)context, (void)token; }
static uint32_t now_ms(void) { return 0; }

static void hear(void *object, void *message) {
  ++*(unsigned *)object;
  CHECK(CO_CANrxMsg_readDLC(message) <= 8);
}

static void set_up(void) {
  memset(full, 0, sizeof full);
  memset(heard, 0, sizeof heard);
  state = (verican_status_t){.state = VERICAN_STATE_ACTIVE};
  start_result = stop_result = VERICAN_OK;
  started = false;
  filter_count = 0;
  can = (co_verican_t){.port = {.lock = lock, .unlock = unlock}, .now_ms = now_ms};
  CHECK(CO_CANmodule_init(&module, &can, receivers, RECEIVERS, senders, SENDERS, 250) ==
        CO_ERROR_NO);
  CHECK(configured.bitrate == 250000);
}

static CO_CANtx_t *sender(uint16_t index, uint16_t ident, bool sync) {
  return CO_CANtxBufferInit(&module, index, ident, false, 1, sync);
}

static CO_ReturnError_t send(CO_CANtx_t *buffer, uint8_t byte) {
  buffer->data[0] = byte;
  return CO_CANsend(&module, buffer);
}

/* Two frames of one identifier are never in the core together: it could turn them round. */
static void frames_of_a_buffer_keep_their_order(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  CO_CANtx_t *buffer = sender(0, 0x581, false);
  CHECK(send(buffer, 1) == CO_ERROR_NO && full[0] && mailbox[0].data[0] == 1);
  CHECK(send(buffer, 2) == CO_ERROR_NO && !full[1] && buffer->bufferFull);
  ended(&can.device, 0, VERICAN_TX_SENT);
  CHECK(full[0] && mailbox[0].data[0] == 2 && !full[1] && !buffer->bufferFull);
  CHECK(module.CANtxCount == 0);
}

static void a_third_frame_is_an_overflow(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  CO_CANtx_t *buffer = sender(0, 0x581, false);
  (void)send(buffer, 1);
  ended(&can.device, 0, VERICAN_TX_SENT); /* the boot-up message is out */
  (void)send(buffer, 1);
  (void)send(buffer, 2);
  CHECK(CO_CANsend(&module, buffer) == CO_ERROR_TX_OVERFLOW);
  CO_CANmodule_process(&module);
  CHECK((module.CANerrorStatus & CO_CAN_ERRTX_OVERFLOW) != 0);
  ended(&can.device, 0, VERICAN_TX_SENT);
  CO_CANmodule_process(&module);
  CO_CANmodule_process(&module);
  CHECK((module.CANerrorStatus & CO_CAN_ERRTX_OVERFLOW) == 0);
}

static void the_lowest_waiting_buffer_goes_first(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  for (uint16_t i = 0; i < SENDERS; ++i) (void)sender(i, (uint16_t)(0x100 + i), false);
  for (uint16_t i = SENDERS; i-- > 0;) CHECK(send(&senders[i], (uint8_t)i) == CO_ERROR_NO);
  CHECK(module.CANtxCount == 2); /* 3 and 2 are in the core */
  ended(&can.device, 0, VERICAN_TX_SENT);
  CHECK(mailbox[0].id == 0x100 && module.CANtxCount == 1);
  ended(&can.device, 1, VERICAN_TX_SENT);
  CHECK(mailbox[1].id == 0x101 && module.CANtxCount == 0);
}

static void synchronous_pdos_are_taken_back(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  CO_CANtx_t *pdo = sender(0, 0x181, true), *other = sender(1, 0x581, false);
  (void)send(pdo, 1);
  (void)send(pdo, 2);
  (void)send(other, 3);
  CO_CANclearPendingSyncPDOs(&module);
  CHECK(!full[0] && full[1] && mailbox[1].id == 0x581 && !pdo->bufferFull);
  CHECK(module.CANtxCount == 0);
  CO_CANmodule_process(&module);
  CHECK((module.CANerrorStatus & CO_CAN_ERRTX_PDO_LATE) != 0);
}

static void filters_are_those_of_the_buffers(void) {
  set_up();
  CHECK(CO_CANrxBufferInit(&module, 0, 0, 0x7FF, false, &heard[0], hear) == CO_ERROR_NO);
  CHECK(CO_CANrxBufferInit(&module, 1, 0, 0x7FF, false, &heard[1], hear) == CO_ERROR_NO);
  CHECK(CO_CANrxBufferInit(&module, 2, 0x701, 0x7FF, true, &heard[2], hear) == CO_ERROR_NO);
  CHECK(CO_CANrxBufferInit(&module, 9, 1, 0x7FF, false, &heard[2], hear) ==
        CO_ERROR_ILLEGAL_ARGUMENT);
  CO_CANsetNormalMode(&module);
  CHECK(filter_count == 2 && filters[1].id == 0x701 && filters[1].rtr == VERICAN_SELECT_ONLY_1);
  const verican_frame_t nmt = {.id = 0, .dlc = 2}, data = {.id = 0x701, .dlc = 15},
                        remote = {.id = 0x701, .flags = VERICAN_FRAME_REMOTE};
  const verican_frame_t *all[] = {&nmt, &data, &remote};
  for (unsigned i = 0; i < 3; ++i) {
    arrived = all[i];
    configured.callbacks.on_receive(configured.callbacks.user, &can.device);
  }
  CHECK(heard[0] == 1 && heard[1] == 0 && heard[2] == 1);
  CHECK(CO_CANrxBufferInit(&module, 3, 0x701, 0x7FF, false, &heard[3], hear) == CO_ERROR_NO);
  CO_CANmodule_process(&module);
  CHECK(filter_count == 3);
}

static void errors_are_told(void) {
  static const struct {
    verican_state_t state;
    uint8_t tec, rec;
    uint16_t bits;
  } cases[] = {{VERICAN_STATE_ACTIVE, 95, 95, 0},
               {VERICAN_STATE_WARNING, 96, 0, CO_CAN_ERRTX_WARNING},
               {VERICAN_STATE_WARNING, 0, 96, CO_CAN_ERRRX_WARNING},
               {VERICAN_STATE_PASSIVE, 128, 0, CO_CAN_ERRTX_WARNING | CO_CAN_ERRTX_PASSIVE},
               {VERICAN_STATE_PASSIVE, 0, 128, CO_CAN_ERRRX_WARNING | CO_CAN_ERRRX_PASSIVE},
               {VERICAN_STATE_BUS_OFF, 0, 0, CO_CAN_ERRTX_BUS_OFF}};
  set_up();
  CO_CANsetNormalMode(&module);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    state.state = cases[i].state;
    state.tec = cases[i].tec;
    state.rec = cases[i].rec;
    CO_CANmodule_process(&module);
    CHECK(module.CANerrorStatus == cases[i].bits);
  }
  state = (verican_status_t){.state = VERICAN_STATE_ACTIVE, .stats = {.rx_dropped = 1}};
  CO_CANmodule_process(&module);
  CHECK(module.CANerrorStatus == CO_CAN_ERRRX_OVERFLOW);
  CO_CANmodule_process(&module);
  CHECK(module.CANerrorStatus == 0);
}

static void take(uint16_t index, uint16_t ident) {
  CHECK(CO_CANrxBufferInit(&module, index, ident, 0x7FF, false, &heard[index], hear) ==
        CO_ERROR_NO);
}

/* Off the bus, and told so, until the core starts. */
static void a_start_that_fails_is_tried_again(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  take(0, 0x701);
  start_result = VERICAN_ERR_TIMEOUT;
  CO_CANmodule_process(&module);
  CHECK(!started);
  state.state = VERICAN_STATE_STOPPED;
  start_result = VERICAN_OK;
  CO_CANmodule_process(&module);
  CHECK(started && filter_count == 1 && module.CANerrorStatus == CO_CAN_ERRTX_BUS_OFF);
  state.state = VERICAN_STATE_ACTIVE;
  stop_result = VERICAN_ERR_TIMEOUT; /* nothing has changed: it is not asked for */
  CO_CANmodule_process(&module);
  CHECK(started && module.CANerrorStatus == 0);
}

/* No end of a frame would bring it out: it would be full for ever. */
static void what_waits_for_a_start_leaves_with_it(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  take(0, 0x701);
  start_result = VERICAN_ERR_TIMEOUT;
  CO_CANmodule_process(&module);
  CO_CANtx_t *heartbeat = sender(0, 0x701, false), *response = sender(1, 0x581, false);
  CHECK(CO_CANsend(&module, heartbeat) == CO_ERROR_NO && heartbeat->bufferFull);
  start_result = VERICAN_OK;
  CO_CANmodule_process(&module);
  CHECK(started && full[0] && mailbox[0].id == 0x701 && !heartbeat->bufferFull);
  CO_CANsetConfigurationMode(&can);
  CHECK(CO_CANsend(&module, response) == CO_ERROR_NO && response->bufferFull);
  CO_CANsetNormalMode(&module);
  CHECK(full[1] && mailbox[1].id == 0x581 && module.CANtxCount == 0);
}

/* The answer to an SDO that changes a COB-ID is the client's leave to use it. */
static void what_follows_a_new_filter_leaves_behind_it(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  CO_CANtx_t *heartbeat = sender(0, 0x701, false), *answer = sender(1, 0x581, false);
  CHECK(CO_CANsend(&module, heartbeat) == CO_ERROR_NO && full[0]);
  take(0, 0x733);
  CHECK(CO_CANsend(&module, answer) == CO_ERROR_NO && !full[1] && answer->bufferFull);
  CO_CANmodule_process(&module); /* the heartbeat is under way */
  CHECK(filter_count == 0 && !full[1]);
  ended(&can.device, 0, VERICAN_TX_SENT);
  CHECK(!full[0] && !full[1]);
  CO_CANmodule_process(&module);
  CHECK(filter_count == 1 && filters[0].id == 0x733);
  CHECK(full[0] && mailbox[0].id == 0x581 && !answer->bufferFull && module.CANtxCount == 0);
}

/* Its line would stay high for ever. */
static void a_core_that_does_not_stop_is_served(void) {
  set_up();
  CO_CANsetNormalMode(&module);
  CHECK(module.CANnormal);
  stop_result = VERICAN_ERR_TIMEOUT;
  CO_CANsetConfigurationMode(&can);
  CHECK(!module.CANnormal);
  CO_CANsetNormalMode(&module);
  CHECK(!module.CANnormal);
  CO_CANmodule_disable(&module);
  const unsigned before = interrupts;
  co_verican_interrupt(&can);
  CHECK(started && interrupts == before + 1);
}

int main(void) {
  frames_of_a_buffer_keep_their_order();
  a_third_frame_is_an_overflow();
  the_lowest_waiting_buffer_goes_first();
  synchronous_pdos_are_taken_back();
  filters_are_those_of_the_buffers();
  errors_are_told();
  a_start_that_fails_is_tried_again();
  what_waits_for_a_start_leaves_with_it();
  what_follows_a_new_filter_leaves_behind_it();
  a_core_that_does_not_stop_is_served();
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

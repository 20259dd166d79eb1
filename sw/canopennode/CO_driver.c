/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * CANopenNode's driver functions (301/CO_driver.h) on the VeriCAN driver: the life of the module,
 * receive buffers as filters of message buffers, errors. Sending: co_verican_tx.c.
 */
#include "301/CO_driver.h"

#include "co_verican.h"

#define IDENT_MASK 0x07FFu
#define IDENT_RTR 0x0800u
#define DEFAULT_KBIT 125u
#define DEFAULT_TX_MAILBOXES 8u
#define WARNING_LEVEL 96u
#define PASSIVE_LEVEL 128u

/* ---- Receiving ------------------------------------------------------------------------------- */

static bool accepts(const CO_CANrx_t *buffer, uint16_t ident) {
  return buffer->CANrx_callback != NULL && ((ident ^ buffer->ident) & buffer->mask) == 0u;
}

/* The lowest buffer that fits gets the frame. */
static void hand_on(co_verican_t *can, verican_frame_t *frame) {
  const CO_CANmodule_t *module = can->module;
  if ((frame->flags & VERICAN_FRAME_EXTENDED) != 0u) return;
  uint16_t ident = (uint16_t)frame->id;
  if ((frame->flags & VERICAN_FRAME_REMOTE) != 0u) ident |= IDENT_RTR;
  for (uint16_t i = 0; i < module->rxSize; ++i) {
    const CO_CANrx_t *buffer = &module->rxArray[i];
    if (!accepts(buffer, ident)) continue;
    ++can->handed_on;
    buffer->CANrx_callback(buffer->object, frame);
    return;
  }
}

static void on_receive(void *user, verican_t *dev) {
  co_verican_t *can = user;
  verican_frame_t frame;
  while (verican_receive(dev, &frame) == VERICAN_OK)
    if (can->module->CANnormal) hand_on(can, &frame);
}

static bool is_repeated(const CO_CANmodule_t *module, uint16_t index) {
  const CO_CANrx_t *buffer = &module->rxArray[index];
  for (uint16_t i = 0; i < index; ++i) {
    const CO_CANrx_t *before = &module->rxArray[i];
    if (before->CANrx_callback != NULL && before->ident == buffer->ident &&
        before->mask == buffer->mask)
      return true;
  }
  return false;
}

/* Buffers that the stack does not use have identifier 0, which is that of NMT: each filter once.
 * Returns how many, or more than `room` if they do not fit. */
static uint16_t collect_filters(const CO_CANmodule_t *module, verican_filter_t *filters,
                                uint16_t room) {
  uint16_t count = 0;
  for (uint16_t i = 0; i < module->rxSize; ++i) {
    const CO_CANrx_t *buffer = &module->rxArray[i];
    if (buffer->CANrx_callback == NULL || is_repeated(module, i)) continue;
    if (count == room) return (uint16_t)(room + 1u);
    filters[count].id = buffer->ident & IDENT_MASK;
    filters[count].mask = buffer->mask & IDENT_MASK;
    filters[count].ide = VERICAN_SELECT_ONLY_0;
    filters[count].rtr =
        (buffer->ident & IDENT_RTR) != 0u ? VERICAN_SELECT_ONLY_1 : VERICAN_SELECT_ONLY_0;
    ++count;
  }
  return count;
}

/* Device is stopped. Too many filters for the core: it takes every frame, hand_on() chooses. */
static bool set_filters(co_verican_t *can) {
  verican_filter_t filters[64];
  CO_CANmodule_t *module = can->module;
  const uint16_t count = collect_filters(module, filters, 64u);
  verican_result_t result = VERICAN_ERR_SPACE;
  if (count <= 64u) result = verican_set_filters(&can->device, filters, count);
  module->useCANrxFilters = result == VERICAN_OK;
  if (result == VERICAN_ERR_SPACE || result == VERICAN_ERR_UNSUPPORTED) {
    const verican_filter_t all = {0, 0, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_BOTH};
    result = verican_set_filters(&can->device, &all, 1);
  }
  can->filters_changed = result != VERICAN_OK;
  return result == VERICAN_OK;
}

CO_ReturnError_t CO_CANrxBufferInit(CO_CANmodule_t *module, uint16_t index, uint16_t ident,
                                    uint16_t mask, bool_t rtr, void *object,
                                    void (*callback)(void *object, void *message)) {
  if (module == NULL || object == NULL || callback == NULL || index >= module->rxSize)
    return CO_ERROR_ILLEGAL_ARGUMENT;
  CO_LOCK_CAN_SEND(module);
  CO_CANrx_t *buffer = &module->rxArray[index];
  buffer->ident = (uint16_t)((ident & IDENT_MASK) | (rtr ? IDENT_RTR : 0u));
  buffer->mask = (uint16_t)((mask & IDENT_MASK) | IDENT_RTR);
  buffer->object = object;
  buffer->CANrx_callback = callback;
  ((co_verican_t *)module->CANptr)->filters_changed = true;
  CO_UNLOCK_CAN_SEND(module);
  return CO_ERROR_NO;
}

/* ---- The life of the module ------------------------------------------------------------------ */

/* A core that does not stop takes no filters: CO_CANsetNormalMode() then leaves CANnormal false. */
void CO_CANsetConfigurationMode(void *pointer) {
  co_verican_t *can = pointer;
  if (can == NULL || !can->open) return;
  (void)verican_stop(&can->device);
  can->module->CANnormal = false;
}

void CO_CANsetNormalMode(CO_CANmodule_t *module) {
  co_verican_t *can = module->CANptr;
  if (!can->open || !set_filters(can)) return;
  module->CANnormal = verican_start(&can->device) == VERICAN_OK;
  if (!module->CANnormal) return;
  CO_LOCK_CAN_SEND(module);
  co_verican_send_waiting(module);
  CO_UNLOCK_CAN_SEND(module);
}

static uint32_t bit_rate(uint16_t kbit) {
  static const uint16_t allowed[] = {10, 20, 50, 125, 250, 500, 800, 1000};
  for (size_t i = 0; i < sizeof allowed / sizeof *allowed; ++i)
    if (allowed[i] == kbit) return kbit * 1000u;
  return DEFAULT_KBIT * 1000u;
}

static verican_result_t open_device(co_verican_t *can, uint16_t kbit) {
  verican_config_t config;
  verican_result_t result = verican_config_default(&config);
  if (result != VERICAN_OK) return result;
  config.port = can->port;
  config.clock_hz = can->clock_hz;
  config.bitrate = bit_rate(kbit);
  config.mailboxes = can->mailboxes;
  config.tx_mailboxes = can->tx_mailboxes != 0u ? can->tx_mailboxes : DEFAULT_TX_MAILBOXES;
  config.abort = true;
  config.rx_ring = can->ring;
  config.rx_ring_size = CO_VERICAN_RING;
  if (can->bus_off_delay_ms != 0u) {
    config.bus_off = VERICAN_BUS_OFF_DELAYED;
    config.bus_off_delay_ms = can->bus_off_delay_ms;
  }
  config.callbacks.on_sent = co_verican_sent;
  config.callbacks.on_receive = on_receive;
  config.callbacks.user = can;
  result = verican_init(&can->device, &config);
  if (result != VERICAN_ERR_UNSUPPORTED) return result;
  config.abort = false; /* a core without it: pending PDOs are withdrawn */
  return verican_init(&can->device, &config);
}

CO_ReturnError_t CO_CANmodule_init(CO_CANmodule_t *module, void *pointer, CO_CANrx_t rxArray[],
                                   uint16_t rxSize, CO_CANtx_t txArray[], uint16_t txSize,
                                   uint16_t kbit) {
  co_verican_t *can = pointer;
  if (module == NULL || can == NULL || rxArray == NULL || txArray == NULL)
    return CO_ERROR_ILLEGAL_ARGUMENT;
  if (can->port.lock == NULL || can->port.unlock == NULL || can->now_ms == NULL)
    return CO_ERROR_ILLEGAL_ARGUMENT;
  module->CANnormal = false;
  can->open = false;
  can->module = module;
  can->lost = 0;
  can->tx_errors = 0;
  for (size_t i = 0; i < sizeof can->in_mailbox / sizeof *can->in_mailbox; ++i)
    can->in_mailbox[i] = NULL;
  *module = (CO_CANmodule_t){.CANptr = can,
                             .rxArray = rxArray,
                             .rxSize = rxSize,
                             .txArray = txArray,
                             .txSize = txSize,
                             .firstCANtxMessage = true};
  for (uint16_t i = 0; i < rxSize; ++i) rxArray[i] = (CO_CANrx_t){0};
  for (uint16_t i = 0; i < txSize; ++i) txArray[i] = (CO_CANtx_t){.mailbox = CO_VERICAN_NO_MAILBOX};
  const verican_result_t result = open_device(can, kbit);
  can->open = result == VERICAN_OK;
  if (result == VERICAN_ERR_TIMING) return CO_ERROR_ILLEGAL_BAUDRATE;
  return can->open ? CO_ERROR_NO : CO_ERROR_ILLEGAL_ARGUMENT;
}

void CO_CANmodule_disable(CO_CANmodule_t *module) {
  if (module == NULL || module->CANptr == NULL) return;
  co_verican_t *can = module->CANptr;
  if (!can->open) return;
  module->CANnormal = false;
  /* If it does not stop it goes on, with the stack out of it, until CO_CANmodule_init() resets it.
   */
  (void)verican_deinit(&can->device);
  can->open = false;
}

/* Whether the module is open or not: a core that could not be stopped still interrupts. */
void co_verican_interrupt(co_verican_t *can) { (void)verican_irq_handler(&can->device); }

/* ---- Errors ---------------------------------------------------------------------------------- */

static uint16_t level_bits(uint8_t counter, uint16_t warning, uint16_t passive) {
  uint16_t bits = 0;
  if (counter >= WARNING_LEVEL) bits |= warning;
  if (counter >= PASSIVE_LEVEL) bits |= passive;
  return bits;
}

static uint16_t error_bits(const verican_status_t *status) {
  if (status->state == VERICAN_STATE_BUS_OFF || status->state == VERICAN_STATE_STOPPED)
    return CO_CAN_ERRTX_BUS_OFF;
  return (uint16_t)(level_bits(status->tec, CO_CAN_ERRTX_WARNING, CO_CAN_ERRTX_PASSIVE) |
                    level_bits(status->rec, CO_CAN_ERRRX_WARNING, CO_CAN_ERRRX_PASSIVE));
}

/* Only a stopped device takes filters. Frames that come meanwhile are missed, so nothing of ours
 * may be under way, and nothing is done unless the stack has changed a buffer. One that does not
 * start again, and is told as off the bus, is still stopped the next time. */
static void renew_filters(co_verican_t *can) {
  uint8_t waiting = 0;
  if (!can->filters_changed || verican_tx_waiting(&can->device, &waiting) != VERICAN_OK) return;
  if (waiting != 0u) return;
  const verican_result_t stopped = verican_stop(&can->device);
  if (stopped != VERICAN_OK && stopped != VERICAN_ERR_STATE) return;
  (void)set_filters(can);
  if (verican_start(&can->device) == VERICAN_OK)
    co_verican_send_waiting(can->module);
  else
    can->filters_changed = true;
}

void CO_CANmodule_process(CO_CANmodule_t *module) {
  if (module == NULL || !module->CANnormal) return;
  co_verican_t *can = module->CANptr;
  verican_status_t status;
  (void)verican_poll(&can->device, can->now_ms());
  if (verican_get_status(&can->device, &status) != VERICAN_OK) return;
  CO_LOCK_CAN_SEND(module);
  uint16_t bits = error_bits(&status);
  const uint32_t lost = status.stats.rx_dropped + status.stats.rx_overruns;
  if (lost != can->lost) bits |= CO_CAN_ERRRX_OVERFLOW;
  can->lost = lost;
  module->CANerrorStatus = bits | can->tx_errors;
  /* Told once at least, and for as long as frames wait. */
  if (module->CANtxCount == 0u) can->tx_errors = 0;
  renew_filters(can);
  CO_UNLOCK_CAN_SEND(module);
}

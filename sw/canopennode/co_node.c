/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A CANopen device: see co_node.h.
 */
#include "co_node.h"

#include "OD.h"

enum { FIRST_HEARTBEAT_MS = 100, SDO_SERVER_TIMEOUT_MS = 1000, SDO_CLIENT_TIMEOUT_MS = 500 };

static void request(void *object) {
  co_node_t *node = object;
  ++node->requests;
  node->board.request();
}

/* SYNC and synchronous PDOs are the real-time part's business, at once. */
static void connect_real_time(co_node_t *node) {
  CO_SYNC_initCallbackPre(node->co->SYNC, node, request);
  for (unsigned i = 0; i < OD_CNT_RPDO; ++i)
    CO_RPDO_initCallbackPre(&node->co->RPDO[i], node, request);
}

static bool_t store_lss(void *object, uint8_t id, uint16_t kbit) {
  co_node_t *node = object;
  return node->hooks.store_lss != NULL && node->hooks.store_lss(node, id, kbit);
}

/* What the core's clock can make; 0 is automatic detection, which there is none of. */
static bool_t check_bit_rate(void *object, uint16_t kbit) {
  const co_node_t *node = object;
  verican_timing_t timing;
  return kbit != 0 &&
         verican_timing_find(node->can.clock_hz, kbit * 1000u, 0, &timing) == VERICAN_OK;
}

static CO_ReturnError_t init_lss(co_node_t *node) {
  const CO_ReturnError_t result =
      CO_LSSinit(node->co, &node->identity, &node->node_id, &node->kbit);
  if (result != CO_ERROR_NO) return result;
  CO_LSSslave_initCfgStoreCall(node->co->LSSslave, node, store_lss);
  CO_LSSslave_initCkBitRateCall(node->co->LSSslave, node, check_bit_rate);
  node->active_id = node->node_id;
  return CO_ERROR_NO;
}

/* A device without a node-ID has LSS only. */
static bool failed(CO_ReturnError_t result) {
  return result != CO_ERROR_NO && result != CO_ERROR_NODE_ID_UNCONFIGURED_LSS;
}

static CO_ReturnError_t set_up(co_node_t *node, uint32_t *info) {
  CO_t *co = node->co;
  CO_CANsetConfigurationMode(&node->can);
  if (co->CANmodule->CANptr != NULL) CO_CANmodule_disable(co->CANmodule);
  CO_ReturnError_t result = CO_CANinit(co, &node->can, node->kbit);
  if (result == CO_ERROR_NO) result = init_lss(node);
  if (result != CO_ERROR_NO) return result;
  result =
      CO_CANopenInit(co, NULL, NULL, node->od, NULL, node->nmt_control, FIRST_HEARTBEAT_MS,
                     SDO_SERVER_TIMEOUT_MS, SDO_CLIENT_TIMEOUT_MS, false, node->active_id, info);
  if (failed(result)) return result;
  result = CO_CANopenInitPDO(co, co->em, node->od, node->active_id, info);
  if (failed(result)) return result;
  if (!co->nodeIdUnconfigured) connect_real_time(node);
  if (node->hooks.on_reset != NULL) node->hooks.on_reset(node);
  return CO_ERROR_NO;
}

static void show_leds(co_node_t *node) {
  const bool green = CO_LED_GREEN(node->co->LEDs, CO_LED_CANopen) != 0;
  const bool red = CO_LED_RED(node->co->LEDs, CO_LED_CANopen) != 0;
  if (green == node->leds[0] && red == node->leds[1]) return;
  node->leds[0] = green;
  node->leds[1] = red;
  if (node->hooks.on_leds != NULL) node->hooks.on_leds(node, green, red);
}

static uint32_t elapsed(const co_node_t *node, uint32_t *last) {
  const uint32_t now = node->board.time_us();
  const uint32_t since = now - *last;
  *last = now;
  return since;
}

static CO_NMT_reset_cmd_t loop(co_node_t *node) {
  CO_NMT_reset_cmd_t reset = CO_RESET_NOT;
  while (reset == CO_RESET_NOT) {
    reset = CO_process(node->co, false, elapsed(node, &node->main_us), NULL);
    show_leds(node);
    if (node->hooks.on_loop != NULL) node->hooks.on_loop(node);
    if (reset == CO_RESET_NOT) node->board.wait(node);
  }
  return reset;
}

CO_ReturnError_t co_node_run(co_node_t *node, uint32_t *info) {
  CO_NMT_reset_cmd_t reset = CO_RESET_NOT;
  if (node->co == NULL) node->co = CO_new(NULL, NULL);
  if (node->co == NULL) return CO_ERROR_OUT_OF_MEMORY;
  while (reset != CO_RESET_APP) {
    node->running = false;
    const CO_ReturnError_t result = set_up(node, info);
    if (result != CO_ERROR_NO) return result;
    node->main_us = node->real_time_us = node->board.time_us();
    CO_CANsetNormalMode(node->co->CANmodule);
    if (!node->co->CANmodule->CANnormal) return CO_ERROR_INVALID_STATE;
    node->running = true;
    reset = loop(node);
  }
  node->running = false;
  CO_CANmodule_disable(node->co->CANmodule);
  return CO_ERROR_NO;
}

void co_node_real_time(co_node_t *node) {
  if (!node->running || node->co->nodeIdUnconfigured || !node->co->CANmodule->CANnormal) return;
  const uint32_t since = elapsed(node, &node->real_time_us);
  const bool sync = CO_process_SYNC(node->co, since, NULL);
  CO_process_RPDO(node->co, sync, since, NULL);
  if (node->hooks.on_real_time != NULL) node->hooks.on_real_time(node, sync, since);
  CO_process_TPDO(node->co, sync, since, NULL);
}

void co_node_can_interrupt(co_node_t *node) {
  const uint32_t before = node->can.handed_on - node->requests;
  co_verican_interrupt(&node->can);
  if (node->can.handed_on - node->requests != before) node->work = true;
}

bool co_node_work(co_node_t *node) {
  const bool work = node->work;
  node->work = false;
  return work;
}

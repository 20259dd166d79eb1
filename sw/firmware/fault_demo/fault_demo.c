/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * fault_demo: sends a frame every millisecond and prints each change of the error state. The faults
 * are the scenario's. It goes through bus-off twice: first the core recovers by itself, then the
 * driver does it five milliseconds later.
 */
#include "can.h"
#include "semihost.h"

enum { BITRATE = 500000, TICK_US = 1000, BEAT_ID = 0x055, DELAY_MS = 5, LIMIT_MS = 60 };

static can_t can;
static volatile uint32_t now_ms;
static volatile unsigned bus_offs, recoveries;
static volatile verican_state_t state;

static const char *state_name(verican_state_t value) {
  static const char *const names[] = {"stopped", "error active", "warning", "error passive",
                                      "bus-off"};
  return names[value];
}

static void on_state(void *user, verican_t *device, verican_state_t next) {
  (void)user;
  (void)device;
  semihost_printf("%u us: %s\n", (unsigned)semihost_microseconds(), state_name(next));
  if (next == VERICAN_STATE_BUS_OFF) ++bus_offs;
  if (state == VERICAN_STATE_BUS_OFF && next == VERICAN_STATE_ACTIVE) ++recoveries;
  state = next;
}

void can0_handler(void) { verican_irq_handler(&can.device); }

void systick_handler(void) {
  ++now_ms;
  verican_poll(&can.device, now_ms);
}

static void begin(verican_bus_off_policy_t policy) {
  verican_config_t config = can_config(&can, 0, BITRATE);
  config.bus_off = policy;
  config.bus_off_delay_ms = DELAY_MS;
  config.callbacks.on_state = on_state;
  can_open(&can, &config, NULL, 0);
  can_start(&can, 0);
}

/** One frame a millisecond until the node has been off the bus and is back. */
static bool beat_until_recovered(unsigned wanted) {
  const verican_frame_t frame = {.id = BEAT_ID, .dlc = 2, .data = {0x55, 0xAA}};
  uint32_t last = now_ms;
  while (recoveries < wanted) {
    if (now_ms - last > LIMIT_MS) return false;
    board_wait();
    uint8_t waiting;
    can_check(verican_tx_waiting(&can.device, &waiting), "transmission");
    if (waiting == 0 && state != VERICAN_STATE_BUS_OFF)
      can_check(verican_send(&can.device, &frame, NULL), "send");
  }
  return true;
}

int main(void) {
  semihost_print("recovery by the core\n");
  begin(VERICAN_BUS_OFF_AUTOMATIC);
  board_systick_start(TICK_US);
  bool good = beat_until_recovered(1);
  board_irq_off();
  can_check(verican_deinit(&can.device), "end");
  semihost_printf("recovery by the driver after %u ms\n", DELAY_MS);
  begin(VERICAN_BUS_OFF_DELAYED);
  board_irq_on();
  good = good && beat_until_recovered(2);
  semihost_printf("%u times off the bus, %u times back\n", bus_offs, recoveries);
  return good && bus_offs == 2 ? 0 : 1;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The steps that every example takes with the driver.
 */
#include "can.h"

#include "semihost.h"

void can_check(verican_result_t result, const char *what) {
  if (result == VERICAN_OK) return;
  semihost_printf("%s: %s\n", what, verican_result_name(result));
  semihost_exit(1);
}

verican_config_t can_config(can_t *can, unsigned core, uint32_t bitrate) {
  verican_config_t config;
  can_check(verican_config_default(&config), "default settings");
  board_can_port(&config.port, core);
  config.clock_hz = BOARD_CLOCK_HZ;
  config.bitrate = bitrate;
  config.rx_ring = can->ring;
  config.rx_ring_size = CAN_RING;
  return config;
}

void can_open(can_t *can, const verican_config_t *config, const verican_filter_t *filters,
              uint16_t filter_count) {
  can_check(verican_init(&can->device, config), "initialisation");
  if (filters != NULL)
    can_check(verican_set_filters(&can->device, filters, filter_count), "filters");
}

void can_start(can_t *can, unsigned core) {
  can_check(verican_start(&can->device), "start");
  board_irq_enable(core == 0 ? BOARD_IRQ_CAN0 : BOARD_IRQ_CAN1, 4);
}

void can_send(can_t *can, const verican_frame_t *frame) {
  for (;;) {
    board_irq_off();
    const verican_result_t result = verican_send(&can->device, frame, NULL);
    if (result == VERICAN_ERR_BUSY) board_wait();
    board_irq_on();
    if (result == VERICAN_ERR_BUSY) continue;
    return can_check(result, "send");
  }
}

bool can_receive(can_t *can, verican_frame_t *frame, uint32_t microseconds) {
  const uint32_t begin = microseconds == 0 ? 0 : semihost_microseconds();
  for (;;) {
    // Masked, so that no interrupt can come between the look and the sleep.
    board_irq_off();
    const verican_result_t result = verican_receive(&can->device, frame);
    if (result == VERICAN_ERR_EMPTY) board_wait();
    board_irq_on();
    if (result == VERICAN_OK) return true;
    if (result != VERICAN_ERR_EMPTY) can_check(result, "receive");
    if (microseconds != 0 && semihost_microseconds() - begin > microseconds) return false;
  }
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "echo.h"

static verican_t can;
static verican_frame_t ring[16];

verican_result_t echo_start(const verican_port_t *port, uint32_t clock_hz) {
  verican_config_t config;
  verican_result_t result = verican_config_default(&config);
  if (result != VERICAN_OK) return result;
  config.port = *port;
  config.clock_hz = clock_hz;
  config.bitrate = 500000;
  config.rx_ring = ring;
  config.rx_ring_size = sizeof ring / sizeof ring[0];
  result = verican_init(&can, &config);
  return result == VERICAN_OK ? verican_start(&can) : result;
}

void echo_interrupt(void) { (void)verican_irq_handler(&can); }

unsigned echo_work(void) {
  verican_frame_t frame;
  unsigned answers = 0;
  while (verican_receive(&can, &frame) == VERICAN_OK) {
    frame.id += 1;
    if (verican_send(&can, &frame, NULL) == VERICAN_OK) ++answers;
  }
  return answers;
}

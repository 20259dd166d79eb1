/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * pong: answers each frame 100 with a frame 101 that holds the inverted data. It ends after a frame
 * without data, which it answers, too.
 */
#include "can.h"
#include "semihost.h"

enum { PING_ID = 0x100, PONG_ID = 0x101, BITRATE = 500000 };

static can_t can;

void can0_handler(void) { verican_irq_handler(&can.device); }

int main(void) {
  const verican_filter_t pings = {
      .id = PING_ID, .mask = 0x7FF, .ide = VERICAN_SELECT_ONLY_0, .rtr = VERICAN_SELECT_ONLY_0};
  const verican_config_t config = can_config(&can, 0, BITRATE);
  can_open(&can, &config, &pings, 1);
  can_start(&can, 0);
  unsigned answers = 0;
  verican_frame_t frame;
  do {
    can_receive(&can, &frame, 0);
    frame.id = PONG_ID;
    for (unsigned i = 0; i < frame.dlc; ++i) frame.data[i] = (uint8_t)~frame.data[i];
    can_send(&can, &frame);
    ++answers;
  } while (frame.dlc != 0);
  uint8_t waiting;
  do {
    can_check(verican_tx_waiting(&can.device, &waiting), "transmission");
  } while (waiting != 0);
  semihost_printf("%u answers\n", answers);
  return 0;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The partner of check.c, on the project's own driver: answers data frames by inverted data under
 * the identifier with ANSWER, remote frames by data, and an order by a burst.
 */
#include "can.h"
#include "partner.h"
#include "semihost.h"

static can_t can;

void can0_handler(void) { verican_irq_handler(&can.device); }

static verican_frame_t answer_to(const verican_frame_t *frame) {
  verican_frame_t answer = *frame;
  const bool remote = (frame->flags & VERICAN_FRAME_REMOTE) != 0u;
  answer.flags &= (uint8_t)~VERICAN_FRAME_REMOTE;
  if (!remote) answer.id |= ANSWER;
  for (unsigned i = 0; i < frame->dlc && i < 8u; ++i)
    answer.data[i] = (uint8_t)(remote ? REMOTE_BYTE(i) : INVERTED ^ frame->data[i]);
  return answer;
}

static void burst(unsigned count, uint32_t delay_us) {
  const uint32_t begin = semihost_microseconds();
  while (semihost_microseconds() - begin < delay_us) {
  }
  for (unsigned n = 0; n < count; ++n) {
    const verican_frame_t frame = {.id = BURST_ID, .dlc = 1, .data = {(uint8_t)n}};
    can_send(&can, &frame);
  }
}

int main(void) {
  enum { FOREVER_US = 1000000 };
  const verican_config_t config = can_config(&can, 0, 500000);
  can_open(&can, &config, NULL, 0);
  can_start(&can, 0);
  verican_frame_t frame;
  while (can_receive(&can, &frame, FOREVER_US)) {
    if (frame.flags == 0u && frame.id == END_ID) return 0;
    if (frame.flags == 0u && frame.id == ORDER_ID) {
      burst(frame.data[0], 1000u * frame.data[1]);
    } else {
      const verican_frame_t answer = answer_to(&frame);
      can_send(&can, &answer);
    }
  }
  return 1;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * ping: sends ten frames, waits for the answer to each, and prints how long it took. A frame
 * without data ends the other side (pong).
 */
#include <stdbool.h>

#include "can.h"
#include "semihost.h"

enum {
  PING_ID = 0x100,
  PONG_ID = 0x101,
  PINGS = 10,
  TIMEOUT_US = 20000,
  TICK_US = 1000,
  PAUSE_MS = 5
};
enum { BITRATE = 500000 };

static can_t can;

static volatile unsigned ticks;  // they wake the program up, so that it sees a timeout

void can0_handler(void) { verican_irq_handler(&can.device); }
void systick_handler(void) { ++ticks; }

static bool is_answer(const verican_frame_t *ping, const verican_frame_t *answer) {
  if (answer->id != PONG_ID || answer->dlc != ping->dlc) return false;
  for (unsigned i = 0; i < ping->dlc; ++i)
    if ((answer->data[i] ^ ping->data[i]) != 0xFF) return false;
  return true;
}

static bool ping(uint8_t number) {
  verican_frame_t frame = {.id = PING_ID, .dlc = 8}, answer;
  for (uint8_t i = 0; i < 8; ++i) frame.data[i] = (uint8_t)(number + 17u * i);
  const uint32_t begin = semihost_microseconds();
  can_send(&can, &frame);
  if (!can_receive(&can, &answer, TIMEOUT_US)) {
    semihost_printf("ping %u: no answer\n", number);
    return false;
  }
  if (!is_answer(&frame, &answer)) {
    semihost_printf("ping %u: wrong answer %03x#%02x...\n", number, (unsigned)answer.id,
                    answer.data[0]);
    return false;
  }
  semihost_printf("ping %u: answer after %u us\n", number,
                  (unsigned)(semihost_microseconds() - begin));
  return true;
}

int main(void) {
  const verican_filter_t pongs = {
      .id = PONG_ID, .mask = 0x7FF, .ide = VERICAN_SELECT_ONLY_0, .rtr = VERICAN_SELECT_ONLY_0};
  const verican_config_t config = can_config(&can, 0, BITRATE);
  can_open(&can, &config, &pongs, 1);
  can_start(&can, 0);
  board_systick_start(TICK_US);
  while (ticks < PAUSE_MS) board_wait();  // the other side gets ready
  unsigned failures = 0;
  for (uint8_t n = 0; n < PINGS; ++n)
    if (!ping(n)) ++failures;
  const verican_frame_t end = {.id = PING_ID, .dlc = 0};
  can_send(&can, &end);
  verican_frame_t answer;
  if (!can_receive(&can, &answer, TIMEOUT_US)) ++failures;
  semihost_printf("%u pings, %u failed\n", PINGS, failures);
  return failures == 0 ? 0 : 1;
}

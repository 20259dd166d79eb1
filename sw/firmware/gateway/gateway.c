/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * gateway: forwards between two buses of different speed. Identifiers 100 to 1FF go from left (core
 * 0, 500 kbit/s) to right (core 1, 250 kbit/s), 200 to 2FF the other way; the cores' filters keep
 * everything else out. Frame 7FF on the left ends the program.
 */
#include "can.h"
#include "semihost.h"

enum { LEFT = 0, RIGHT = 1, SIDES = 2 };
enum { LEFT_BITRATE = 500000, RIGHT_BITRATE = 250000, STOP_ID = 0x7FF };

static can_t sides[SIDES];

void can0_handler(void) { verican_irq_handler(&sides[LEFT].device); }
void can1_handler(void) { verican_irq_handler(&sides[RIGHT].device); }

static void open_side(unsigned side, uint32_t bitrate, const verican_filter_t *filters,
                      uint16_t count) {
  verican_config_t config = can_config(&sides[side], side, bitrate);
  config.tx_order = VERICAN_TX_IN_ORDER; /* or frames of one identifier could change places */
  can_open(&sides[side], &config, filters, count);
}

/** Moves one frame, if there is one; false for the frame that ends the program. */
static bool forward(unsigned from, unsigned to, unsigned *forwarded, bool *idle) {
  verican_frame_t frame;
  const verican_result_t result = verican_receive(&sides[from].device, &frame);
  if (result == VERICAN_ERR_EMPTY) return true;
  can_check(result, "receive");
  *idle = false;
  if (frame.id == STOP_ID) return false;
  board_irq_on();
  can_send(&sides[to], &frame);
  board_irq_off();
  ++*forwarded;
  return true;
}

static void wait_until_sent(unsigned side) {
  uint8_t waiting;
  do {
    can_check(verican_tx_waiting(&sides[side].device, &waiting), "transmission");
  } while (waiting != 0);
}

int main(void) {
  const verican_filter_t left[] = {{0x100, 0x700, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_ONLY_0},
                                   {STOP_ID, 0x7FF, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_ONLY_0}};
  const verican_filter_t right[] = {{0x200, 0x700, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_ONLY_0}};
  open_side(LEFT, LEFT_BITRATE, left, 2);
  open_side(RIGHT, RIGHT_BITRATE, right, 1);
  can_start(&sides[LEFT], LEFT);
  can_start(&sides[RIGHT], RIGHT);

  unsigned forwarded[SIDES] = {0, 0};
  bool running = true;
  while (running) {
    bool idle = true;
    board_irq_off();
    running = forward(LEFT, RIGHT, &forwarded[LEFT], &idle) &&
              forward(RIGHT, LEFT, &forwarded[RIGHT], &idle);
    if (running && idle) board_wait();
    board_irq_on();
  }
  wait_until_sent(LEFT);
  wait_until_sent(RIGHT);

  unsigned lost = 0;
  for (unsigned side = 0; side < SIDES; ++side) {
    verican_status_t status;
    can_check(verican_get_status(&sides[side].device, &status), "status");
    lost += status.stats.rx_dropped + status.stats.rx_overruns;
  }
  semihost_printf("left to right %u, right to left %u, lost %u\n", forwarded[LEFT],
                  forwarded[RIGHT], lost);
  return lost == 0 ? 0 : 1;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * sae_sender: the SAE class-C set from one node, for 200 ms. Each message has a mailbox of its own;
 * the timer's handler fills those that are due, the core sends the smallest identifier first. Data
 * byte 0 counts the frames of its message.
 */
#include "can.h"
#include "sae_table.h"
#include "semihost.h"

enum { BITRATE = 500000, TICK_US = 1000, RUN_MS = 200, MAILBOXES = 64 };
enum { FIRST_TX = MAILBOXES - SAE_MESSAGES };

static can_t can;
static uint8_t counters[SAE_MESSAGES];
static volatile unsigned queued, missed;
static volatile uint32_t now_ms;

void can0_handler(void) { verican_irq_handler(&can.device); }

/** Queues a message; it has missed its turn if the one before it is still waiting. */
static void queue(unsigned number) {
  verican_frame_t frame = {.id = sae_table[number].id, .dlc = sae_table[number].bytes};
  frame.data[0] = counters[number]++;
  const verican_result_t result =
      verican_send_in(&can.device, &frame, (uint8_t)(FIRST_TX + number));
  if (result == VERICAN_ERR_BUSY) {
    ++missed;
    return;
  }
  can_check(result, "send");
  ++queued;
}

void systick_handler(void) {
  if (now_ms < RUN_MS)
    for (unsigned i = 0; i < SAE_MESSAGES; ++i)
      if (now_ms % sae_table[i].period_ms == 0) queue(i);
  ++now_ms;
}

int main(void) {
  verican_config_t config = can_config(&can, 0, BITRATE);
  config.mailboxes = MAILBOXES;
  config.tx_mailboxes = SAE_MESSAGES;
  can_open(&can, &config, NULL, 0);
  can_start(&can, 0);
  board_systick_start(TICK_US);
  uint8_t waiting = 0;
  while (now_ms < RUN_MS || waiting != 0) {
    board_wait();
    can_check(verican_tx_waiting(&can.device, &waiting), "transmission");
  }
  verican_status_t status;
  can_check(verican_get_status(&can.device, &status), "status");
  semihost_printf("%u messages, %u frames queued, %u sent, %u missed their turn\n", SAE_MESSAGES,
                  queued, (unsigned)status.stats.sent, missed);
  return missed == 0 && status.stats.sent == queued ? 0 : 1;
}

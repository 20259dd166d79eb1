/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The time of board_systick_us() in PendSV, which goes before a SysTick that waits with it, and
 * with interrupts masked, at changing moments of the period: it never goes back.
 */
#include "board.h"
#include "semihost.h"

#define SCB_ICSR (*(volatile uint32_t *)0xE000ED04u)
#define ICSR_PENDSVSET (1u << 28)
#define SCB_SHPR3_PENDSV (*(volatile uint8_t *)0xE000ED22u)

enum { TICK_US = 100, TICKS = 500, LONGEST_US = TICK_US };

static volatile uint32_t ticks, reads, wrong, waited;
static uint32_t last;

void systick_handler(void) { ++ticks; }

static void look(void) {
  const uint32_t before = ticks;
  const uint32_t now = board_systick_us(&ticks, TICK_US);
  ++reads;
  if (now / TICK_US > before) ++waited;
  if (now - last > LONGEST_US) ++wrong;
  last = now;
}

void pendsv_handler(void);
void pendsv_handler(void) { look(); }

int main(void) {
  uint32_t dice = 1;
  SCB_SHPR3_PENDSV = 0xFFu;
  board_systick_start(TICK_US);
  while (ticks < TICKS) {
    dice = dice * 1664525u + 1013904223u;
    for (volatile uint32_t i = 0; i < dice >> 26; ++i) {
    }
    board_irq_off();
    look();
    for (volatile uint32_t i = 0; i < 20; ++i) {
    }
    look();
    SCB_ICSR = ICSR_PENDSVSET;
    board_irq_on();
  }
  semihost_printf("%u reads, %u of them with SysTick waiting, %u wrong\n", (unsigned)reads,
                  (unsigned)waited, (unsigned)wrong);
  return wrong == 0u && waited > 10u ? 0 : 1;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From reset to main(): vector table, memory, exit code. Exceptions without a handler stop the
 * program with a breakpoint.
 */
#include <stdint.h>

#include "board.h"
#include "semihost.h"

extern uint32_t data_begin, data_end, data_load, bss_begin, bss_end, stack_top;

int main(void);
void reset_handler(void);

#define SCB_CCR (*(volatile uint32_t *)0xE000ED14u)
#define CCR_STKALIGN 0x200u /* off after reset in this revision of the CPU; the ABI wants it */

static void unexpected(void) {
  for (;;) __asm__ volatile("bkpt 0");
}

void nmi_handler(void) __attribute__((weak, alias("unexpected")));
void hard_fault_handler(void) __attribute__((weak, alias("unexpected")));
void svc_handler(void) __attribute__((weak, alias("unexpected")));
void pendsv_handler(void) __attribute__((weak, alias("unexpected")));
void systick_handler(void) __attribute__((weak, alias("unexpected")));
void can0_handler(void) __attribute__((weak, alias("unexpected")));
void can1_handler(void) __attribute__((weak, alias("unexpected")));

typedef void (*vector_t)(void);

#define IRQ(n) (16u + (n))

__attribute__((section(".vectors"),
               used)) static const vector_t vectors[IRQ(BOARD_IRQ_CAN1) + 1] = {
    [0] = (vector_t)(uintptr_t)&stack_top,
    [1] = reset_handler,
    [2] = nmi_handler,
    [3] = hard_fault_handler,
    [4 ... 10] = unexpected,
    [11] = svc_handler,
    [12 ... 13] = unexpected,
    [14] = pendsv_handler,
    [15] = systick_handler,
    [16 ... IRQ(BOARD_IRQ_CAN0) - 1] = unexpected,
    [IRQ(BOARD_IRQ_CAN0)] = can0_handler,
    [IRQ(BOARD_IRQ_CAN1)] = can1_handler,
};

void reset_handler(void) {
  const uint32_t *from = &data_load;
  for (uint32_t *to = &data_begin; to < &data_end;) *to++ = *from++;
  for (uint32_t *to = &bss_begin; to < &bss_end;) *to++ = 0;
  SCB_CCR |= CCR_STKALIGN;
  semihost_exit(main());
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * NVIC, SysTick, and the driver's way to the cores.
 */
#include "board.h"

#define NVIC_ISER ((volatile uint32_t *)0xE000E100u)
#define NVIC_IPR ((volatile uint8_t *)0xE000E400u)
#define SCB_SHPR3_SYSTICK (*(volatile uint8_t *)0xE000ED23u)
#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)

#define SCB_ICSR (*(volatile uint32_t *)0xE000ED04u)
#define ICSR_PENDSTSET (1u << 26)
#define CLOCKS_PER_US (BOARD_CLOCK_HZ / 1000000u)

#define PRIORITY_SHIFT 3u /* the A2F500 has the upper five bits of a priority */
#define SYST_RUN 7u       /* CPU clock, interrupt, enable */

static uint32_t lock_irq(void *context) {
  uint32_t primask;
  (void)context;
  __asm__ volatile("mrs %0, primask\n\tcpsid i" : "=r"(primask)::"memory");
  return primask;
}

static void unlock_irq(void *context, uint32_t primask) {
  (void)context;
  __asm__ volatile("msr primask, %0" ::"r"(primask) : "memory");
}

void board_can_port(verican_port_t *port, unsigned core) {
  *port = (verican_port_t){0};
  port->base = (volatile uint32_t *)(uintptr_t)(BOARD_CAN_BASE + core * BOARD_CAN_STRIDE);
  port->lock = lock_irq;
  port->unlock = unlock_irq;
}

void board_irq_enable(unsigned irq, unsigned priority) {
  NVIC_IPR[irq] = (uint8_t)(priority << PRIORITY_SHIFT);
  NVIC_ISER[irq / 32u] = 1u << (irq % 32u);
}

void board_systick_start(uint32_t microseconds) {
  SCB_SHPR3_SYSTICK = 0xFFu;
  SYST_RVR = CLOCKS_PER_US * microseconds - 1u;
  SYST_CVR = 0;
  SYST_CSR = SYST_RUN;
}

/* Two things may have happened to a counter that has begun anew: its handler has run meanwhile, or
 * could not yet, for interrupts are masked, or this is a handler that is not less urgent. Then the
 * exception waits, and what was read of the counter may still be of the period before. */
uint32_t board_systick_us(const volatile uint32_t *periods, uint32_t microseconds) {
  uint32_t passed, left;
  bool waits;
  do {
    passed = *periods;
    left = SYST_CVR;
    waits = (SCB_ICSR & ICSR_PENDSTSET) != 0u;
    if (waits) left = SYST_CVR;
  } while (passed != *periods);
  if (waits) ++passed;
  return passed * microseconds + (microseconds - 1u - left / CLOCKS_PER_US);
}

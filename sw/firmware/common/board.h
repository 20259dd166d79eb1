/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The SmartFusion A2F500 as these examples use it: addresses, interrupts, and the few system
 * registers of the Cortex-M3.
 */
#ifndef FIRMWARE_BOARD_H
#define FIRMWARE_BOARD_H

#include <stdbool.h>
#include <stdint.h>

#include "verican/verican.h"

/** CAN cores behind the fabric interface. */
#define BOARD_CAN_BASE 0x40050000u
#define BOARD_CAN_STRIDE 0x2000u
#define BOARD_CAN_CORES 2u

/** Interrupts of the NVIC: the fabric interrupt is the first core's, GPIO 0 the second one's. */
#define BOARD_IRQ_CAN0 31u
#define BOARD_IRQ_CAN1 32u

/** Clock of CPU and cores, Hz. The scenario's node must have the same. */
#ifndef BOARD_CLOCK_HZ
#define BOARD_CLOCK_HZ 32000000u
#endif

/** Handlers that a program may define; the others stop the program. */
void systick_handler(void);
void can0_handler(void);
void can1_handler(void);

/** Fills in how the driver reaches core 0 or 1: pointer access, interrupts masked by PRIMASK. */
void board_can_port(verican_port_t *port, unsigned core);

/** Enables an interrupt at a priority, 0 (most urgent) to 31. */
void board_irq_enable(unsigned irq, unsigned priority);

/**
 * Starts SysTick: systick_handler() runs every `microseconds`, at the least urgent priority. From 2
 * to 2^24 clocks, which are 524 ms at 32 MHz; of BOARD_CLOCK_HZ whole MHz count.
 */
void board_systick_start(uint32_t microseconds);

/**
 * The time in us, modulo 2^32, between interrupts of board_systick_start(microseconds) too;
 * `periods` is what systick_handler() counts up. In any context, with interrupts masked for less
 * than a period.
 */
uint32_t board_systick_us(const volatile uint32_t *periods, uint32_t microseconds);

/** Sleeps until an interrupt; returns at once if one is pending, even while interrupts are masked.
 */
static inline void board_wait(void) { __asm__ volatile("wfi" ::: "memory"); }

/** Masks and unmasks all interrupts. */
static inline void board_irq_off(void) { __asm__ volatile("cpsid i" ::: "memory"); }
static inline void board_irq_on(void) { __asm__ volatile("cpsie i" ::: "memory"); }

#endif /* FIRMWARE_BOARD_H */

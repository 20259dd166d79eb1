/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * servo_cost: what a pair costs the servo, in clocks of the CPU, for each filter (TM-90). The clock
 * that is steered is this program's own: 16 MHz, 80 ppm fast, stamps to 62 ns, a pair a second.
 */
#include <stdint.h>

#include "semihost.h"
#include "verican/servo.h"

enum { PAIRS = 64, DRIFT_PPM = 80, TICK_NS = 62 };
#define CLOCK_HZ 16000000u
#define NOMINAL (((uint64_t)1000000000 << 32) / CLOCK_HZ) /* 2^-32 ns a clock */
#define SECOND 1000000000u

/* SysTick counts down with every clock; 24 bits. */
static volatile uint32_t *const systick = (volatile uint32_t *)0xE000E010u;
static void start_counter(void) {
  systick[1] = 0xFFFFFFu;
  systick[2] = 0;
  systick[0] = 5;
}
static uint32_t counter(void) { return systick[2]; }

typedef struct cost {
  uint32_t sum, most;
} cost_t;

/* The own clock: its time in ns with its fraction, and what it adds each clock. */
typedef struct steered {
  uint64_t ns, increment;
} steered_t;

/* A second of the master's: 80 ppm more clocks than the nominal ones. */
static void pass_second(steered_t *clock) {
  const uint32_t clocks = CLOCK_HZ + CLOCK_HZ / 1000000u * DRIFT_PPM;
  clock->ns += (clocks * (clock->increment >> 8)) >> 24;
}

static void take(verican_servo_t *servo, steered_t *clock, uint64_t master, unsigned number,
                 cost_t *cost) {
  const uint64_t noise = number * 37u % TICK_NS;
  const verican_sync_pair_t pair = {.local = clock->ns + noise,
                                    .master = master,
                                    .now = clock->ns + 2000000u,
                                    .increment = clock->increment,
                                    .latency = 3};
  verican_correction_t correction;
  const uint32_t begin = counter();
  (void)verican_servo_pair(servo, &pair, &correction);
  const uint32_t clocks = (begin - counter()) & 0xFFFFFFu;
  cost->sum += clocks;
  if (clocks > cost->most) cost->most = clocks;
  clock->ns += (uint64_t)correction.shift;
  clock->increment = correction.increment;
}

static void measure(uint8_t filter) {
  verican_servo_config_t config;
  static verican_servo_t servo;
  cost_t cost = {0, 0};
  steered_t clock = {.ns = 7 * (uint64_t)SECOND, .increment = NOMINAL};
  verican_servo_config_default(&config);
  config.filter = filter;
  verican_servo_init(&servo, &config);
  uint64_t master = 5 * (uint64_t)SECOND;
  for (unsigned i = 0; i < PAIRS; ++i) {
    take(&servo, &clock, master, i, &cost);
    master += SECOND;
    pass_second(&clock);
  }
  const int64_t off = (int64_t)(clock.ns - master);
  semihost_printf("filter %u: %u clocks a pair, at most %u; state %u, %d ns off\n", filter,
                  (unsigned)(cost.sum / PAIRS), (unsigned)cost.most, servo.state, (int)off);
}

int main(void) {
  static const uint8_t filters[] = {1, 2, 4, 8, 16, 0};
  start_counter();
  for (unsigned i = 0; i < sizeof filters; ++i) measure(filters[i]);
  return 0;
}

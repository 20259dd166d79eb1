/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Critical sections of the port of CANopenNode, with a lock of one enable bit that masks the core's
 * interrupt alone: within each other, and interrupted by a less urgent interrupt that has sections
 * too. Needs no CANopenNode.
 */
#include <stdio.h>
#include <stdlib.h>

#include "CO_driver_target.h"

static co_verican_t can;
static CO_CANmodule_t module;
static bool enabled;
static int taken;               /* locks without their unlock: some locks count */
static int steps, interrupt_at; /* the step at which the interrupt comes; -1: never */
static unsigned failures;

#define CHECK(condition)                                                                \
  do {                                                                                  \
    if (condition) break;                                                               \
    ++failures;                                                                         \
    printf("line %d, step %d: %s does not hold\n", __LINE__, interrupt_at, #condition); \
  } while (0)

static void sections(void);

/* A place at which the less urgent interrupt may come. */
static void step(void) {
  if (steps++ != interrupt_at) return;
  const bool was = enabled;
  sections();
  CHECK(enabled == was);
}

static uint32_t lock(void *context) {
  (void)context;
  step();
  const uint32_t was = enabled;
  enabled = false;
  ++taken;
  step();
  return was;
}

static void unlock(void *context, uint32_t token) {
  (void)context;
  step();
  enabled = token != 0u;
  --taken;
  step();
}

/* One after the other, within each other, and across each other. */
static void sections(void) {
  CO_LOCK_CAN_SEND(&module);
  CHECK(!enabled);
  step();
  CO_UNLOCK_CAN_SEND(&module);
  CO_LOCK_OD(&module);
  step();
  CO_LOCK_CAN_SEND(&module);
  CO_LOCK_CAN_SEND(&module);
  step();
  CO_UNLOCK_CAN_SEND(&module);
  CHECK(!enabled);
  CO_UNLOCK_CAN_SEND(&module);
  CO_LOCK_EMCY(&module);
  step();
  CO_UNLOCK_OD(&module);
  CHECK(!enabled);
  CO_UNLOCK_EMCY(&module);
}

int main(void) {
  can.port.lock = lock;
  can.port.unlock = unlock;
  module.CANptr = &can;
  int last = 1;
  for (interrupt_at = -1; interrupt_at < last; ++interrupt_at) {
    enabled = true;
    taken = steps = 0;
    sections();
    last = interrupt_at < 0 ? steps : last;
    CHECK(enabled && taken == 0);
  }
  CHECK(last > 8);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

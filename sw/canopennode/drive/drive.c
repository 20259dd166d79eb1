/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo drive: see drive.h.
 */
#include "drive.h"

/* Statusword in the states of CiA 402: bits 0 to 3, 5 and 6; bit 4 voltage, bit 9 remote. */
#define ALWAYS 0x0210u
#define SWITCH_ON_DISABLED (ALWAYS | 0x0040u)
#define READY (ALWAYS | 0x0021u)
#define SWITCHED_ON (ALWAYS | 0x0023u)
#define ENABLED (ALWAYS | 0x0027u)
#define FAULT (ALWAYS | 0x0008u)
#define TARGET_REACHED 0x0400u

/* Controlword: which bits a command looks at, and what they are. */
#define DISABLE_VOLTAGE(word) (((word)&0x0002u) == 0u)
#define QUICK_STOP(word) (((word)&0x0006u) == 0x0002u)
#define SHUTDOWN(word) (((word)&0x0007u) == 0x0006u)
#define SWITCH_ON(word) (((word)&0x000Fu) == 0x0007u)
#define ENABLE(word) (((word)&0x000Fu) == 0x000Fu)
#define FAULT_RESET(word) (((word)&0x0080u) != 0u)

void drive_init(drive_t *drive) { *drive = (drive_t){.status = SWITCH_ON_DISABLED}; }

void drive_fail(drive_t *drive) { drive->fault = true; }

static uint16_t next_state(const drive_t *drive, uint16_t control) {
  const uint16_t state = (uint16_t)(drive->status & ~TARGET_REACHED);
  if (drive->fault) return FAULT;
  if (state == FAULT) return FAULT_RESET(control) ? SWITCH_ON_DISABLED : FAULT;
  if (DISABLE_VOLTAGE(control) || QUICK_STOP(control)) return SWITCH_ON_DISABLED;
  if (SHUTDOWN(control)) return READY;
  if (state == SWITCH_ON_DISABLED) return state;
  if (SWITCH_ON(control)) return SWITCHED_ON;
  if (ENABLE(control)) return state == READY ? SWITCHED_ON : ENABLED;
  return state;
}

static int32_t limited(int64_t value, int32_t limit) {
  if (value > limit) return limit;
  return value < -limit ? -limit : (int32_t)value;
}

void drive_cycle(drive_t *drive, uint16_t control, int64_t target, uint32_t elapsed_us) {
  drive->status = next_state(drive, control);
  drive->fault = false; /* the state keeps it */
  drive->velocity = 0;
  if (drive->status != ENABLED) return;
  const int32_t longest =
      (int32_t)(DRIVE_SPEED * (elapsed_us > 10000u ? 10000u : elapsed_us) / 1000u);
  const int32_t way = limited(limited(target, DRIVE_RANGE) - drive->position, longest);
  drive->position += way;
  if (elapsed_us != 0u) drive->velocity = way * 1000 / (int32_t)elapsed_us;
  if (way == 0) drive->status |= TARGET_REACHED;
}

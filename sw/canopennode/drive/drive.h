/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A servo drive as far as a bus sees it: the state machine of CiA 402 and a motor that follows its
 * set point at limited speed. No hardware, no stack: plain numbers.
 */
#ifndef DRIVE_H
#define DRIVE_H

#include <stdbool.h>
#include <stdint.h>

/** Where the motor may be, increments. */
#define DRIVE_RANGE 1000000
/** Fastest, increments each millisecond. */
#define DRIVE_SPEED 200

/** The drive. */
typedef struct {
  uint16_t status; /**< statusword, object 6041 */
  int32_t position;
  int32_t velocity; /**< increments each millisecond */
  bool fault;
} drive_t;

/** Switched off, at position 0. */
void drive_init(drive_t *drive);

/** Something in the drive has failed; it is off until a fault reset. */
void drive_fail(drive_t *drive);

/**
 * A cycle: obeys the controlword (object 6040) and goes on for `elapsed_us` towards `target`, a sum
 * of set points; beyond the range it goes to its end.
 */
void drive_cycle(drive_t *drive, uint16_t control, int64_t target, uint32_t elapsed_us);

#endif /* DRIVE_H */

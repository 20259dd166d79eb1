/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo drive of sw/canopennode/drive: where it goes. Needs no CANopenNode.
 */
#include "drive/drive.h"

#include <stdlib.h>

#include "check.h"

static void enable(drive_t *drive) {
  drive_init(drive);
  drive_cycle(drive, 0x06, 0, 1000);
  drive_cycle(drive, 0x07, 0, 1000);
  drive_cycle(drive, 0x0F, 0, 1000);
}

static void it_goes_as_fast_as_it_may(void) {
  drive_t drive;
  enable(&drive);
  drive_cycle(&drive, 0x0F, 1000, 1000);
  CHECK(drive.position == DRIVE_SPEED && drive.velocity == DRIVE_SPEED);
  drive_cycle(&drive, 0x0F, -1000, 2000);
  CHECK(drive.position == -DRIVE_SPEED && drive.velocity == -DRIVE_SPEED);
}

/* Any set points may be written; their sum is one of 33 bits. */
static void it_goes_to_the_end_that_the_set_points_mean(void) {
  drive_t drive;
  enable(&drive);
  drive_cycle(&drive, 0x0F, (int64_t)INT32_MAX + INT16_MAX, 1000);
  CHECK(drive.position == DRIVE_SPEED);
  enable(&drive);
  drive_cycle(&drive, 0x0F, (int64_t)INT32_MIN + INT16_MIN, 1000);
  CHECK(drive.position == -DRIVE_SPEED);
}

int main(void) {
  it_goes_as_fast_as_it_may();
  it_goes_to_the_end_that_the_set_points_mean();
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

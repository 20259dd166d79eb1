/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A core with its driver, ready to use; every failure ends the program with a message.
 */
#ifndef FIRMWARE_CAN_H
#define FIRMWARE_CAN_H

#include <stddef.h>

#include "board.h"

/** Received frames that wait for the program. */
#define CAN_RING 32u

/** A core, its driver and its memory for received frames. */
typedef struct can {
  verican_t device;
  verican_frame_t ring[CAN_RING];
} can_t;

/** The driver's defaults for core 0 or 1 at a bit rate. */
verican_config_t can_config(can_t *can, unsigned core, uint32_t bitrate);

/** Initialises the driver. `filters` may be NULL: every frame is accepted. */
void can_open(can_t *can, const verican_config_t *config, const verican_filter_t *filters,
              uint16_t filter_count);

/** Joins the bus and enables the core's interrupt; can0_handler() or can1_handler() must serve it.
 */
void can_start(can_t *can, unsigned core);

/** Sends; waits for a free mailbox if there is none. */
void can_send(can_t *can, const verican_frame_t *frame);

/**
 * Waits for a frame, asleep between interrupts. False after `microseconds`; the timer must run
 * then, to wake up. 0: no limit.
 */
bool can_receive(can_t *can, verican_frame_t *frame, uint32_t microseconds);

/** Ends the program with a message if `result` is an error. */
void can_check(verican_result_t result, const char *what);

#endif /* FIRMWARE_CAN_H */

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The client of can_remote over the VeriCAN driver: for a microcontroller with a VeriCAN or
 * FlexCAN core.
 */
#ifndef VERICAN_REMOTE_DRIVER_H
#define VERICAN_REMOTE_DRIVER_H

#include "verican/verican.h"
#include "verican_remote.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A started device and what waiting means. All members but the last are the caller's to fill. */
typedef struct verican_remote_driver {
  verican_t *device;                 /**< started; receives base data frames */
  uint32_t (*now_us)(void *context); /**< as verican_remote_port_t.now_us */
  void (*idle)(void *context);       /**< called while nothing can be done; NULL: none */
  void *context;                     /**< of these two */
  uint32_t send_us;                  /**< until a frame must have found room; 0: 1 s */
} verican_remote_driver_t;

/**
 * The three functions for verican_remote_init(). `driver` must stay where it is. Frames leave in
 * order: with VERICAN_TX_IN_ORDER back to back, else each when the one before has gone (RN-94). A
 * device that is stopped or listens only is off the bus: VERICAN_REMOTE_BUS_OFF.
 */
verican_remote_port_t verican_remote_driver_port(verican_remote_driver_t *driver);

#ifdef __cplusplus
}
#endif

#endif

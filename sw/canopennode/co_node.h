/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A CANopen device of CANopenNode on a VeriCAN core: set-up, resets, and what has to be called
 * when. An application fills in a co_node_t and calls co_node_run() from main(); the real-time part
 * has an interrupt of its own, less urgent than the core's. The port's lock must mask both.
 */
#ifndef CO_NODE_H
#define CO_NODE_H

#include "CANopen.h"
#include "CO_driver_target.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct co_node co_node_t;

/** What an application may do at its moments; any may be NULL. */
typedef struct {
  /** After each communication reset, before the bus: extensions of the object dictionary. */
  void (*on_reset)(co_node_t *node);
  /** In the real-time part after RPDOs have arrived and before TPDOs leave; `sync`: a SYNC came. */
  void (*on_real_time)(co_node_t *node, bool sync, uint32_t elapsed_us);
  /** In the main loop, after the stack. */
  void (*on_loop)(co_node_t *node);
  /** The two LEDs of CiA 303-3 change. */
  void (*on_leds)(co_node_t *node, bool green, bool red);
  /** LSS: keep node-ID and bit rate (kbit/s); false: it cannot be done. */
  bool (*store_lss)(co_node_t *node, uint8_t id, uint16_t kbit);
} co_node_hooks_t;

/** What the board has to offer; all are needed. */
typedef struct {
  uint32_t (*time_us)(void);     /**< a clock that wraps at 2^32 */
  void (*request)(void);         /**< brings the interrupt that calls co_node_real_time() */
  void (*wait)(co_node_t *node); /**< sleeps until co_node_work() or a millisecond has passed */
} co_node_board_t;

/** A device. */
struct co_node {
  co_verican_t can;
  co_node_board_t board;
  co_node_hooks_t hooks;
  OD_t *od;
  CO_LSS_address_t identity; /**< object 1018 */
  uint8_t node_id;           /**< 1 to 127, or CO_LSS_NODE_ID_ASSIGNMENT: LSS gives one */
  uint16_t kbit;             /**< bit rate, kbit/s */
  uint16_t nmt_control;      /**< CO_NMT_control_t */
  CO_t *co;
  uint8_t active_id;
  volatile bool running; /**< the real-time part may work */
  volatile bool work;    /**< something came since the main loop looked */
  bool leds[2];
  uint32_t requests; /* frames for the real-time part */
  uint32_t main_us, real_time_us;
};

/** Runs the device until NMT asks for "reset node": CO_ERROR_NO. Other results: it cannot be set
 * up; `info` is then what the stack says about it, for CO_ERROR_OD_PARAMETERS the index. */
CO_ReturnError_t co_node_run(co_node_t *node, uint32_t *info);

/** The real-time part: SYNC, RPDO, application, TPDO. */
void co_node_real_time(co_node_t *node);

/** To be called from the handler of the core's interrupt. */
void co_node_can_interrupt(co_node_t *node);

/** True once for each time that something came for the main loop: other frames than SYNC and PDO.
 */
bool co_node_work(co_node_t *node);

#ifdef __cplusplus
}
#endif

#endif /* CO_NODE_H */

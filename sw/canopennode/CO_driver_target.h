/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What CANopenNode 4 asks of a target (its 301/CO_driver.h describes it), for the VeriCAN driver:
 * types, received messages, buffers, critical sections, and which parts of the stack are wanted.
 * Guide: docs/canopen.md.
 */
#ifndef CO_DRIVER_TARGET_H
#define CO_DRIVER_TARGET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "verican/verican.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Parts of the stack. Each may be set by -D instead; values are those of 301/CO_config.h. */

/* The application hears of SYNC and PDOs in the interrupt that brings them. */
#ifndef CO_CONFIG_GLOBAL_RT_FLAG_CALLBACK_PRE
#define CO_CONFIG_GLOBAL_RT_FLAG_CALLBACK_PRE CO_CONFIG_FLAG_CALLBACK_PRE
#endif
#ifndef CO_CONFIG_EM
#define CO_CONFIG_EM (CO_CONFIG_EM_PRODUCER | CO_CONFIG_EM_PROD_CONFIGURABLE | CO_CONFIG_EM_HISTORY)
#endif
#ifndef CO_CONFIG_SDO_SRV
#define CO_CONFIG_SDO_SRV \
  (CO_CONFIG_SDO_SRV_SEGMENTED | CO_CONFIG_SDO_SRV_BLOCK | CO_CONFIG_FLAG_OD_DYNAMIC)
#endif
/* A whole block of 127 segments and what may still be in the buffer before it. */
#ifndef CO_CONFIG_SDO_SRV_BUFFER_SIZE
#define CO_CONFIG_SDO_SRV_BUFFER_SIZE 1000
#endif
#ifndef CO_CONFIG_TIME
#define CO_CONFIG_TIME 0
#endif
#ifndef CO_CONFIG_FIFO
#define CO_CONFIG_FIFO (CO_CONFIG_FIFO_ENABLE | CO_CONFIG_FIFO_CRC16_CCITT)
#endif
#ifndef CO_CONFIG_CRC16
#define CO_CONFIG_CRC16 CO_CONFIG_CRC16_ENABLE
#endif

/* ---- Basic definitions ----------------------------------------------------------------------- */

#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define CO_BIG_ENDIAN
#define CO_SWAP_16(x) __builtin_bswap16(x)
#define CO_SWAP_32(x) __builtin_bswap32(x)
#define CO_SWAP_64(x) __builtin_bswap64(x)
#else
#define CO_LITTLE_ENDIAN
#define CO_SWAP_16(x) x
#define CO_SWAP_32(x) x
#define CO_SWAP_64(x) x
#endif

typedef uint_fast8_t bool_t;
typedef float float32_t;
typedef double float64_t;

/* ---- Received messages ----------------------------------------------------------------------- */

/** Identifier of a message that a callback of the stack gets: 11 bits. */
static inline uint16_t CO_CANrxMsg_readIdent(void *message) {
  return (uint16_t)((const verican_frame_t *)message)->id;
}

/** Its length: 0 to 8; a DLC above 8 means eight bytes. */
static inline uint8_t CO_CANrxMsg_readDLC(void *message) {
  const uint8_t dlc = ((const verican_frame_t *)message)->dlc;
  return dlc > 8u ? 8u : dlc;
}

/** Its eight bytes; those beyond the length are 0. */
static inline const uint8_t *CO_CANrxMsg_readData(void *message) {
  return ((const verican_frame_t *)message)->data;
}

/* ---- Buffers of the stack -------------------------------------------------------------------- */

/** What the stack wants to receive. */
typedef struct {
  uint16_t ident; /**< bits 0..10: identifier; bit 11: remote frame */
  uint16_t mask;  /**< bits of `ident` that count, aligned like it; always with bit 11 */
  void *object;   /**< first argument of the callback */
  void (*CANrx_callback)(void *object, void *message); /**< NULL: this buffer is not used */
} CO_CANrx_t;

/** What the stack sends. One frame of a buffer at most is in a mailbox of the core, so that frames
 * of one identifier stay in order; one more waits here. */
typedef struct {
  uint32_t ident; /**< 11 bits */
  uint8_t DLC;
  bool rtr;
  uint8_t data[8];
  volatile bool_t bufferFull; /**< `data` waits for a mailbox and must not change */
  volatile bool_t syncFlag;   /**< synchronous TPDO: taken back when its window ends */
  volatile uint8_t mailbox;   /**< CO_VERICAN_NO_MAILBOX, or where the frame before is */
} CO_CANtx_t;

#define CO_VERICAN_NO_MAILBOX 0xFFu

/** The CAN module of the stack. */
typedef struct {
  void *CANptr; /**< co_verican_t */
  CO_CANrx_t *rxArray;
  uint16_t rxSize;
  CO_CANtx_t *txArray;
  uint16_t txSize;
  uint16_t CANerrorStatus; /**< CO_CAN_ERR_* */
  volatile bool_t CANnormal;
  volatile bool_t useCANrxFilters; /**< false: more filters than mailboxes, all frames come in */
  volatile bool_t bufferInhibitFlag;
  volatile bool_t firstCANtxMessage; /**< the boot-up message has not left yet */
  volatile uint16_t CANtxCount;      /**< buffers with bufferFull */
  volatile uint8_t lock_depth;       /* of the critical sections below */
  volatile uint32_t lock_token;      /* of the outermost */
} CO_CANmodule_t;

/* ---- The core behind it ---------------------------------------------------------------------- */

/** Received frames between interrupt and callbacks; they are handed on in the same interrupt. */
#ifndef CO_VERICAN_RING
#define CO_VERICAN_RING 64u
#endif

/** `CANptr` of CO_CANinit(): a core, and what the application says about it. Zero what is unknown.
 */
typedef struct co_verican {
  verican_port_t port;       /**< how to reach the registers; lock and unlock are needed, and mask
                                all interrupts that call the stack */
  uint32_t clock_hz;         /**< of the core */
  uint8_t mailboxes;         /**< 0: ask the core */
  uint8_t tx_mailboxes;      /**< 0: 8 */
  uint32_t bus_off_delay_ms; /**< from bus-off to the begin of recovery; 0: at once */
  uint32_t (*now_ms)(void);  /**< a clock that wraps at 2^32 */

  /* The port's own. */
  verican_t device;
  verican_frame_t ring[CO_VERICAN_RING];
  CO_CANmodule_t *module;
  CO_CANtx_t *in_mailbox[64];
  uint32_t handed_on;   /* received frames that the stack has got */
  uint32_t lost;        /* frames, as last reported */
  uint16_t tx_errors;   /* CO_CAN_ERRTX_*, not reported yet */
  bool open;            /* the device is initialised */
  bool filters_changed; /* frames of the stack wait until they are written */
} co_verican_t;

/** To be called from the handler of the core's interrupt. */
void co_verican_interrupt(co_verican_t *can);

/* ---- Storage --------------------------------------------------------------------------------- */

/** A group of variables for objects 1010 and 1011; see co_storage.h for the memory behind it. */
typedef struct {
  void *addr;
  size_t len;
  uint8_t subIndexOD; /**< 2 to 127 */
  uint8_t attr;       /**< CO_storage_attributes_t */
  void *memory;       /**< len + 8 bytes that survive a reset, aligned to 4 */
} CO_storage_entry_t;

/* ---- Critical sections: the application's lock ----------------------------------------------- */

/*
 * The port's lock must mask the core's interrupt and whatever else calls the stack, as the
 * interrupt that calls co_node_real_time() does: that is what CO_LOCK_OD() keeps away from the
 * objects.
 *
 * Sections may stand within each other, and one that is interrupted all the same must leave the
 * lock as it was: only the outermost takes it and gives it back. An interruption at any point ends
 * with the depth that it found, so the depth is raised before the token is stored, and the token is
 * read before the depth is lowered.
 */
static inline void co_verican_lock(CO_CANmodule_t *module) {
  const co_verican_t *can = (const co_verican_t *)module->CANptr;
  if (module->lock_depth != 0u) {
    module->lock_depth = (uint8_t)(module->lock_depth + 1u);
    return;
  }
  const uint32_t token = can->port.lock(can->port.context);
  module->lock_depth = 1;
  module->lock_token = token;
}

static inline void co_verican_unlock(CO_CANmodule_t *module) {
  const co_verican_t *can = (const co_verican_t *)module->CANptr;
  const uint32_t token = module->lock_token;
  module->lock_depth = (uint8_t)(module->lock_depth - 1u);
  if (module->lock_depth == 0u) can->port.unlock(can->port.context, token);
}

#define CO_LOCK_CAN_SEND(CAN_MODULE) co_verican_lock(CAN_MODULE)
#define CO_UNLOCK_CAN_SEND(CAN_MODULE) co_verican_unlock(CAN_MODULE)
#define CO_LOCK_EMCY(CAN_MODULE) co_verican_lock(CAN_MODULE)
#define CO_UNLOCK_EMCY(CAN_MODULE) co_verican_unlock(CAN_MODULE)
#define CO_LOCK_OD(CAN_MODULE) co_verican_lock(CAN_MODULE)
#define CO_UNLOCK_OD(CAN_MODULE) co_verican_unlock(CAN_MODULE)

/* Flags between interrupt and main program. */
#define CO_MemoryBarrier() __sync_synchronize()
#define CO_FLAG_READ(rxNew) ((rxNew) != NULL)
#define CO_FLAG_SET(rxNew) \
  do {                     \
    CO_MemoryBarrier();    \
    (rxNew) = (void *)1L;  \
  } while (0)
#define CO_FLAG_CLEAR(rxNew) \
  do {                       \
    CO_MemoryBarrier();      \
    (rxNew) = NULL;          \
  } while (0)

#ifdef __cplusplus
}
#endif

#endif /* CO_DRIVER_TARGET_H */

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Client of can_remote, the CAN node without a processor: reads and writes the memory of such
 * nodes. C99, no heap, no globals, over three functions of the caller. docs/remote.md explains the
 * nodes; RN numbers are the rules named there.
 *
 * Every call checks its arguments before it sends anything. One client (struct) is used by one
 * thread at a time, and a bus has one client: nodes take requests from a single host (RN-13).
 */
#ifndef VERICAN_REMOTE_H
#define VERICAN_REMOTE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What every call returns (RN-91). */
typedef enum verican_remote_result {
  VERICAN_REMOTE_OK = 0,
  VERICAN_REMOTE_TIMEOUT = -1,   /**< no answer within timeout_us, after all tries */
  VERICAN_REMOTE_REFUSED = -2,   /**< the node said no; verican_remote_t.code says why */
  VERICAN_REMOTE_SEQUENCE = -3,  /**< a block transfer lost frames, in every try */
  VERICAN_REMOTE_BUS_OFF = -4,   /**< the host itself is off the bus */
  VERICAN_REMOTE_ARGUMENT = -5,  /**< an argument is missing or out of range; nothing was sent */
  VERICAN_REMOTE_NOT_TAKEN = -6, /**< assign: the node is there, but does not take the number */
  VERICAN_REMOTE_IN_USE = -7     /**< assign: another node has the number; nothing was assigned */
} verican_remote_result_t;

/** Codes of a refused request (RN-31). */
enum {
  VERICAN_REMOTE_CODE_FUNCTION = 0x01,
  VERICAN_REMOTE_CODE_ADDRESS = 0x02,
  VERICAN_REMOTE_CODE_VALUE = 0x03,
  VERICAN_REMOTE_CODE_OPEN = 0x05,
  VERICAN_REMOTE_CODE_BUSY = 0x06,
  VERICAN_REMOTE_CODE_PROTECTED = 0x10,
  VERICAN_REMOTE_CODE_LOCKED = 0x11,
  VERICAN_REMOTE_CODE_SEQUENCE = 0x12,
  VERICAN_REMOTE_CODE_TIMEOUT = 0x13,
  VERICAN_REMOTE_CODE_ABORTED = 0x14
};

/** Numbers with a meaning of their own (section 1). UNKNOWN: see verican_remote_scan(). */
enum { VERICAN_REMOTE_ALL = 1, VERICAN_REMOTE_NUMBERS = 32, VERICAN_REMOTE_UNKNOWN = 0xFF };

/** Commands of verican_remote_state(). */
enum { VERICAN_REMOTE_OPERATE = 0x01, VERICAN_REMOTE_SAFE = 0x02, VERICAN_REMOTE_RESTART = 0x81 };

/** A base frame. */
typedef struct verican_remote_frame {
  uint16_t id; /**< 11 bits */
  bool remote; /**< remote frame: a DLC, but no data */
  uint8_t dlc; /**< 0 to 8 */
  uint8_t data[8];
} verican_remote_frame_t;

/**
 * The way to the bus. Frames must leave in the order in which they are sent (RN-94). Extended
 * frames are left out by receive().
 */
typedef struct verican_remote_port {
  /** Hands a frame over; waits a while if there is no room. OK, TIMEOUT or BUS_OFF. */
  verican_remote_result_t (*send)(void *context, const verican_remote_frame_t *frame);
  /**
   * The oldest frame that has come; waits for one for `timeout_us` at most (0: not at all), and
   * ends then on a bus that is full of frames which it leaves out, too. OK, TIMEOUT or BUS_OFF.
   */
  verican_remote_result_t (*receive)(void *context, verican_remote_frame_t *frame,
                                     uint32_t timeout_us);
  /** A clock in microseconds; it may wrap. */
  uint32_t (*now_us)(void *context);
  void *context; /**< first argument of the three */
} verican_remote_port_t;

/**
 * For back ends: how long receive() may pass over frames that it leaves out. Longer than a short
 * time-out, so that what waits behind them is found.
 */
static inline uint32_t verican_remote_skip_us(uint32_t timeout_us) {
  return timeout_us > 10000u ? timeout_us : 10000u;
}

/** A client. Set up by verican_remote_init(); the first group may be changed afterwards. */
typedef struct verican_remote {
  uint32_t timeout_us; /**< for an answer, default 150,000; more than the nodes' LIFE (RN-91) */
  uint32_t select_us;  /**< for HERE, default 50,000: more than two frames of the bus. A scan waits
                          so only where no node has a number */
  uint8_t tries;       /**< for what may be repeated, default 3; 0 is as 1 */
  uint8_t gap_ms;      /**< between the frames of a block read, default 0 */
  bool data_frames;    /**< true: no remote frames are sent, all is read by port READ (RN-22) */
  uint8_t tag;         /**< of the last block transfer; counts up */
  /** Called with what nobody waits for, statements by producers; may be NULL. Of this client it
   * calls at most what only sends (write, trigger, state): where it waits for an answer it takes
   * that of the call in which it is, and is called within itself, without end on a busy bus. */
  void (*on_statement)(void *user, const verican_remote_frame_t *frame);
  void *user; /**< first argument of on_statement */

  uint8_t code; /**< after REFUSED: why, VERICAN_REMOTE_CODE_* */
  /** Where the part began of which read, write, write_confirmed or configure had no success; what
   * comes before it has been read or written. */
  uint16_t address;

  verican_remote_port_t port; /* from here on the client's own */
  uint8_t name_bits;
  bool here;               /* HERE has come */
  uint32_t refusals_known; /* bit n: refusals[n] is valid */
  uint8_t refusals[VERICAN_REMOTE_NUMBERS];
} verican_remote_t;

/** What a node says of itself (RN-24). */
typedef struct verican_remote_status_row {
  uint8_t state; /**< 0 INIT, 1 LISTEN, 2 SAFE, 3 OPERATE */
  bool unlocked;
  bool error_passive;
  bool duplicate; /**< it has heard its number from another node since the last CLEAR */
  bool stale;     /**< a statement it waits for is late */
  bool watchdog;
  bool bus_off; /**< since the last CLEAR */
  uint8_t tec;
  uint8_t rec;
  uint8_t code;     /**< of the last request that was counted, */
  uint8_t a;        /**< and its A */
  uint8_t accepted; /**< modulo 256 */
  uint8_t refused;  /**< modulo 256 */
  uint8_t trigger;  /**< count of the last TRIGGER */
} verican_remote_status_t;

/** What a node is (RN-25). */
typedef struct verican_remote_identity_row {
  uint8_t number; /**< 0: it has none */
  bool doubled;   /**< scan: another node has its number, too */
  uint8_t version;
  uint8_t
      features; /**< bits: stage, producers, map, queue of 4, protection, block, rate, counters */
  uint8_t name_bits;
  uint16_t memory; /**< bytes */
  uint8_t stage;   /**< bytes */
  uint32_t serial;
} verican_remote_identity_t;

/** Answers of all nodes to one poll. */
typedef struct verican_remote_answers {
  uint32_t answered;  /**< bit n: node n has answered */
  uint32_t differing; /**< bit n: two answers under number n differ: two nodes have it (RN-11) */
  uint8_t data[VERICAN_REMOTE_NUMBERS][8]; /**< its bytes */
} verican_remote_answers_t;

/** One setting of verican_remote_configure(). */
typedef struct verican_remote_setting {
  uint16_t address;
  uint8_t length; /**< 1 to 8 */
  uint8_t data[8];
} verican_remote_setting_t;

/** Sets a client up. `name_bits`: as the nodes have it, 3 or 5. */
verican_remote_result_t verican_remote_init(verican_remote_t *client,
                                            const verican_remote_port_t *port, uint8_t name_bits);

/* ---- Memory: `number` is 2 to 7 (name_bits 3) or 2 to 31, `length` anything that ends below
 * 0x1000. Longer accesses than a frame's are split; only what is in one frame belongs together. --
 */

/** Reads `length` bytes. What is refused as busy is tried again. */
verican_remote_result_t verican_remote_read(verican_remote_t *client, uint8_t number,
                                            uint16_t address, uint8_t *data, size_t length);
/**
 * Writes without confirmation: OK means that the frames have been handed over. `number` may be
 * VERICAN_REMOTE_ALL.
 */
verican_remote_result_t verican_remote_write(verican_remote_t *client, uint8_t number,
                                             uint16_t address, const uint8_t *data, size_t length);
/** Writes, and asks the node whether all of it was accepted (RN-31). */
verican_remote_result_t verican_remote_write_confirmed(verican_remote_t *client, uint8_t number,
                                                       uint16_t address, const uint8_t *data,
                                                       size_t length);
/**
 * Reads `length` bytes (1 to 8; 1 to 6 beyond the window or without remote frames) of all nodes at
 * one moment. Ends when the nodes of `expected` (bits) have answered; TIMEOUT if one has not;
 * 0: whoever answers within timeout_us.
 */
verican_remote_result_t verican_remote_poll(verican_remote_t *client, uint16_t address,
                                            uint8_t length, uint32_t expected,
                                            verican_remote_answers_t *poll);

/* ---- Nodes ----------------------------------------------------------------------------------- */

/** Makes staged bytes visible in all nodes. `count`: one more than the last time. */
verican_remote_result_t verican_remote_trigger(verican_remote_t *client, uint8_t count);
/** OPERATE, SAFE or RESTART for one node, or for all (number 0). Not confirmed. */
verican_remote_result_t verican_remote_state(verican_remote_t *client, uint8_t number,
                                             uint8_t command);
verican_remote_result_t verican_remote_status(verican_remote_t *client, uint8_t number,
                                              verican_remote_status_t *status);
verican_remote_result_t verican_remote_identity(verican_remote_t *client, uint8_t number,
                                                verican_remote_identity_t *identity);
/**
 * Selects the nodes whose serial number equals `value` in the bits of `mask`; `only_new`: of those
 * without a number. `here`: whether there is one.
 */
verican_remote_result_t verican_remote_select(verican_remote_t *client, uint32_t value,
                                              uint32_t mask, bool only_new, bool *here);
/**
 * Lists all nodes: those with a number in its order, then those without by serial number. `count`:
 * in: places in `nodes`; out: nodes found, at most so many.
 *
 * Nodes that share a number are found, too, by SELECT (RN-26): they disturb each other's answers,
 * so of them, as of nodes without a number, only the serial number is known. If several numbers
 * are shared, nobody can tell which node has which: their `number` is VERICAN_REMOTE_UNKNOWN. Two
 * nodes with one number and one serial number look like one.
 */
verican_remote_result_t verican_remote_scan(verican_remote_t *client,
                                            verican_remote_identity_t *nodes, size_t *count);
/**
 * Gives the node with this serial number a number (0: takes it away), and asks it whether it has
 * taken it. TIMEOUT: no such node. NOT_TAKEN: there is one; in OPERATE it takes none, and says
 * nothing (RN-32). IN_USE: the number is that of another node (RN-11); whether it is takes one
 * time-out.
 */
verican_remote_result_t verican_remote_assign(verican_remote_t *client, uint32_t serial,
                                              uint8_t number);
/**
 * Clears counters and the flags doubled number, watchdog and bus-off of a node (SETUP CLEAR, RN-24,
 * RN-35), confirmed.
 */
verican_remote_result_t verican_remote_clear(verican_remote_t *client, uint8_t number);
/**
 * Unlocks a node by its serial number, writes settings confirmed, in their order, and locks it
 * again, whatever comes of them or of the confirmation that it is unlocked; what went wrong first
 * is what is told. A node that does not answer is sent the lock once, without confirmation.
 */
verican_remote_result_t verican_remote_configure(verican_remote_t *client, uint8_t number,
                                                 uint32_t serial,
                                                 const verican_remote_setting_t *settings,
                                                 size_t count);

/* ---- Block transfers (nodes with the option); 1 to 4096 bytes -------------------------------- */

/** Reads many bytes, seven a frame; what was lost is read again. */
verican_remote_result_t verican_remote_block_read(verican_remote_t *client, uint8_t number,
                                                  uint16_t address, uint8_t *data, size_t length);
/** Writes many bytes; after a lost frame it goes on behind the bytes that have arrived. */
verican_remote_result_t verican_remote_block_write(verican_remote_t *client, uint8_t number,
                                                   uint16_t address, const uint8_t *data,
                                                   size_t length);

#ifdef __cplusplus
}
#endif

#endif

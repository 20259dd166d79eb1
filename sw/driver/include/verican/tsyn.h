/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Time in CAN frames, without hardware: SYNC and FUP of AUTOSAR CanTSyn, and who of several masters
 * is heard. verican/timesync.h joins it with a core. Rules: docs/time-spec.md, TM-50 to TM-55,
 * TM-89.
 */
#ifndef VERICAN_TSYN_H
#define VERICAN_TSYN_H

#include "verican/servo.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- SYNC and FUP ---------------------------------------------------------------------------- */

/** Which frames are taken, by their CRC. */
typedef enum verican_tsyn_crc {
  VERICAN_TSYN_CRC_IGNORED = 0,       /**< with or without, not looked at */
  VERICAN_TSYN_CRC_VALIDATED = 1,     /**< with a right one only */
  VERICAN_TSYN_CRC_NOT_VALIDATED = 2, /**< without one only */
  VERICAN_TSYN_CRC_OPTIONAL = 3       /**< without one, or with a right one */
} verican_tsyn_crc_t;

/** Why a frame or a pair was not taken; numbers of verican_tsyn_receiver_t.refused. */
typedef enum verican_tsyn_cause {
  VERICAN_TSYN_TYPE = 0, /**< not 8 bytes, another type, or nanoseconds that are none */
  VERICAN_TSYN_CRC = 1,
  VERICAN_TSYN_DOMAIN = 2,
  VERICAN_TSYN_SC = 3,      /**< sequence counter */
  VERICAN_TSYN_LATE = 4,    /**< FUP behind the timeout */
  VERICAN_TSYN_MISSING = 5, /**< SYNC without FUP, or FUP without SYNC */
  VERICAN_TSYN_OTHER = 6,   /**< OFS, OFNS and 16-byte forms: not built, no error */
  VERICAN_TSYN_CAUSES = 7
} verican_tsyn_cause_t;

/** What a time domain has agreed on. */
typedef struct verican_tsyn_rules {
  const uint8_t *sync_ids; /**< 16 data identifiers for the CRC of SYNC; NULL: no CRC */
  const uint8_t *fup_ids;  /**< the same for FUP */
  uint32_t fup_timeout_us; /**< from SYNC to FUP */
  uint8_t domain;          /**< 0 to 15 */
  uint8_t jump_width;      /**< largest step of the sequence counter, 1 to 15 */
  uint8_t crc;             /**< received: VERICAN_TSYN_CRC_* */
  bool sub_domain;         /**< sent: not the global master's time (SGW) */
  uint8_t user[3];         /**< sent: user bytes; 1 and 2 without CRC only */
} verican_tsyn_rules_t;

/** The master's side. Zero is its beginning. */
typedef struct verican_tsyn_sender {
  uint64_t second; /* ns: the whole seconds that SYNC carries */
  uint8_t sc;      /* of the next SYNC */
} verican_tsyn_sender_t;

/** The follower's side, of one master. Zero is its beginning. */
typedef struct verican_tsyn_receiver {
  uint64_t second; /* of the last SYNC, s */
  uint64_t stamp;  /* own time of the last SYNC */
  uint16_t refused[VERICAN_TSYN_CAUSES];
  uint8_t user[3];
  uint8_t sc;
  bool seen;       /* sc is that of a SYNC that was taken */
  bool waiting;    /* for its FUP */
  bool sub_domain; /* FUP's SGW */
} verican_tsyn_receiver_t;

/** What a frame was. */
typedef enum verican_tsyn_heard {
  VERICAN_TSYN_NOTHING = 0, /**< refused or ignored */
  VERICAN_TSYN_SYNC = 1,
  VERICAN_TSYN_PAIR = 2 /**< the FUP that completes a pair */
} verican_tsyn_heard_t;

/** Fills `rules` with: domain 0, no CRC, FUP within 100 ms, every step of the counter. */
verican_result_t verican_tsyn_rules_default(verican_tsyn_rules_t *rules);

/** CRC8H2F over bytes 2 to 7 of a message and the data identifier of its counter. */
uint8_t verican_tsyn_crc8(const uint8_t *data, const uint8_t *ids);

/** SYNC at the master's time `t0`, ns; the counter rises. */
void verican_tsyn_write_sync(verican_tsyn_sender_t *sender, const verican_tsyn_rules_t *rules,
                             uint64_t t0, uint8_t data[8]);

/** FUP for that SYNC, which was sent at `t1`, ns. False: 4 s or more later, there is none. */
bool verican_tsyn_write_fup(const verican_tsyn_sender_t *sender, const verican_tsyn_rules_t *rules,
                            uint64_t t1, uint8_t data[8]);

/** Whether this is a SYNC of the domain; `cause` otherwise, or VERICAN_TSYN_CAUSES if it is FUP. */
bool verican_tsyn_is_sync(const verican_tsyn_rules_t *rules, const uint8_t *data, uint8_t dlc,
                          verican_tsyn_cause_t *cause);

/**
 * Takes a frame of the master that is followed, received at the own time `stamp`. A SYNC that comes
 * `silence_ns` behind the last one need not continue its counter. VERICAN_TSYN_PAIR: `pair` has
 * local and master.
 */
verican_tsyn_heard_t verican_tsyn_receive(verican_tsyn_receiver_t *receiver,
                                          const verican_tsyn_rules_t *rules, const uint8_t *data,
                                          uint8_t dlc, uint64_t stamp, uint64_t silence_ns,
                                          verican_sync_pair_t *pair);

/* ---- Several masters ------------------------------------------------------------------------- */

/** Masters of a domain, the best first. */
#define VERICAN_MASTERS 4
#define VERICAN_MASTER_NONE 0xFFu

/** Who was heard when. verican_masters_start() begins. */
typedef struct verican_masters {
  uint64_t heard[VERICAN_MASTERS]; /* own time */
  uint64_t since;                  /* listens since */
  uint64_t interval;               /* R, ns */
  uint8_t known;                   /* bit: heard[] is valid */
  uint8_t current;                 /* the one that is followed */
} verican_masters_t;

/** Listens from the own time `now` on, `interval_us` between two SYNC. */
void verican_masters_start(verican_masters_t *masters, uint32_t interval_us, uint64_t now);

/** A SYNC of master `rank` was heard. True: it is the best that was heard of late. */
bool verican_masters_hear(verican_masters_t *masters, uint8_t rank, uint64_t stamp);

/** Whether candidate `rank` may send: no better one was heard for 3 R and R / 2 more a rank. */
bool verican_masters_may_send(const verican_masters_t *masters, uint8_t rank, uint64_t now);

/** Whether any master was heard in the last 3 R. */
bool verican_masters_alive(const verican_masters_t *masters, uint64_t now);

/** The own clock was shifted. */
void verican_masters_shift(verican_masters_t *masters, int64_t shift);

#ifdef __cplusplus
}
#endif

#endif /* VERICAN_TSYN_H */

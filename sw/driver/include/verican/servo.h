/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo that steers a clock after a master's: pairs of times go in, corrections come out. It
 * touches no hardware; verican/timesync.h joins it with a core. Rules: docs/time-spec.md, TM-80 to
 * TM-88.
 */
#ifndef VERICAN_SERVO_H
#define VERICAN_SERVO_H

#include "verican/verican.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Pairs that the longest filter looks at. */
#define VERICAN_SERVO_PAIRS 17
/** Filter lengths there are: 1, 2, 4, 8, 16 intervals. */
#define VERICAN_SERVO_FILTERS 5

/** How far a clock is one with its master's. */
typedef enum verican_sync_state {
  VERICAN_SYNC_UNSYNCHRONISED = 0, /**< nothing heard yet */
  VERICAN_SYNC_ACQUIRING = 1,      /**< fewer than four pairs, or the filter is not chosen yet */
  VERICAN_SYNC_LOCKED = 2,
  VERICAN_SYNC_HOLDOVER = 3 /**< was locked, hears nothing: keeps the rate */
} verican_sync_state_t;

/** What a pair or the time did, bits. */
enum {
  VERICAN_SERVO_ACCEPTED = 1u << 0, /**< the pair is in the history */
  VERICAN_SERVO_OUTLIER = 1u << 1,  /**< dropped: too far away, once */
  VERICAN_SERVO_LEAP = 1u << 2,     /**< not applied: beyond leap_ns */
  VERICAN_SERVO_STEP = 1u << 3,     /**< the clock steps, the history begins anew */
  VERICAN_SERVO_STATE = 1u << 4     /**< the state is another one */
};

/** Everything verican_servo_init() wants to know. Start from verican_servo_config_default(). */
typedef struct verican_servo_config {
  uint32_t interval_us; /**< between two pairs, 50,000 to 5,000,000 */
  uint32_t leap_ns;     /**< beyond it the master's clock has leapt; 10,000,000 at most */
  uint32_t drift_ppb; /**< of the rate in holdover, for verican_servo_bound(); 1,000,000 at most */
  int32_t delay_ns;   /**< from the master's stamp point to the own one */
  uint8_t filter;     /**< intervals: 1, 2, 4, 8 or 16; 0: the servo chooses */
  uint8_t hold_after; /**< intervals without a pair until holdover, 1 or more */
  bool keep_offset;   /**< corrects the rate only */
  bool keep_rate;     /**< corrects the offset only */
} verican_servo_config_t;

/** One pair, and the own clock as it is when the pair is handled. */
typedef struct verican_sync_pair {
  uint64_t local;     /**< the own stamp as it was read, ns */
  uint64_t master;    /**< the master's time of the same event, ns */
  uint64_t now;       /**< the own clock now, ns */
  uint64_t increment; /**< of the own clock, 2^-32 ns a clock (TINCN, TINCF) */
  uint8_t latency;    /**< of the own stamp, half clocks (TCAP) */
} verican_sync_pair_t;

/** What the clock needs. */
typedef struct verican_correction {
  int64_t shift;      /**< ns to add; 0: nothing */
  uint64_t increment; /**< the new one */
  bool slew;          /**< the shift is at most 1 us and is to be worked off, not to jump */
  uint8_t events;     /**< VERICAN_SERVO_* */
} verican_correction_t;

/** A pair as the servo keeps it. */
typedef struct verican_servo_point {
  int64_t local;  /**< own stamp, ns */
  int64_t offset; /**< own time less the master's, 1/256 ns */
} verican_servo_point_t;

/** A line through points. */
typedef struct verican_servo_line {
  int64_t offset; /**< at the newest, 1/256 ns */
  int64_t rate;   /**< slope, 2^-44 */
} verican_servo_line_t;

/** One servo. The members are its own, but for config.delay_ns, which may be set at any time. */
typedef struct verican_servo {
  verican_servo_config_t config;
  /* What is used most stands first, where short instructions reach it. */
  uint8_t count;  /* of points */
  uint8_t filter; /* length in use, intervals */
  uint8_t state;
  uint8_t pairs;   /* accepted in ACQUIRING */
  uint8_t learned; /* pairs that E_N has learned from */
  uint8_t errors;  /* pairs that E has learned from, 8 at most */
  uint8_t leaps;
  bool dropped;                                      /* the last pair was an outlier */
  int64_t base;                                      /* keep_offset: what is not corrected, ns */
  int64_t leap;                                      /* offset of the last leap, ns */
  int64_t last;                                      /* own time of the last accepted pair */
  int64_t error;                                     /* E of TM-85, 1/256 ns */
  int32_t misses[VERICAN_SERVO_FILTERS];             /* E_N of TM-84, 1/256 ns */
  verican_servo_point_t points[VERICAN_SERVO_PAIRS]; /* the newest first */
} verican_servo_t;

/** Fills `config` with: 1 s, leap 100 us, drift 100 ppb, filter chosen, holdover after 3 intervals.
 */
verican_result_t verican_servo_config_default(verican_servo_config_t *config);

/** Sets up a servo that has heard nothing. VERICAN_ERR_RANGE: a member of `config`. */
verican_result_t verican_servo_init(verican_servo_t *servo, const verican_servo_config_t *config);

/**
 * Takes a pair and tells how to correct the clock. The caller applies the whole correction, at once
 * or by slewing: the history is kept as if it had always held.
 */
verican_result_t verican_servo_pair(verican_servo_t *servo, const verican_sync_pair_t *pair,
                                    verican_correction_t *correction);

/** Sees that pairs stay away, by the own clock `now`. True: the state is another one. */
bool verican_servo_poll(verican_servo_t *servo, uint64_t now);

/** Another master: the history is cleared, rate and state are kept. */
verican_result_t verican_servo_forget(verican_servo_t *servo);

/** The line of least squares through the first `count` points, the newest first; 1 at least. */
verican_servo_line_t verican_servo_fit(const verican_servo_point_t *points, unsigned count);

/**
 * How far the clock is off, ns: mean error of the pairs, and in holdover what the drift adds at
 * most. It is 0 as long as nothing is known: the state tells.
 */
uint64_t verican_servo_bound(const verican_servo_t *servo, uint64_t now);

#ifdef __cplusplus
}
#endif

#endif /* VERICAN_SERVO_H */

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Time on a core with the time unit: its clock, and synchronisation over CAN with the messages of
 * AUTOSAR CanTSyn. Guide: docs/driver.md; rules: docs/time-spec.md, TM-89 and TM-91. Results are
 * those of verican/verican.h; VERICAN_ERR_UNSUPPORTED everywhere: the core has no time unit.
 */
#ifndef VERICAN_TIMESYNC_H
#define VERICAN_TIMESYNC_H

#include "verican/delay.h"
#include "verican/servo.h"
#include "verican/tsyn.h"
#include "verican/verican.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The clock ------------------------------------------------------------------------------- */

/** The time, ns. What the functions below change shows five clocks later. */
verican_result_t verican_clock_get(const verican_t *dev, uint64_t *ns);

/** Sets the time, and ends a slew that is under way. */
verican_result_t verican_clock_set(const verican_t *dev, uint64_t ns);

/** Adds to the time at once; nothing is lost, and a slew goes on. */
verican_result_t verican_clock_shift(const verican_t *dev, int64_t ns);

/** Adds to the time bit by bit, 1 ns in 1,024; replaces what is left of the last one. */
verican_result_t verican_clock_slew(const verican_t *dev, int32_t ns);

/**
 * The increment of each clock, 2^-32 ns; 40 bits. verican_init() sets it for config.clock_hz, which
 * must be 3.93 MHz at least.
 */
verican_result_t verican_clock_rate(verican_t *dev, uint64_t increment);
verican_result_t verican_clock_increment(const verican_t *dev, uint64_t *increment);

/** Where frames are stamped. */
typedef enum verican_stamp_point {
  VERICAN_STAMP_SOF = 0,
  VERICAN_STAMP_EDGE = 1, /**< reference edge, after reset */
  VERICAN_STAMP_EOF = 2   /**< as CiA 603 and AUTOSAR say */
} verican_stamp_point_t;

/** Where frames are stamped, from the next one on; own ones at the receive pin, or when sent. */
verican_result_t verican_clock_point(verican_t *dev, verican_stamp_point_t point, bool own_pin);

/**
 * A pulse a second at the output pin, high for half a second; or nothing. When the time is set or
 * shifted, by a follower's step, too, the pin is low until the next whole second.
 */
verican_result_t verican_clock_pps(verican_t *dev, bool on);

/** Events of the clock, for verican_clock_on_event(). */
enum {
  VERICAN_CLOCK_RISING = 0x10100,  /**< rising edge of the external pin */
  VERICAN_CLOCK_FALLING = 0x10200, /**< falling edge */
  VERICAN_CLOCK_COMPARE = 0x20000, /**< edge of the output pin */
  VERICAN_CLOCK_SLEWED = 0x40000,  /**< verican_clock_slew() is done */
  VERICAN_CLOCK_RELEASED = 0x80000 /**< the time of verican_send_at() has come */
};
#define VERICAN_CLOCK_EVENTS 0xF0300u
/** Flags of TSTAT that are told. */
#define VERICAN_CLOCK_FLAGS 0x3Fu

/** Called from verican_clock_irq_handler(): VERICAN_TSTAT_* flags, and the time of an edge. */
typedef void verican_clock_event_t(void *user, verican_t *dev, uint32_t flags, uint64_t time_ns);

/**
 * Asks for events, VERICAN_CLOCK_*, in place of those before; none: 0 and NULL. What happened
 * before it was asked for is not told.
 */
verican_result_t verican_clock_on_event(verican_t *dev, uint32_t events,
                                        verican_clock_event_t *on_event, void *user);

/** To be called when the line irq_time_o is high. VERICAN_ERR_EMPTY: nothing happened. */
verican_result_t verican_clock_irq_handler(verican_t *dev);

/* ---- Synchronisation ------------------------------------------------------------------------- */

/** Bit of an identifier below: it has 29 bits. */
#define VERICAN_TSYN_EXTENDED 0x80000000u

typedef struct verican_tsyn verican_tsyn_t;

/** Everything verican_tsyn_init() wants to know. Start from verican_tsyn_config_default(). */
typedef struct verican_tsyn_config {
  verican_servo_config_t servo;
  verican_tsyn_rules_t rules;
  uint32_t masters[VERICAN_MASTERS]; /**< identifiers of SYNC and FUP, rising: the best first */
  uint32_t delay_request;            /**< identifiers of verican_tsyn_measure(); both 0: not used */
  uint32_t delay_response;
  uint8_t master_count; /**< 1 to 4 */
  uint8_t rank;         /**< own place among them, for verican_tsyn_start_master() */
  /** VERICAN_SERVO_* happened; called from verican_tsyn_on_frame() and _poll(). May be NULL. */
  void (*on_event)(void *user, verican_tsyn_t *tsyn, uint8_t events);
  void *user;
} verican_tsyn_config_t;

/** One time domain on one core. The members are the driver's own. */
struct verican_tsyn {
  /* What is used most stands first, where short instructions reach it. */
  verican_t *dev;
  volatile uint8_t step;  /* of SYNC and FUP */
  uint8_t sync_mailbox;   /* of SYNC */
  uint8_t delay_mailbox;  /* of the request */
  uint8_t unsent;         /* SYNCs in a row that did not go out */
  volatile bool delaying; /* the request is under way */
  bool started;
  bool candidate;
  bool sending;      /* is master now */
  volatile bool cut; /* nothing gets out */
  int64_t shift;     /* of the last correction */
  uint64_t next;     /* SYNC is due */
  uint64_t t0;       /* SYNC was queued */
  uint64_t t1;       /* SYNC was sent */
  uint64_t latest;   /* time of the last poll */
  verican_tsyn_config_t config;
  verican_masters_t masters;
  verican_tsyn_sender_t sender;
  verican_tsyn_receiver_t receiver;
  verican_delay_t delay;
  verican_servo_t servo;
};

/** What there is to know. */
typedef struct verican_tsyn_snapshot {
  verican_sync_state_t state;
  bool sending;      /**< is the master now */
  bool sub_domain;   /**< the master is not the global one (SGW) */
  uint8_t master;    /**< rank of the one that is followed; VERICAN_MASTER_NONE */
  uint8_t filter;    /**< length in use, intervals */
  int32_t delay_ns;  /**< configured or measured */
  int64_t shift_ns;  /**< of the last correction */
  uint64_t bound_ns; /**< verican_servo_bound() */
  uint16_t refused[VERICAN_TSYN_CAUSES];
} verican_tsyn_status_t;

/** Fills `config` with the defaults of servo and rules, and one master with identifier 0. */
verican_result_t verican_tsyn_config_default(verican_tsyn_config_t *config);

/** Sets up a domain on an initialised device. VERICAN_ERR_RANGE: a member of `config`. */
verican_result_t verican_tsyn_init(verican_tsyn_t *tsyn, verican_t *dev,
                                   const verican_tsyn_config_t *config);

/** Follows whichever master is the best. */
verican_result_t verican_tsyn_start_follower(verican_tsyn_t *tsyn);

/**
 * Is master when no better one is heard, and follows otherwise. Among several, it listens first and
 * takes over from a worse one once it is locked to it, so that followers see no jump.
 */
verican_result_t verican_tsyn_start_master(verican_tsyn_t *tsyn);

/** To be called often, ten times an interval or more: sends SYNC, sees that pairs stay away. */
verican_result_t verican_tsyn_poll(verican_tsyn_t *tsyn);

/** Hand it every frame of verican_receive(), soon. VERICAN_ERR_EMPTY: it is none of this domain. */
verican_result_t verican_tsyn_on_frame(verican_tsyn_t *tsyn, const verican_frame_t *frame);

/** Hand it every event of on_sent. VERICAN_ERR_EMPTY: the frame is none of this domain. */
verican_result_t verican_tsyn_on_sent(verican_tsyn_t *tsyn, const verican_tx_event_t *event);

/** Measures the delay by that many exchanges with the master, 8 are usual; then uses it. */
verican_result_t verican_tsyn_measure(verican_tsyn_t *tsyn, uint8_t exchanges);

/** The state of things. */
verican_result_t verican_tsyn_status(const verican_tsyn_t *tsyn, verican_tsyn_status_t *status);

#ifdef __cplusplus
}
#endif

#endif /* VERICAN_TIMESYNC_H */

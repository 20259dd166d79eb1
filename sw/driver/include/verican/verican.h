/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The VeriCAN driver: CAN 2.0 over FlexCAN registers. C99, no heap, no globals; the programmer's
 * guide is docs/driver.md.
 *
 * Every function returns a verican_result_t and checks its arguments before it touches the
 * hardware: VERICAN_ERR_NULL for a missing pointer, VERICAN_ERR_RANGE for a value outside its
 * range, VERICAN_ERR_STATE for a call that does not fit the state of the device. Functions list
 * only what else they return. Where a function fails, its outputs are untouched.
 */
#ifndef VERICAN_VERICAN_H
#define VERICAN_VERICAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What every function returns: 0, or what went wrong. */
typedef enum verican_result {
  VERICAN_OK = 0,
  VERICAN_ERR_NULL = -1,        /**< a pointer is missing */
  VERICAN_ERR_RANGE = -2,       /**< a value is outside its range */
  VERICAN_ERR_STATE = -3,       /**< not initialised, or not allowed now (started, stopped, ...) */
  VERICAN_ERR_TIMEOUT = -4,     /**< the core did not acknowledge within port.poll_limit reads */
  VERICAN_ERR_BUSY = -5,        /**< no free transmit mailbox, or this one holds a frame */
  VERICAN_ERR_EMPTY = -6,       /**< nothing there: no frame, no event */
  VERICAN_ERR_UNSUPPORTED = -7, /**< this core lacks the feature */
  VERICAN_ERR_SPACE = -8,       /**< more filters or mailboxes than the core has */
  VERICAN_ERR_TIMING = -9,      /**< no bit timing comes close enough to the wish */
  VERICAN_ERR_DEVICE = -10,     /**< what answers is not this core, or it does not keep settings */
  VERICAN_ERR_SELF_TEST = -11   /**< the self-test found a difference */
} verican_result_t;

/* ---- Frames ---------------------------------------------------------------------------------- */

/** Bits of verican_frame_t.flags. */
enum {
  VERICAN_FRAME_EXTENDED = 1u << 0, /**< 29-bit identifier */
  VERICAN_FRAME_REMOTE = 1u << 1,   /**< remote frame: a DLC, but no data */
  VERICAN_FRAME_OVERRUN = 1u << 2,  /**< received: one before it was overwritten in its mailbox */
  VERICAN_FRAME_ONE_SHOT = 1u << 3  /**< to send: at most one start, no repetition */
};

/** A CAN frame. */
typedef struct verican_frame {
  uint64_t timestamp; /**< received: start of the identifier, in bit times (verican_time()) */
  uint32_t id;        /**< 11 bits, or 29 with VERICAN_FRAME_EXTENDED; right-aligned */
  uint8_t flags;      /**< VERICAN_FRAME_* */
  uint8_t dlc;        /**< 0 to 15 as on the wire; 8 and above mean eight bytes */
  uint8_t priority;   /**< to send: 0 (first) to 7, counts with VERICAN_TX_BY_PRIORITY only */
  uint8_t source;     /**< received: mailbox, or with the FIFO the filter element, modulo 256 */
  uint8_t data[8];    /**< bytes beyond the DLC are 0 in received frames, ignored in others */
  uint64_t time_ns;   /**< received: stamp of the time unit less its latency; 0 without the unit */
} verican_frame_t;

/* ---- Access to the hardware ------------------------------------------------------------------ */

/**
 * How the driver reaches the registers of one core, and how it is kept from interrupting itself.
 *
 * Either `base` points to the register window, or it is NULL and both functions are given; `offset`
 * is in bytes, a multiple of 4. lock() masks the core's interrupt (with the time unit both, or all)
 * and returns what unlock() needs to undo it; leave both NULL when the handler and all other calls
 * run in one context. They are called in pairs, for a few register accesses each; verican_init()
 * resets the core in between.
 */
typedef struct verican_port {
  volatile uint32_t *base;
  uint32_t (*read32)(void *context, uint32_t offset);
  void (*write32)(void *context, uint32_t offset, uint32_t value);
  uint32_t (*lock)(void *context);
  void (*unlock)(void *context, uint32_t token);
  void *context; /**< first argument of the four functions above */
  /** Reads of a register until VERICAN_ERR_TIMEOUT; more than a frame lasts, as verican_stop() and
   * the self-test wait for the end of one. 0: 100,000, or the clocks of 200 bits if they are more.
   */
  uint32_t poll_limit;
} verican_port_t;

/* ---- Bit timing ------------------------------------------------------------------------------ */

/** A bit in clocks and time quanta, and what comes of it. A bit is 1 + prop + phase1 + phase2 tq.
 */
typedef struct verican_timing {
  uint16_t prescaler; /**< clocks per time quantum, 1..256 */
  uint8_t prop;       /**< propagation segment, 1..8 tq */
  uint8_t phase1;     /**< phase segment 1, 1..8 tq */
  uint8_t phase2;     /**< phase segment 2, 2..8 tq */
  uint8_t sjw;        /**< (re)synchronisation jump width, 1..4 tq, not above a phase segment */
  /* Reported by verican_timing_find() and verican_timing_check(), ignored otherwise: */
  uint16_t sample_point; /**< per mille of the bit */
  uint32_t bitrate;      /**< bit/s, rounded down */
  uint32_t error_ppm;    /**< distance of the bit rate from the wish */
} verican_timing_t;

/** Slowest and fastest clock of the core, Hz. */
#define VERICAN_CLOCK_MIN 1000000u
#define VERICAN_CLOCK_MAX 400000000u
/** Slowest and fastest bit rate, bit/s. */
#define VERICAN_BITRATE_MIN 1000u
#define VERICAN_BITRATE_MAX 1000000u
/** Largest error of a computed bit rate, ppm, and of a computed sample point, per mille. */
#define VERICAN_BITRATE_TOLERANCE 5000u
#define VERICAN_SAMPLE_POINT_TOLERANCE 50u

/**
 * Computes a bit timing: least error of the bit rate, then of the sample point, then the most time
 * quanta. `sample_point` in per mille, 500..900; 0 asks for 750 above 800 kbit/s, 800 above
 * 500 kbit/s and 875 otherwise, or the nearest there is.
 * VERICAN_ERR_RANGE: clock or bit rate outside the limits above. VERICAN_ERR_TIMING: no setting
 * comes within the tolerances above.
 */
verican_result_t verican_timing_find(uint32_t clock_hz, uint32_t bitrate, uint16_t sample_point,
                                     verican_timing_t *timing);

/**
 * Checks an explicit bit timing against the ranges of its fields and 8..25 tq a bit, and fills in
 * its bit rate and sample point (error_ppm becomes 0).
 */
verican_result_t verican_timing_check(uint32_t clock_hz, verican_timing_t *timing);

/* ---- Configuration --------------------------------------------------------------------------- */

/** How the node takes part in the bus. */
typedef enum verican_mode {
  VERICAN_MODE_NORMAL = 0,
  VERICAN_MODE_LISTEN_ONLY = 1, /**< never drives the bus; sending is VERICAN_ERR_STATE */
  VERICAN_MODE_LOOP_BACK = 2    /**< hears itself only, pins idle */
} verican_mode_t;

/** Where received frames wait for the interrupt handler. */
typedef enum verican_rx_mode {
  VERICAN_RX_MAILBOXES = 0, /**< all mailboxes that do not transmit */
  VERICAN_RX_FIFO = 1       /**< the FIFO of six frames */
} verican_rx_mode_t;

/** Elements of the filter table of the FIFO. */
typedef enum verican_fifo_format {
  VERICAN_FIFO_FORMAT_A = 0, /**< one whole identifier a word */
  VERICAN_FIFO_FORMAT_B = 1, /**< two a word; 14 most significant bits of extended ones */
  VERICAN_FIFO_FORMAT_C = 2  /**< four a word; eight most significant bits, any format and kind */
} verican_fifo_format_t;

/** Which of several waiting frames goes first. */
typedef enum verican_tx_order {
  VERICAN_TX_BY_ID = 0,      /**< the one that would win on the bus */
  VERICAN_TX_IN_ORDER = 1,   /**< the one that was handed over first */
  VERICAN_TX_BY_PRIORITY = 2 /**< least verican_frame_t.priority, then the identifier */
} verican_tx_order_t;

/** What happens after bus-off. */
typedef enum verican_bus_off_policy {
  VERICAN_BUS_OFF_AUTOMATIC = 0, /**< the core returns after 128 x 11 recessive bits */
  VERICAN_BUS_OFF_MANUAL = 1,    /**< stays off until verican_recover() */
  VERICAN_BUS_OFF_DELAYED = 2    /**< verican_poll() recovers after bus_off_delay_ms */
} verican_bus_off_policy_t;

/** The error state of the node. */
typedef enum verican_state {
  VERICAN_STATE_STOPPED = 0, /**< not on the bus: not started */
  VERICAN_STATE_ACTIVE = 1,
  VERICAN_STATE_WARNING = 2, /**< a counter is at 96 or above */
  VERICAN_STATE_PASSIVE = 3, /**< a counter is at 128 or above; also listen-only */
  VERICAN_STATE_BUS_OFF = 4
} verican_state_t;

/** Kinds of bus errors, bits. */
enum {
  VERICAN_ERROR_STUFF = 1u << 0,
  VERICAN_ERROR_FORM = 1u << 1,
  VERICAN_ERROR_CRC = 1u << 2,
  VERICAN_ERROR_ACK = 1u << 3,
  VERICAN_ERROR_BIT0 = 1u << 4, /**< sent dominant, saw recessive */
  VERICAN_ERROR_BIT1 = 1u << 5  /**< sent recessive, saw dominant */
};

/** How a transmission ended. */
typedef enum verican_tx_outcome {
  VERICAN_TX_SENT = 0,
  VERICAN_TX_ABORTED = 1,  /**< taken back before it was sent; not on the bus */
  VERICAN_TX_FAILED = 2,   /**< one-shot: lost arbitration or met an error */
  VERICAN_TX_WITHDRAWN = 3 /**< taken back without `abort`: may still be on the bus now, or, a
                              one-shot, have just got out */
} verican_tx_outcome_t;

/** The end of a transmission. */
typedef struct verican_tx_event {
  /** Start of the identifier if sent, else of the report, in bit times; of the report also if the
   * end of the frame came within a verican_abort() without `abort`. */
  uint64_t timestamp;
  uint8_t mailbox; /**< as verican_send() told it; free again */
  verican_tx_outcome_t outcome;
  uint64_t time_ns; /**< sent: stamp of the time unit less its latency; 0 without the unit */
} verican_tx_event_t;

typedef struct verican verican_t;

/**
 * Called from verican_irq_handler(); on_sent also from verican_abort(), under the lock, and from
 * verican_stop(), on_state and on_error also from verican_poll(), verican_recover(),
 * verican_get_status() and verican_stop(), on_receive also from verican_stop(). Any may be NULL.
 * All may call the driver's other functions, but not verican_irq_handler(). In verican_stop() the
 * device is neither started nor stopped: what needs one of the two is VERICAN_ERR_STATE there.
 */
typedef struct verican_callbacks {
  /** A mailbox is free again. */
  void (*on_sent)(void *user, verican_t *dev, const verican_tx_event_t *event);
  /** The error state has changed. */
  void (*on_state)(void *user, verican_t *dev, verican_state_t state);
  /** New frames wait for verican_receive(). */
  void (*on_receive)(void *user, verican_t *dev);
  /** Bus errors happened, VERICAN_ERROR_*. Given: each error of the bus interrupts. */
  void (*on_error)(void *user, verican_t *dev, uint8_t errors);
  void *user;
} verican_callbacks_t;

/** Everything verican_init() wants to know. Start from verican_config_default(). */
typedef struct verican_config {
  verican_port_t port;
  uint32_t clock_hz;              /**< the core's clock */
  uint32_t bitrate;               /**< bit/s */
  uint16_t sample_point;          /**< per mille; 0: see verican_timing_find() */
  const verican_timing_t *timing; /**< explicit timing instead of the two above, or NULL */
  /**
   * Mailboxes of the core: 16, 32 or 64. 0: ask the core's extension page. With a number the
   * extension page is never touched, as a FlexCAN of another maker has none.
   */
  uint8_t mailboxes;
  uint8_t tx_mailboxes; /**< how many transmit, 1.. ; they are the last ones */
  verican_mode_t mode;
  verican_rx_mode_t rx_mode;
  verican_fifo_format_t fifo_format;
  verican_tx_order_t tx_order;
  verican_bus_off_policy_t bus_off;
  uint32_t bus_off_delay_ms; /**< for VERICAN_BUS_OFF_DELAYED */
  bool abort;                /**< aborts are certain of their outcome (MCR.AEN) */
  bool one_shot;             /**< no repetition of frames that fail; needs the extension page */
  bool fd_tolerant;          /**< ignores CAN FD frames; needs the extension page */
  bool self_reception;       /**< receives its own frames too; always so in loop-back */
  bool triple_sampling;      /**< majority of three samples a bit */
  verican_frame_t *rx_ring;  /**< memory of the caller for received frames */
  uint16_t rx_ring_size;     /**< frames in it, 2..; one place stays free */
  verican_callbacks_t callbacks;
} verican_config_t;

/** Counts of events since verican_init(). */
typedef struct verican_stats {
  uint32_t received; /**< frames put into the ring */
  uint32_t sent;
  uint32_t aborted;      /**< aborted, withdrawn or failed */
  uint32_t rx_dropped;   /**< frames lost because the ring was full */
  uint32_t rx_overruns;  /**< mailboxes overwritten, or times the FIFO was too full for a frame */
  uint32_t error_events; /**< interrupts and polls that found a bus error */
  uint32_t bus_offs;
} verican_stats_t;

/** A snapshot of the node. */
typedef struct verican_status {
  verican_state_t state;
  uint8_t tec;         /**< transmit error counter */
  uint8_t rec;         /**< receive error counter */
  uint8_t last_errors; /**< VERICAN_ERROR_* of the latest bus error seen; several may add up */
  bool synchronised;   /**< takes part in the bus (not integrating) */
  verican_timing_t timing;
  verican_stats_t stats;
} verican_status_t;

/** Which frames a filter accepts. */
typedef enum verican_select {
  VERICAN_SELECT_ONLY_0 = 0, /**< standard frames; data frames */
  VERICAN_SELECT_ONLY_1 = 1, /**< extended frames; remote frames */
  VERICAN_SELECT_BOTH = 2
} verican_select_t;

/** A filter: accepts a frame if its identifier equals `id` in every bit that is 1 in `mask`. */
typedef struct verican_filter {
  uint32_t id;          /**< right-aligned, 29 bits if ide is ONLY_1, else 11 */
  uint32_t mask;        /**< aligned as id; 0: all */
  verican_select_t ide; /**< BOTH: id and mask are the 11 most significant bits of either format */
  verican_select_t rtr;
} verican_filter_t;

/* ---- The device ------------------------------------------------------------------------------ */

/** One core. The members are the driver's own. */
struct verican {
  uint32_t life;
  verican_port_t port;
  verican_callbacks_t callbacks;
  verican_timing_t timing;
  verican_stats_t stats;
  verican_frame_t *ring;
  volatile uint16_t ring_head; /* written by the handler */
  volatile uint16_t ring_tail; /* written by verican_receive() */
  uint16_t ring_size;
  uint16_t batch; /* frames behind ring_head that are not visible yet */
  uint64_t time;  /* latest TIMER value or time stamp seen, extended */
  uint32_t mcr;   /* besides the mode requests */
  uint32_t ctrl;  /* besides interrupts and recovery */
  uint32_t ctrl2;
  uint32_t rx_mask[2];    /* mailboxes that receive, as IMASK1 and IMASK2 */
  uint32_t tx_pending[2]; /* mailboxes that hold a frame to send */
  uint32_t tx_taken_back[2];
  uint32_t tx_once[2]; /* sent with VERICAN_FRAME_ONE_SHOT */
  uint32_t bus_off_delay_ms;
  uint32_t bus_off_since_ms;
  uint8_t num_mb;
  uint8_t first_tx;
  uint8_t mode;
  uint8_t rx_mode;
  uint8_t fifo_format;
  uint8_t tx_order;
  uint8_t bus_off;
  uint8_t state;
  uint8_t told; /* the state that on_state was told last */
  uint8_t last_errors;
  uint8_t rffn;
  bool abort;
  bool extension;
  bool frame_one_shot; /* the core takes VERICAN_FRAME_ONE_SHOT */
  bool eacen;          /* mailboxes compare IDE and RTR under their mask */
  bool own_masks;      /* RXIMR: each mailbox has a mask of its own */
  bool recovering;     /* BOFF_REC is clear on request */
  bool bus_off_timing; /* bus_off_since_ms is valid */
  bool bus_off_untold; /* comes before the state, which may have changed since */
  bool telling;        /* on_state is under way */
  bool self_reception;
  bool time_unit;
  bool pps;           /* verican_clock_pps() is on */
  uint8_t rx_latency; /* of stamps, half clocks */
  uint8_t tx_latency;
  uint32_t half_clock; /* 1/256 ns */
  uint64_t increment;  /* TINCN and TINCF, which cannot be read back */
  void (*on_clock)(void *user, verican_t *dev, uint32_t flags, uint64_t time_ns);
  void *clock_user;
};

/** Fills `config` with: detected mailboxes, 8 of them to transmit, everything else 0. */
verican_result_t verican_config_default(verican_config_t *config);

/**
 * Resets the core and configures it; it accepts every frame until verican_set_filters() says
 * otherwise. The device is stopped afterwards. `dev` and the ring must stay where they are.
 * VERICAN_ERR_NULL: dev, config, no way to the registers, or no ring. VERICAN_ERR_RANGE: a member
 * of `config`. VERICAN_ERR_TIMING: see verican_timing_find(). VERICAN_ERR_SPACE: the core has not
 * that many mailboxes. VERICAN_ERR_DEVICE: no extension page, or settings do not stay.
 * VERICAN_ERR_UNSUPPORTED: FIFO, abort, priorities, sending in order, one-shot or FD tolerance are
 * not in this core.
 * VERICAN_ERR_TIMEOUT. What is wrong in `config` itself changes nothing, a device that runs goes
 * on; after any other error the device is not initialised.
 */
verican_result_t verican_init(verican_t *dev, const verican_config_t *config);

/**
 * Leaves the bus and puts the core into its disable mode. VERICAN_ERR_TIMEOUT; VERICAN_ERR_STATE in
 * a callback of verican_stop().
 */
verican_result_t verican_deinit(verican_t *dev);

/** Joins the bus, with interrupts enabled in the core. Device must be stopped. VERICAN_ERR_TIMEOUT.
 */
verican_result_t verican_start(verican_t *dev);

/**
 * Leaves the bus after the frame under way; frames not sent are given up (VERICAN_TX_ABORTED).
 * Frames in the ring stay. Device must be started. VERICAN_ERR_TIMEOUT: the core does not stop, the
 * device counts as started and goes on.
 */
verican_result_t verican_stop(verican_t *dev);

/** Another mode. Device must be stopped. */
verican_result_t verican_set_mode(verican_t *dev, verican_mode_t mode);

/** Another bit timing, see verican_timing_check(). Device must be stopped. */
verican_result_t verican_set_timing(verican_t *dev, uint32_t clock_hz,
                                    const verican_timing_t *timing);

/**
 * Accepts exactly the frames that match one of `count` filters; 0 filters: none. Device must be
 * stopped. VERICAN_ERR_RANGE: a filter that this filter hardware cannot express exactly (see
 * docs/driver.md). VERICAN_ERR_SPACE: too many. VERICAN_ERR_UNSUPPORTED: remote frames in the
 * mailboxes of a core without CTRL2; filters with different masks in a core without masks for each
 * mailbox. After an error the old filters are in force.
 */
verican_result_t verican_set_filters(verican_t *dev, const verican_filter_t *filters,
                                     uint16_t count);

/* ---- Sending --------------------------------------------------------------------------------- */

/**
 * Hands a frame to a free transmit mailbox, whose number goes to `mailbox` unless that is NULL.
 * Device must be started and not listen-only. VERICAN_ERR_BUSY: none is free (with
 * VERICAN_TX_IN_ORDER: none that keeps the order). VERICAN_ERR_RANGE: identifier, flags, DLC or
 * priority. VERICAN_ERR_UNSUPPORTED: VERICAN_FRAME_ONE_SHOT is not in this core.
 */
verican_result_t verican_send(verican_t *dev, const verican_frame_t *frame, uint8_t *mailbox);

/** verican_send() through a certain transmit mailbox. VERICAN_ERR_BUSY: it holds a frame. */
verican_result_t verican_send_in(verican_t *dev, const verican_frame_t *frame, uint8_t mailbox);

/**
 * Takes a frame back. on_sent tells how it ended: with config.abort in time from this call or from
 * the handler, VERICAN_TX_ABORTED or VERICAN_TX_SENT; without, at once VERICAN_TX_WITHDRAWN, or
 * VERICAN_TX_SENT if it was out already. VERICAN_ERR_EMPTY: the mailbox holds no frame.
 */
verican_result_t verican_abort(verican_t *dev, uint8_t mailbox);

/** Number of frames that wait in transmit mailboxes. */
verican_result_t verican_tx_waiting(const verican_t *dev, uint8_t *count);

/**
 * verican_send() not before `time_ns` of the time unit's clock: until then the frame gives way to
 * all others of this node. One frame at a time. VERICAN_ERR_RANGE also: more than 2 s ahead.
 * VERICAN_ERR_BUSY also: another frame waits for its time. VERICAN_ERR_UNSUPPORTED: no time unit.
 */
verican_result_t verican_send_at(verican_t *dev, const verican_frame_t *frame, uint64_t time_ns,
                                 uint8_t *mailbox);

/** One-shot mode on or off for frames not started yet. VERICAN_ERR_UNSUPPORTED. */
verican_result_t verican_set_one_shot(verican_t *dev, bool on);

/* ---- Receiving ------------------------------------------------------------------------------- */

/** Takes the oldest frame out of the ring. VERICAN_ERR_EMPTY. Allowed when stopped, too. */
verican_result_t verican_receive(verican_t *dev, verican_frame_t *frame);

/** Number of frames in the ring. */
verican_result_t verican_rx_waiting(const verican_t *dev, uint16_t *count);

/* ---- Service --------------------------------------------------------------------------------- */

/**
 * The interrupt handler: call it when the core's interrupt line is high. Moves received frames into
 * the ring in the order of the bus, ends transmissions, follows the error state.
 * VERICAN_ERR_EMPTY: the core had nothing to say (a shared line).
 */
verican_result_t verican_irq_handler(verican_t *dev);

/**
 * To be called now and then, at least every 32,767 bit times: keeps the 64-bit time right, sees the
 * error state improve, and runs the delay after bus-off. `now_ms`: a clock of the caller that wraps
 * at 2^32. Device must be started.
 */
verican_result_t verican_poll(verican_t *dev, uint32_t now_ms);

/** The time in bit times since verican_start() (first of all), to 64 bits. Device must be started.
 */
verican_result_t verican_time(verican_t *dev, uint64_t *bits);

/** Reads the state. Allowed when stopped, too. */
verican_result_t verican_get_status(verican_t *dev, verican_status_t *status);

/** Leaves bus-off: 128 x 11 recessive bits after entering it at the earliest. Must be in bus-off.
 */
verican_result_t verican_recover(verican_t *dev);

/* ---- Self-test ------------------------------------------------------------------------------- */

/** The part of the self-test that failed. */
typedef enum verican_test_step {
  VERICAN_TEST_PASSED = 0,
  VERICAN_TEST_MEMORY = 1,    /**< a word of the buffer memory does not keep its value */
  VERICAN_TEST_LOOP_BACK = 2, /**< a frame did not come back */
  VERICAN_TEST_FRAME = 3      /**< a frame came back changed */
} verican_test_step_t;

/** Where a self-test failed. */
typedef struct verican_test_report {
  verican_test_step_t step;
  uint32_t where;    /**< offset of the word, or number of the frame from 0 on */
  uint32_t expected; /**< word */
  uint32_t found;    /**< word */
} verican_test_report_t;

/**
 * Tests the buffer memory and, in loop-back (the pins stay idle), sending and receiving frames of
 * every length and both formats. Device must be stopped; it is as before afterwards, except for its
 * statistics. `report` may be NULL. VERICAN_ERR_SELF_TEST: a difference, see `report`.
 * VERICAN_ERR_TIMEOUT: a mode change was not acknowledged.
 */
verican_result_t verican_self_test(verican_t *dev, verican_test_report_t *report);

/** The name of a result, for messages; "unknown" for other values. */
const char *verican_result_name(verican_result_t result);

#ifdef __cplusplus
}
#endif

#endif /* VERICAN_VERICAN_H */

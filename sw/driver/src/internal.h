/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the parts of the driver share: register access, argument checks, and each other's functions.
 */
#ifndef VERICAN_SRC_INTERNAL_H
#define VERICAN_SRC_INTERNAL_H

#include "verican/verican.h"
#include "verican/verican_regs.h"

/* Keeps the compiler from moving accesses to the ring across its indices. */
#ifndef VERICAN_BARRIER
#ifdef __GNUC__
#define VERICAN_BARRIER() __asm__ volatile("" ::: "memory")
#else
#error "define VERICAN_BARRIER as the compiler barrier of this compiler"
#endif
#endif

/* verican_t.life: recognises a device that verican_init() has not seen. */
#define VERICAN_LIFE_STOPPED 0x56434E01u
#define VERICAN_LIFE_STARTED 0x56434E02u
#define VERICAN_LIFE_STOPPING 0x56434E03u /* in verican_stop(): neither of the two */

/* TCTRL with a pulse a second. */
#define VERICAN_PPS_PARTS (VERICAN_TCTRL_CMPEN_MASK | VERICAN_TCTRL_OUTEN_MASK)

/* Codes in the C/S word of a message buffer (flexcan.md 3.2). */
#define CS_CODE(code) VERICAN_MB_CS_CODE_SET(VERICAN_MB_CS_CODE_##code)
#define CS_RX_BUSY 0x01000000u /* bit: a move is under way */

/* Bits 31 and 30 of an individual mask (flexcan.md 1.9). */
#define MASK_RTR 0x80000000u
#define MASK_IDE 0x40000000u

#define ESR_FLAGS                                                                         \
  (VERICAN_ESR1_TWRN_INT_MASK | VERICAN_ESR1_RWRN_INT_MASK | VERICAN_ESR1_BOFF_INT_MASK | \
   VERICAN_ESR1_ERR_INT_MASK | VERICAN_ESR1_WAK_INT_MASK)

/* The register with the mask of a mailbox; without masks of their own all have the same, but 14 and
 * 15, whose registers follow it. */
static inline uint32_t verican_mask_offset(const verican_t *dev, unsigned mb) {
  return dev->own_masks ? VERICAN_RXIMR_OFFSET(mb) : VERICAN_RXGMASK_OFFSET;
}
static inline uint32_t verican_bit(unsigned mb) { return (uint32_t)1 << (mb % 32u); }

static inline bool verican_alive(const verican_t *dev) {
  return dev->life == VERICAN_LIFE_STOPPED || dev->life == VERICAN_LIFE_STARTED ||
         dev->life == VERICAN_LIFE_STOPPING;
}

/* VERICAN_OK if `dev` is an initialised, a stopped or a started device; one that is being stopped
 * is the first alone. */
static inline verican_result_t verican_check(const verican_t *dev) {
  if (dev == NULL) return VERICAN_ERR_NULL;
  return verican_alive(dev) ? VERICAN_OK : VERICAN_ERR_STATE;
}
static inline verican_result_t verican_check_stopped(const verican_t *dev) {
  if (dev == NULL) return VERICAN_ERR_NULL;
  return dev->life == VERICAN_LIFE_STOPPED ? VERICAN_OK : VERICAN_ERR_STATE;
}
static inline verican_result_t verican_check_started(const verican_t *dev) {
  if (dev == NULL) return VERICAN_ERR_NULL;
  return dev->life == VERICAN_LIFE_STARTED ? VERICAN_OK : VERICAN_ERR_STATE;
}

/* io.c */
uint32_t verican_read(const verican_t *dev, uint32_t offset);
void verican_write(const verican_t *dev, uint32_t offset, uint32_t value);
/* Polls until (register & mask) == value. */
verican_result_t verican_wait(const verican_t *dev, uint32_t offset, uint32_t mask, uint32_t value);
/* The flag of a mailbox. */
bool verican_is_flagged(const verican_t *dev, unsigned mb);
void verican_clear_flag(const verican_t *dev, unsigned mb);
uint32_t verican_lock_port(const verican_port_t *port);
uint32_t verican_lock(const verican_t *dev);
void verican_unlock(const verican_t *dev, uint32_t token);

/* mode.c */
/* Leaves disable mode, resets, and ends in freeze mode. */
verican_result_t verican_reset_core(const verican_t *dev);
verican_result_t verican_freeze(const verican_t *dev);
verican_result_t verican_unfreeze(const verican_t *dev);
/* Writes MCR and CTRL as dev->mcr and dev->ctrl say; in freeze mode. */
void verican_write_settings(const verican_t *dev);
/* dev->mcr and dev->ctrl for the mode. */
void verican_apply_mode(verican_t *dev, verican_mode_t mode);

/* timing.c */
/* Clocks of a bit. */
uint32_t verican_bit_clocks(const verican_timing_t *timing);
/* The timing in CTRL. */
uint32_t verican_timing_bits(const verican_timing_t *timing);

/* fifo_filter.c */
verican_result_t verican_set_fifo_filters(verican_t *dev, const verican_filter_t *filters,
                                          unsigned count);
/* filter.c */
verican_result_t verican_accept_all(verican_t *dev);

/* rx.c */
/* Moves what has been received into the ring; true if anything was. */
bool verican_rx_mailboxes(verican_t *dev, const uint32_t flags[2]);
/* fifo.c */
bool verican_rx_fifo(verican_t *dev, uint32_t flags);
/* ring.c */
void verican_ring_insert(verican_t *dev, const verican_frame_t *frame);
/* Makes the inserted frames visible; true if there were any. */
bool verican_ring_commit(verican_t *dev);

/* frame.c */
/* Frame of the C/S and ID words; data is read from the buffer at `mb`. */
void verican_frame_read(verican_t *dev, unsigned mb, uint32_t cs, verican_frame_t *frame);
void verican_frame_write(const verican_t *dev, unsigned mb, const verican_frame_t *frame);
verican_result_t verican_frame_check(const verican_frame_t *frame);

/* tx.c */
bool verican_is_pending(const verican_t *dev, unsigned mb);
/* Also forgets that the frame was taken back, and that it was a one-shot. */
void verican_set_pending(verican_t *dev, unsigned mb, bool on);
/* Frees the mailbox, with the launch that waits for its frame, and counts. All in one section: a
 * callback of the handler may give the mailbox its next frame and launch right behind it. */
void verican_tx_end(verican_t *dev, unsigned mb, verican_tx_outcome_t outcome);
void verican_tx_tell(verican_t *dev, unsigned mb, verican_tx_outcome_t outcome, uint64_t timestamp,
                     uint64_t time_ns);
/* Ends the transmissions of the flagged mailboxes; true if there were any. */
bool verican_tx_serve(verican_t *dev, const uint32_t flags[2]);
/* Gives up all that waits; the core is in freeze mode. */
void verican_tx_drop_all(verican_t *dev);

/* abort.c */
/* Behind a code TX_ABORT that was written: waits for the flag; false: there is none. */
bool verican_abort_flagged(const verican_t *dev, unsigned mb);

/* time.c */
/* Extends 16 bits of TIMER to 64 and remembers the latest. */
uint64_t verican_extend(verican_t *dev, uint32_t stamp);
uint64_t verican_now(verican_t *dev);

/* stamp.c */
/* Ends what a soft reset and MDIS keep: a launch that waits would hold a mailbox, an event
 * interrupt for nobody. TCTRL as it is now. */
uint32_t verican_stamp_quiet(const verican_t *dev);
/* Finds out about the time unit, if the core has one, and sets its rate for the clock. */
void verican_stamp_init(verican_t *dev, uint32_t xconfig, uint32_t clock_hz);
/* The latencies of stamps as TCTRL has them now. */
void verican_stamp_latencies(verican_t *dev, uint32_t tctrl);
/* The whole ns of so many half clocks. */
uint64_t verican_half_clocks(const verican_t *dev, uint8_t half_clocks);
/* The stamp in the row of a mailbox less its latency; 0 without the unit. */
uint64_t verican_stamp(const verican_t *dev, unsigned mb, uint8_t latency);
/* clock.c */
uint64_t verican_read_pair(const verican_t *dev, uint32_t low);
void verican_write_pair(const verican_t *dev, uint32_t first, uint32_t low, uint32_t high);

/* Writes the increment, and keeps it. */
void verican_write_rate(verican_t *dev, uint64_t increment);

/* irq.c */
bool verican_serve(verican_t *dev);

/* state.c */
/* Reads and clears ESR, follows the state, calls back; returns ESR. */
uint32_t verican_state_serve(verican_t *dev);
/* Tells what on_state does not know yet. */
void verican_state_tell(verican_t *dev);
/* CTRL with the interrupt masks that the state needs. */
void verican_write_ctrl(const verican_t *dev);

#endif /* VERICAN_SRC_INTERNAL_H */

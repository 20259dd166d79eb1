/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A time domain on a core: the follower (TM-51, TM-80, TM-89), and both sides of the measurement of
 * the delay (TM-58).
 */
#include "tsyn_device.h"

static uint32_t id_of(const verican_frame_t *frame) {
  return frame->id | ((frame->flags & VERICAN_FRAME_EXTENDED) != 0u ? VERICAN_TSYN_EXTENDED : 0u);
}

/* The place of a master, or VERICAN_MASTER_NONE. */
static uint8_t rank_of(const verican_tsyn_t *tsyn, uint32_t id) {
  for (uint8_t rank = 0; rank < tsyn->config.master_count; ++rank)
    if (tsyn->config.masters[rank] == id) return rank;
  return VERICAN_MASTER_NONE;
}

static void apply(verican_tsyn_t *tsyn, const verican_correction_t *correction) {
  if ((correction->events & VERICAN_SERVO_ACCEPTED) == 0u) return;
  /* Also where it is as before: it may have been upset. */
  (void)verican_clock_rate(tsyn->dev, correction->increment);
  if (correction->shift == 0) return;
  /* With a shift, what is left of a slew by now is an upset's: it would go on for minutes. */
  (void)verican_clock_slew(tsyn->dev, correction->slew ? (int32_t)correction->shift : 0);
  if (!correction->slew) (void)verican_clock_shift(tsyn->dev, correction->shift);
  verican_masters_shift(&tsyn->masters, correction->shift);
  tsyn->receiver.stamp += (uint64_t)correction->shift;
  tsyn->latest += (uint64_t)correction->shift;
  tsyn->shift = correction->shift;
}

/* A request under way was stamped by a clock that is not the same any more. One that still waits
 * for the bus is that of this pair: answers to two could not be told from each other. Where the
 * device was initialised anew, none waits, and its end is never told. */
static void ask_for_delay(verican_tsyn_t *tsyn, const verican_sync_pair_t *pair,
                          const verican_correction_t *correction) {
  const uint64_t latency = verican_half_clocks(tsyn->dev, tsyn->dev->rx_latency);
  if (!verican_delay_pair(&tsyn->delay, pair, correction->shift - (int64_t)latency)) return;
  if (tsyn->delaying && verican_is_pending(tsyn->dev, tsyn->delay_mailbox)) return;
  const uint32_t token = verican_lock(tsyn->dev);
  tsyn->delaying =
      verican_tsyn_send(tsyn, tsyn->config.delay_request, NULL, &tsyn->delay_mailbox) == VERICAN_OK;
  verican_unlock(tsyn->dev, token);
}

/* The servo wants the stamp as it was read. */
static void correct(verican_tsyn_t *tsyn, verican_sync_pair_t *pair) {
  verican_correction_t correction;
  pair->latency = tsyn->dev->rx_latency;
  pair->increment = tsyn->dev->increment;
  if (verican_clock_get(tsyn->dev, &pair->now) != VERICAN_OK) return;
  (void)verican_servo_pair(&tsyn->servo, pair, &correction);
  apply(tsyn, &correction);
  if ((correction.events & VERICAN_SERVO_ACCEPTED) != 0u) ask_for_delay(tsyn, pair, &correction);
  if (tsyn->config.on_event != NULL)
    tsyn->config.on_event(tsyn->config.user, tsyn, correction.events);
}

/* Whether frames of this master count now. A SYNC may make it the one that is followed. */
static bool is_followed(verican_tsyn_t *tsyn, uint8_t rank, bool sync, uint64_t stamp) {
  if (!sync) return rank == tsyn->masters.current;
  const bool best = verican_masters_hear(&tsyn->masters, rank, stamp);
  if (tsyn->sending) {
    if (rank >= tsyn->config.rank) return false;
    verican_tsyn_yield(tsyn, stamp);
  }
  if (!best || rank == tsyn->masters.current) return best;
  tsyn->masters.current = rank;
  tsyn->receiver.seen = false;
  tsyn->receiver.waiting = false;
  return verican_servo_forget(&tsyn->servo) == VERICAN_OK;
}

static void take_message(verican_tsyn_t *tsyn, const verican_frame_t *frame, uint8_t rank) {
  const verican_tsyn_rules_t *rules = &tsyn->config.rules;
  const uint8_t dlc = (frame->flags & VERICAN_FRAME_REMOTE) != 0u ? 0u : frame->dlc;
  const uint64_t stamp = frame->time_ns + verican_half_clocks(tsyn->dev, tsyn->dev->rx_latency);
  verican_tsyn_cause_t cause;
  verican_tsyn_look(tsyn, stamp);
  const bool sync = verican_tsyn_is_sync(rules, frame->data, dlc, &cause);
  if (!is_followed(tsyn, rank, sync, stamp)) return;
  verican_sync_pair_t pair;
  const uint64_t silence = tsyn->servo.config.hold_after * tsyn->masters.interval;
  if (verican_tsyn_receive(&tsyn->receiver, rules, frame->data, dlc, stamp, silence, &pair) ==
      VERICAN_TSYN_PAIR)
    correct(tsyn, &pair);
}

/* The master answers a request; the follower that asked takes the response. */
static bool take_delay(verican_tsyn_t *tsyn, const verican_frame_t *frame, uint32_t id) {
  const verican_tsyn_config_t *config = &tsyn->config;
  if (config->delay_request == config->delay_response) return false;
  if (id == config->delay_request && tsyn->sending) {
    uint8_t data[8];
    verican_p4_write_time(frame->time_ns, data);
    (void)verican_tsyn_send(tsyn, config->delay_response, data, NULL);
    return true;
  }
  const bool remote = (frame->flags & VERICAN_FRAME_REMOTE) != 0u;
  if (id != config->delay_response || frame->dlc != 8u || remote) return false;
  (void)verican_delay_response(&tsyn->delay, verican_p4_read_time(frame->data),
                               &tsyn->servo.config.delay_ns);
  return true;
}

verican_result_t verican_tsyn_on_frame(verican_tsyn_t *tsyn, const verican_frame_t *frame) {
  const verican_result_t result = verican_tsyn_check(tsyn);
  if (result != VERICAN_OK) return result;
  if (frame == NULL) return VERICAN_ERR_NULL;
  const uint32_t id = id_of(frame);
  const uint8_t rank = rank_of(tsyn, id);
  if (rank == VERICAN_MASTER_NONE)
    return take_delay(tsyn, frame, id) ? VERICAN_OK : VERICAN_ERR_EMPTY;
  take_message(tsyn, frame, rank);
  return VERICAN_OK;
}

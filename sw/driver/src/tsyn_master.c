/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A time domain on a core: the master (TM-50, TM-89).
 */
#include "tsyn_device.h"

/* A candidate that cannot send so often is cut off: others take over meanwhile. */
enum { UNSENT_LIMIT = 3 };

verican_result_t verican_tsyn_send(verican_tsyn_t *tsyn, uint32_t id, const uint8_t *data,
                                   uint8_t *mailbox) {
  verican_frame_t frame = {0};
  frame.id = id & ~VERICAN_TSYN_EXTENDED;
  if ((id & VERICAN_TSYN_EXTENDED) != 0u) frame.flags = VERICAN_FRAME_EXTENDED;
  if (data != NULL) {
    frame.dlc = 8;
    for (unsigned i = 0; i < 8u; ++i) frame.data[i] = data[i];
  }
  return verican_send(tsyn->dev, &frame, mailbox);
}

static bool send_own(verican_tsyn_t *tsyn, const uint8_t *data, uint8_t *mailbox) {
  const uint32_t id = tsyn->config.masters[tsyn->config.rank];
  return verican_tsyn_send(tsyn, id, data, mailbox) == VERICAN_OK;
}

/* Under lock, so that the handler does not report a SYNC that is not noted yet. False: there is no
 * mailbox. */
static bool send_sync(verican_tsyn_t *tsyn, uint64_t now) {
  uint8_t data[8];
  const verican_tsyn_sender_t before = tsyn->sender;
  const uint32_t token = verican_lock(tsyn->dev);
  verican_tsyn_write_sync(&tsyn->sender, &tsyn->config.rules, now, data);
  const bool out = send_own(tsyn, data, &tsyn->sync_mailbox);
  if (out)
    tsyn->step = (uint8_t)TSYN_SYNC_OUT;
  else
    tsyn->sender = before;
  verican_unlock(tsyn->dev, token);
  return out;
}

/* FUP, as soon as there is a mailbox for it. */
static void send_fup(verican_tsyn_t *tsyn) {
  uint8_t data[8];
  const uint32_t token = verican_lock(tsyn->dev);
  if (tsyn->step == (uint8_t)TSYN_SYNC_SENT &&
      (!verican_tsyn_write_fup(&tsyn->sender, &tsyn->config.rules, tsyn->t1, data) ||
       send_own(tsyn, data, NULL)))
    tsyn->step = (uint8_t)TSYN_IDLE;
  verican_unlock(tsyn->dev, token);
}

/* Aborts SYNC; without that feature its late end is nobody's. Under lock: were SYNC to end first,
 * the abort would hit the next frame of its mailbox, which may be its own FUP. */
static void give_up_sync(verican_tsyn_t *tsyn) {
  const uint32_t token = verican_lock(tsyn->dev);
  const bool out = tsyn->step == (uint8_t)TSYN_SYNC_OUT;
  tsyn->step = (uint8_t)TSYN_IDLE;
  if (out) (void)verican_abort(tsyn->dev, tsyn->sync_mailbox);
  verican_unlock(tsyn->dev, token);
}

void verican_tsyn_yield(verican_tsyn_t *tsyn, uint64_t now) {
  give_up_sync(tsyn);
  tsyn->sending = false;
  tsyn->masters.since = now;
}

/* From a worse master a candidate takes over with its time only. */
static bool may_begin(const verican_tsyn_t *tsyn, uint64_t now) {
  if (!verican_masters_may_send(&tsyn->masters, tsyn->config.rank, now)) return false;
  return !verican_masters_alive(&tsyn->masters, now) ||
         tsyn->servo.state == (uint8_t)VERICAN_SYNC_LOCKED;
}

static void begin(verican_tsyn_t *tsyn, uint64_t now) {
  tsyn->sending = true;
  tsyn->unsent = 0;
  tsyn->next = now;
  tsyn->masters.current = VERICAN_MASTER_NONE;
}

/* R has passed without SYNC. */
static void miss(verican_tsyn_t *tsyn, uint64_t now) {
  give_up_sync(tsyn);
  if (++tsyn->unsent < (uint8_t)UNSENT_LIMIT || tsyn->config.master_count == 1u) return;
  verican_tsyn_yield(tsyn, now);
  tsyn->cut = true;
}

/* Who was cut off must not come back with a time that has drifted: a frame without data, which is
 * no message, tells when the bus is there again. Then the candidate listens first. */
static void probe(verican_tsyn_t *tsyn) {
  const uint32_t token = verican_lock(tsyn->dev);
  if (tsyn->step != (uint8_t)TSYN_PROBING && send_own(tsyn, NULL, &tsyn->sync_mailbox))
    tsyn->step = (uint8_t)TSYN_PROBING;
  verican_unlock(tsyn->dev, token);
}

void verican_tsyn_run_master(verican_tsyn_t *tsyn, uint64_t now) {
  if (tsyn->cut) {
    probe(tsyn);
    return;
  }
  if (!tsyn->sending && may_begin(tsyn, now)) begin(tsyn, now);
  if (!tsyn->sending) return;
  const uint64_t interval = tsyn->masters.interval;
  if (tsyn->step == (uint8_t)TSYN_SYNC_SENT) send_fup(tsyn);
  if (tsyn->step == (uint8_t)TSYN_SYNC_OUT && now - tsyn->t0 > interval) miss(tsyn, now);
  if (!tsyn->sending || tsyn->step == (uint8_t)TSYN_SYNC_OUT) return;
  if ((int64_t)(now - tsyn->next) < 0) return;
  const uint64_t due = now - tsyn->next > interval ? now : tsyn->next;
  if (!send_sync(tsyn, now)) return; /* the next poll tries again */
  tsyn->t0 = now;
  tsyn->next = due + interval;
}

static void end_of_sync(verican_tsyn_t *tsyn, const verican_tx_event_t *event, bool sent) {
  if (tsyn->step == (uint8_t)TSYN_PROBING) {
    tsyn->step = (uint8_t)TSYN_IDLE;
    if (sent) tsyn->masters.since = event->time_ns;
    tsyn->cut = !sent;
    return;
  }
  tsyn->t1 = event->time_ns;
  tsyn->step = (uint8_t)(sent ? TSYN_SYNC_SENT : TSYN_IDLE);
  tsyn->unsent = 0;
  send_fup(tsyn);
}

verican_result_t verican_tsyn_on_sent(verican_tsyn_t *tsyn, const verican_tx_event_t *event) {
  const verican_result_t result = verican_tsyn_check(tsyn);
  if (result != VERICAN_OK) return result;
  if (event == NULL) return VERICAN_ERR_NULL;
  const bool sent = event->outcome == VERICAN_TX_SENT;
  const bool out = tsyn->step == (uint8_t)TSYN_SYNC_OUT || tsyn->step == (uint8_t)TSYN_PROBING;
  if (out && event->mailbox == tsyn->sync_mailbox) {
    end_of_sync(tsyn, event, sent);
  } else if (tsyn->delaying && event->mailbox == tsyn->delay_mailbox) {
    tsyn->delaying = false;
    if (sent) verican_delay_sent(&tsyn->delay, event->time_ns);
  } else {
    return VERICAN_ERR_EMPTY;
  }
  return VERICAN_OK;
}

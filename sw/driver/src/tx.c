/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Transmission through mailboxes, abort and completion (flexcan.md 3.3 and 3.4).
 */
#include "internal.h"

/* Launch times have 32 bits: 2^31 ns at most. */
#define AT_MOST_AHEAD ((uint64_t)2000000000)

bool verican_is_pending(const verican_t *dev, unsigned mb) {
  return (dev->tx_pending[mb / 32u] & verican_bit(mb)) != 0u;
}

void verican_set_pending(verican_t *dev, unsigned mb, bool on) {
  if (on) {
    dev->tx_pending[mb / 32u] |= verican_bit(mb);
  } else {
    dev->tx_pending[mb / 32u] &= ~verican_bit(mb);
  }
  dev->tx_taken_back[mb / 32u] &= ~verican_bit(mb);
  dev->tx_once[mb / 32u] &= ~verican_bit(mb);
}

/* The free mailbox for the next frame, or num_mb. To keep the order of frames, where the lowest
 * mailbox goes first, it lies above all those that wait. */
static unsigned choose(const verican_t *dev) {
  unsigned chosen = dev->num_mb;
  for (unsigned mb = dev->num_mb; mb-- > dev->first_tx;) {
    if (!verican_is_pending(dev, mb)) {
      chosen = mb;
    } else if (dev->tx_order == (uint8_t)VERICAN_TX_IN_ORDER) {
      break;
    }
  }
  return chosen;
}

static verican_result_t check_takes_part(const verican_t *dev) {
  const verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  return dev->mode != (uint8_t)VERICAN_MODE_LISTEN_ONLY ? VERICAN_OK : VERICAN_ERR_STATE;
}

static verican_result_t check_send(const verican_t *dev, const verican_frame_t *frame) {
  const verican_result_t result = check_takes_part(dev);
  if (result != VERICAN_OK) return result;
  if (frame == NULL) return VERICAN_ERR_NULL;
  if ((frame->flags & VERICAN_FRAME_ONE_SHOT) != 0u && !dev->frame_one_shot)
    return VERICAN_ERR_UNSUPPORTED;
  return verican_frame_check(frame);
}

/* Under lock. A callback of the handler may have stopped the device since check_send(). */
static verican_result_t put(verican_t *dev, const verican_frame_t *frame, unsigned mb) {
  const verican_result_t result = check_takes_part(dev);
  if (result != VERICAN_OK) return result;
  if (mb >= dev->num_mb || verican_is_pending(dev, mb)) return VERICAN_ERR_BUSY;
  verican_set_pending(dev, mb, true);
  if ((frame->flags & VERICAN_FRAME_ONE_SHOT) != 0u) dev->tx_once[mb / 32u] |= verican_bit(mb);
  verican_frame_write(dev, mb, frame);
  return VERICAN_OK;
}

verican_result_t verican_send(verican_t *dev, const verican_frame_t *frame, uint8_t *mailbox) {
  verican_result_t result = check_send(dev, frame);
  if (result != VERICAN_OK) return result;
  const uint32_t token = verican_lock(dev);
  const unsigned mb = choose(dev);
  result = put(dev, frame, mb);
  if (result == VERICAN_OK && mailbox != NULL) *mailbox = (uint8_t)mb;
  verican_unlock(dev, token);
  return result;
}

/* Under lock: the buffer is held before it has the frame. */
static verican_result_t put_at(verican_t *dev, const verican_frame_t *frame, uint64_t time_ns,
                               unsigned mb) {
  const uint64_t now = verican_read_pair(dev, VERICAN_TIMELO_OFFSET);
  const bool ahead = time_ns > now;
  if (ahead && time_ns - now > AT_MOST_AHEAD) return VERICAN_ERR_RANGE;
  if ((verican_read(dev, VERICAN_TTXMB_OFFSET) & VERICAN_TTXMB_HOLD_MASK) != 0u)
    return VERICAN_ERR_BUSY;
  if (mb < dev->num_mb && ahead && check_takes_part(dev) == VERICAN_OK) {
    verican_write(dev, VERICAN_TTX_OFFSET, (uint32_t)time_ns);
    verican_write(dev, VERICAN_TTXMB_OFFSET, VERICAN_TTXMB_HOLD_MASK | mb);
  }
  return put(dev, frame, mb);
}

verican_result_t verican_send_at(verican_t *dev, const verican_frame_t *frame, uint64_t time_ns,
                                 uint8_t *mailbox) {
  verican_result_t result = check_send(dev, frame);
  if (result != VERICAN_OK) return result;
  if (!dev->time_unit) return VERICAN_ERR_UNSUPPORTED;
  const uint32_t token = verican_lock(dev);
  const unsigned mb = choose(dev);
  result = put_at(dev, frame, time_ns, mb);
  if (result == VERICAN_OK && mailbox != NULL) *mailbox = (uint8_t)mb;
  verican_unlock(dev, token);
  return result;
}

static verican_result_t check_mailbox(const verican_t *dev, unsigned mb) {
  return mb >= dev->first_tx && mb < dev->num_mb ? VERICAN_OK : VERICAN_ERR_RANGE;
}

verican_result_t verican_send_in(verican_t *dev, const verican_frame_t *frame, uint8_t mailbox) {
  verican_result_t result = check_send(dev, frame);
  if (result == VERICAN_OK) result = check_mailbox(dev, mailbox);
  if (result != VERICAN_OK) return result;
  const uint32_t token = verican_lock(dev);
  result = put(dev, frame, mailbox);
  verican_unlock(dev, token);
  return result;
}

verican_result_t verican_tx_waiting(const verican_t *dev, uint8_t *count) {
  const verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (count == NULL) return VERICAN_ERR_NULL;
  unsigned waiting = 0;
  for (unsigned mb = dev->first_tx; mb < dev->num_mb; ++mb)
    waiting += verican_is_pending(dev, mb) ? 1u : 0u;
  *count = (uint8_t)waiting;
  return VERICAN_OK;
}

/* ---- The end of a transmission ----------------------------------------------------------------
 */

/* Under lock. The launch that waits for a frame that is no more: without this the mailbox stays
 * held, and so would the next frame in it (TM-40). */
static void release(const verican_t *dev, unsigned mb) {
  if (!dev->time_unit) return;
  if (verican_read(dev, VERICAN_TTXMB_OFFSET) != (VERICAN_TTXMB_HOLD_MASK | mb)) return;
  verican_write(dev, VERICAN_TTXMB_OFFSET, mb);
}

void verican_tx_end(verican_t *dev, unsigned mb, verican_tx_outcome_t outcome) {
  const uint32_t token = verican_lock(dev);
  verican_set_pending(dev, mb, false);
  if (outcome == VERICAN_TX_SENT) {
    ++dev->stats.sent;
  } else {
    ++dev->stats.aborted;
    release(dev, mb);
  }
  verican_unlock(dev, token);
}

void verican_tx_tell(verican_t *dev, unsigned mb, verican_tx_outcome_t outcome, uint64_t timestamp,
                     uint64_t time_ns) {
  const verican_tx_event_t event = {timestamp, (uint8_t)mb, outcome, time_ns};
  if (dev->callbacks.on_sent != NULL) dev->callbacks.on_sent(dev->callbacks.user, dev, &event);
}

/* Frees a flagged mailbox. The flag is read again: a callback of one before may have stopped and
 * started the device, and the mailbox has a frame that still waits. A remote frame leaves it as a
 * receive buffer, which must not catch the answer; with MCR.AEN it takes the write only once the
 * flag is clear, and a frame may come in between the two. */
static void finish(verican_t *dev, unsigned mb) {
  if (!verican_is_flagged(dev, mb)) return;
  const uint32_t cs = verican_read(dev, VERICAN_MB_CS_OFFSET(mb));
  const uint32_t code = cs & VERICAN_MB_CS_CODE_MASK;
  const uint64_t time_ns = verican_stamp(dev, mb, dev->tx_latency);
  verican_clear_flag(dev, mb);
  if (code != CS_CODE(TX_INACTIVE)) {
    verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(TX_INACTIVE));
    verican_clear_flag(dev, mb);
  }
  if (!verican_is_pending(dev, mb)) return;
  const bool taken_back = (dev->tx_taken_back[mb / 32u] & verican_bit(mb)) != 0u;
  verican_tx_outcome_t outcome = VERICAN_TX_SENT;
  if (code == CS_CODE(TX_ABORT)) outcome = taken_back ? VERICAN_TX_ABORTED : VERICAN_TX_FAILED;
  /* Without MCR.AEN, taking back writes over the stamp. */
  const bool stamped = outcome == VERICAN_TX_SENT && (dev->abort || !taken_back);
  const uint64_t timestamp =
      stamped ? verican_extend(dev, cs & VERICAN_MB_CS_TIME_STAMP_MASK) : verican_now(dev);
  verican_tx_end(dev, mb, outcome);
  verican_tx_tell(dev, mb, outcome, timestamp, outcome == VERICAN_TX_SENT ? time_ns : 0u);
}

bool verican_tx_serve(verican_t *dev, const uint32_t flags[2]) {
  bool any = false;
  for (unsigned mb = dev->first_tx; mb < dev->num_mb; ++mb) {
    if ((flags[mb / 32u] & verican_bit(mb)) == 0u) continue;
    finish(dev, mb);
    any = true;
  }
  return any;
}

/* With MCR.AEN the core is asked, and its flag waited for: one that came behind the next start
 * would be taken for the end of the next frame, and a write before it would not be taken. */
static void give_up(const verican_t *dev, unsigned mb) {
  if (dev->abort) {
    verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(TX_ABORT));
    (void)verican_abort_flagged(dev, mb);
  }
  verican_clear_flag(dev, mb);
  verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(TX_INACTIVE));
}

/* What a callback sends that has initialised the device anew is not given up. */
void verican_tx_drop_all(verican_t *dev) {
  for (unsigned mb = dev->first_tx; mb < dev->num_mb; ++mb) {
    if (dev->life != VERICAN_LIFE_STOPPING) return;
    if (!verican_is_pending(dev, mb)) continue;
    give_up(dev, mb);
    verican_tx_end(dev, mb, VERICAN_TX_ABORTED);
    verican_tx_tell(dev, mb, VERICAN_TX_ABORTED, verican_now(dev), 0);
  }
}

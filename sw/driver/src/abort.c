/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Taking frames back (flexcan.md 3.4), and one-shot.
 */
#include "internal.h"

/* Reads of the flag until an abort counts as one without: it follows the code within some clocks.
 */
enum { FLAG_LIMIT = 8 };

bool verican_abort_flagged(const verican_t *dev, unsigned mb) {
  for (unsigned n = 0; n < (unsigned)FLAG_LIMIT; ++n) {
    if (verican_is_flagged(dev, mb)) return true;
  }
  return false;
}

static bool is_once(const verican_t *dev, unsigned mb) {
  return (dev->tx_once[mb / 32u] & verican_bit(mb)) != 0u ||
         (dev->extension &&
          (verican_read(dev, VERICAN_XCTRL_OFFSET) & VERICAN_XCTRL_ONESHOT_MASK) != 0u);
}

/* Under lock, without MCR.AEN: as take_back(). A frame that ended just before the write is told by
 * its flag alone. It has been sent then, but a one-shot may as well have failed: withdrawn it is in
 * either case. */
static bool withdraw(const verican_t *dev, unsigned mb) {
  verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(TX_INACTIVE));
  if (!verican_is_flagged(dev, mb)) return true;
  if (!is_once(dev, mb)) return false;
  verican_clear_flag(dev, mb);
  return true;
}

/* Under lock. True if the frame is gone and no interrupt will tell; false leaves the end to the
 * handler. With MCR.AEN the core decides and raises the flag, but a core may skip the flag where
 * the frame had not left its mailbox (FlexCAN2). Without, a frame that has left its mailbox goes on
 * and nothing is heard of it again. */
static bool take_back(verican_t *dev, unsigned mb) {
  if (verican_is_flagged(dev, mb)) return false;
  dev->tx_taken_back[mb / 32u] |= verican_bit(mb);
  if (!dev->abort) return withdraw(dev, mb);
  verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(TX_ABORT));
  const uint32_t code = verican_read(dev, VERICAN_MB_CS_OFFSET(mb)) & VERICAN_MB_CS_CODE_MASK;
  if (code != CS_CODE(TX_ABORT)) return false;
  return !verican_abort_flagged(dev, mb);
}

verican_result_t verican_abort(verican_t *dev, uint8_t mailbox) {
  const verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  if (mailbox < dev->first_tx || mailbox >= dev->num_mb) return VERICAN_ERR_RANGE;
  /* Told under lock: the handler could give the mailbox its next frame before the end of this one
   * is told, and nobody would know which frame that was. */
  const uint32_t token = verican_lock(dev);
  const bool waits = verican_is_pending(dev, mailbox);
  const verican_tx_outcome_t outcome = dev->abort ? VERICAN_TX_ABORTED : VERICAN_TX_WITHDRAWN;
  if (waits && take_back(dev, mailbox)) {
    verican_tx_end(dev, mailbox, outcome);
    verican_tx_tell(dev, mailbox, outcome, verican_now(dev), 0);
  }
  verican_unlock(dev, token);
  return waits ? VERICAN_OK : VERICAN_ERR_EMPTY;
}

verican_result_t verican_set_one_shot(verican_t *dev, bool on) {
  const verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (!dev->extension) return VERICAN_ERR_UNSUPPORTED;
  const uint32_t offer = verican_read(dev, VERICAN_XCONFIG_OFFSET);
  if ((offer & VERICAN_XCONFIG_ONESHOT_MASK) == 0u) return VERICAN_ERR_UNSUPPORTED;
  const uint32_t token = verican_lock(dev);
  uint32_t control = verican_read(dev, VERICAN_XCTRL_OFFSET);
  control &= ~VERICAN_XCTRL_ONESHOT_MASK;
  if (on) control |= VERICAN_XCTRL_ONESHOT_MASK;
  verican_write(dev, VERICAN_XCTRL_OFFSET, control);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

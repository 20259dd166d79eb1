/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Errors and error state: ESR, the counters, and the way out of bus-off (flexcan.md 1.4, 2.8, 7).
 */
#include "internal.h"

/* Error interrupts come with every error. They are needed to see the step from warning to passive,
 * and the end of bus-off; otherwise only if somebody listens. */
void verican_write_ctrl(const verican_t *dev) {
  if (dev->life != VERICAN_LIFE_STARTED) return; /* masked by verican_stop() */
  uint32_t ctrl = dev->ctrl | VERICAN_CTRL1_BOFF_MSK_MASK | VERICAN_CTRL1_TWRN_MSK_MASK |
                  VERICAN_CTRL1_RWRN_MSK_MASK;
  if (dev->callbacks.on_error != NULL || dev->recovering ||
      dev->state == (uint8_t)VERICAN_STATE_WARNING)
    ctrl |= VERICAN_CTRL1_ERR_MSK_MASK;
  if (dev->recovering) ctrl &= ~VERICAN_CTRL1_BOFF_REC_MASK;
  verican_write(dev, VERICAN_CTRL1_OFFSET, ctrl);
}

static verican_state_t state_of(uint32_t esr) {
  const uint32_t confinement = (esr & VERICAN_ESR1_FLT_CONF_MASK) >> VERICAN_ESR1_FLT_CONF_SHIFT;
  if (confinement >= 2u) return VERICAN_STATE_BUS_OFF;
  if (confinement == 1u) return VERICAN_STATE_PASSIVE;
  if ((esr & (VERICAN_ESR1_TX_WRN_MASK | VERICAN_ESR1_RX_WRN_MASK)) != 0u)
    return VERICAN_STATE_WARNING;
  return VERICAN_STATE_ACTIVE;
}

/* Reading ESR clears its error bits, so that they are kept here. */
static uint32_t take_esr(verican_t *dev) {
  const uint32_t esr = verican_read(dev, VERICAN_ESR1_OFFSET);
  const uint8_t errors = (uint8_t)((esr >> VERICAN_ESR1_STF_ERR_SHIFT) & 0x3Fu);
  if ((esr & ESR_FLAGS) != 0u) verican_write(dev, VERICAN_ESR1_OFFSET, esr & ESR_FLAGS);
  if (errors != 0u) {
    dev->last_errors = errors;
    ++dev->stats.error_events;
  }
  if ((esr & VERICAN_ESR1_BOFF_INT_MASK) != 0u) {
    ++dev->stats.bus_offs;
    dev->bus_off_timing = false;
    dev->recovering = false;
  }
  return esr;
}

/* One call tells at a time, the outermost. A change that comes meanwhile, in an interrupt or in
 * on_state itself, is told when on_state returns: what is told last is then what was last. */
void verican_state_tell(verican_t *dev) {
  uint32_t token = verican_lock(dev);
  const bool outermost = !dev->telling;
  while (outermost && (dev->bus_off_untold || dev->told != dev->state)) {
    const verican_state_t state =
        dev->bus_off_untold ? VERICAN_STATE_BUS_OFF : (verican_state_t)dev->state;
    dev->telling = true;
    dev->told = (uint8_t)state;
    dev->bus_off_untold = false;
    verican_unlock(dev, token);
    if (dev->callbacks.on_state != NULL) dev->callbacks.on_state(dev->callbacks.user, dev, state);
    token = verican_lock(dev);
  }
  if (outermost) dev->telling = false;
  verican_unlock(dev, token);
}

/* Under lock. */
static uint32_t follow_state(verican_t *dev) {
  const uint32_t esr = take_esr(dev);
  const verican_state_t before = (verican_state_t)dev->state;
  const verican_state_t now = state_of(esr);
  const bool went_off = (esr & VERICAN_ESR1_BOFF_INT_MASK) != 0u;
  dev->state = (uint8_t)now;
  if (now != VERICAN_STATE_BUS_OFF) dev->recovering = false;
  if (now != before || went_off) verican_write_ctrl(dev);
  /* Off the bus and back before anybody looked: both are told. */
  if (went_off && (before != VERICAN_STATE_BUS_OFF || now != VERICAN_STATE_BUS_OFF))
    dev->bus_off_untold = true;
  return esr;
}

uint32_t verican_state_serve(verican_t *dev) {
  const uint32_t token = verican_lock(dev);
  /* Not if a callback of the handler has stopped the device: STOPPED is told, and stays. */
  const bool takes_part = dev->life == VERICAN_LIFE_STARTED || dev->life == VERICAN_LIFE_STOPPING;
  const uint32_t esr = takes_part ? follow_state(dev) : 0u;
  verican_unlock(dev, token);

  const uint8_t errors = (uint8_t)((esr >> VERICAN_ESR1_STF_ERR_SHIFT) & 0x3Fu);
  if (errors != 0u && dev->callbacks.on_error != NULL)
    dev->callbacks.on_error(dev->callbacks.user, dev, errors);
  verican_state_tell(dev);
  return esr;
}

verican_result_t verican_recover(verican_t *dev) {
  const verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  (void)verican_state_serve(dev);
  const uint32_t token = verican_lock(dev); /* the handler may have seen the end meanwhile */
  const bool off = dev->state == (uint8_t)VERICAN_STATE_BUS_OFF;
  if (off) {
    dev->recovering = true;
    verican_write_ctrl(dev);
  }
  verican_unlock(dev, token);
  return off ? VERICAN_OK : VERICAN_ERR_STATE;
}

static void run_delay(verican_t *dev, uint32_t now_ms) {
  if (dev->state != (uint8_t)VERICAN_STATE_BUS_OFF || dev->recovering) return;
  if (dev->bus_off != (uint8_t)VERICAN_BUS_OFF_DELAYED) return;
  if (!dev->bus_off_timing) {
    dev->bus_off_timing = true;
    dev->bus_off_since_ms = now_ms;
  }
  if (now_ms - dev->bus_off_since_ms >= dev->bus_off_delay_ms) (void)verican_recover(dev);
}

verican_result_t verican_poll(verican_t *dev, uint32_t now_ms) {
  const verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  (void)verican_state_serve(dev);
  run_delay(dev, now_ms);
  const uint32_t token = verican_lock(dev);
  (void)verican_now(dev);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

verican_result_t verican_get_status(verican_t *dev, verican_status_t *status) {
  const verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (status == NULL) return VERICAN_ERR_NULL;
  uint32_t esr = 0;
  if (dev->life == VERICAN_LIFE_STARTED) esr = verican_state_serve(dev);
  const uint32_t ecr = verican_read(dev, VERICAN_ECR_OFFSET);
  status->state = (verican_state_t)dev->state;
  status->tec = (uint8_t)(ecr & VERICAN_ECR_TXERR_MASK);
  status->rec = (uint8_t)((ecr & VERICAN_ECR_RXERR_MASK) >> VERICAN_ECR_RXERR_SHIFT);
  status->last_errors = dev->last_errors;
  status->synchronised = (esr & VERICAN_ESR1_SYNCH_MASK) != 0u;
  status->timing = dev->timing;
  status->stats = dev->stats;
  return VERICAN_OK;
}

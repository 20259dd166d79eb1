/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Mode: disable, freeze and normal operation with their handshakes (flexcan.md section 2), and the
 * life of a device between verican_init() and verican_deinit().
 */
#include "internal.h"

verican_result_t verican_reset_core(const verican_t *dev) {
  const uint32_t frozen = VERICAN_MCR_FRZ_MASK | VERICAN_MCR_HALT_MASK;
  verican_write(dev, VERICAN_MCR_OFFSET, frozen);
  verican_result_t result = verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_LPM_ACK_MASK, 0);
  if (result != VERICAN_OK) return result;
  verican_write(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_SOFT_RST_MASK | frozen);
  return verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_SOFT_RST_MASK | VERICAN_MCR_FRZ_ACK_MASK,
                      VERICAN_MCR_FRZ_ACK_MASK);
}

verican_result_t verican_freeze(const verican_t *dev) {
  verican_write(dev, VERICAN_MCR_OFFSET, dev->mcr | VERICAN_MCR_FRZ_MASK | VERICAN_MCR_HALT_MASK);
  return verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_FRZ_ACK_MASK, VERICAN_MCR_FRZ_ACK_MASK);
}

verican_result_t verican_unfreeze(const verican_t *dev) {
  verican_write(dev, VERICAN_MCR_OFFSET, dev->mcr);
  return verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_FRZ_ACK_MASK, 0);
}

void verican_write_settings(const verican_t *dev) {
  verican_write(dev, VERICAN_MCR_OFFSET, dev->mcr | VERICAN_MCR_FRZ_MASK | VERICAN_MCR_HALT_MASK);
  verican_write(dev, VERICAN_CTRL1_OFFSET, dev->ctrl);
}

void verican_apply_mode(verican_t *dev, verican_mode_t mode) {
  dev->mode = (uint8_t)mode;
  dev->mcr &= ~VERICAN_MCR_SRX_DIS_MASK;
  if (mode != VERICAN_MODE_LOOP_BACK && !dev->self_reception) dev->mcr |= VERICAN_MCR_SRX_DIS_MASK;
  dev->ctrl &= ~(VERICAN_CTRL1_LPB_MASK | VERICAN_CTRL1_LOM_MASK);
  if (mode == VERICAN_MODE_LOOP_BACK) dev->ctrl |= VERICAN_CTRL1_LPB_MASK;
  if (mode == VERICAN_MODE_LISTEN_ONLY) dev->ctrl |= VERICAN_CTRL1_LOM_MASK;
}

verican_result_t verican_set_mode(verican_t *dev, verican_mode_t mode) {
  const verican_result_t result = verican_check_stopped(dev);
  if (result != VERICAN_OK) return result;
  if ((unsigned)mode > (unsigned)VERICAN_MODE_LOOP_BACK) return VERICAN_ERR_RANGE;
  verican_apply_mode(dev, mode);
  verican_write_settings(dev);
  return VERICAN_OK;
}

verican_result_t verican_set_timing(verican_t *dev, uint32_t clock_hz,
                                    const verican_timing_t *timing) {
  verican_result_t result = verican_check_stopped(dev);
  if (result != VERICAN_OK) return result;
  if (timing == NULL) return VERICAN_ERR_NULL;
  verican_timing_t checked = *timing;
  result = verican_timing_check(clock_hz, &checked);
  if (result != VERICAN_OK) return result;
  dev->ctrl &= ~verican_timing_bits(&dev->timing);
  dev->ctrl |= verican_timing_bits(&checked);
  dev->timing = checked;
  verican_write_settings(dev);
  return VERICAN_OK;
}

verican_result_t verican_start(verican_t *dev) {
  verican_result_t result = verican_check_stopped(dev);
  if (result != VERICAN_OK) return result;
  verican_write_settings(dev);
  result = verican_unfreeze(dev);
  if (result != VERICAN_OK) {
    verican_write_settings(dev); /* asks for freeze mode again */
    return result;
  }
  const uint32_t tx_low = dev->first_tx < 32u ? ~0u << dev->first_tx : 0u;
  const uint32_t tx_high = dev->first_tx < 32u ? ~0u : ~0u << (dev->first_tx - 32u);
  /* Or a callback of the handler, which may come as soon as one mask is open, could stop the device
   * before the others are. */
  const uint32_t token = verican_lock(dev);
  dev->state = (uint8_t)VERICAN_STATE_ACTIVE;
  dev->told = dev->state;
  dev->bus_off_untold = false;
  dev->recovering = false;
  dev->bus_off_timing = false;
  dev->life = VERICAN_LIFE_STARTED;
  verican_write_ctrl(dev);
  verican_write(dev, VERICAN_IMASK1_OFFSET, dev->rx_mask[0] | tx_low);
  if (dev->num_mb > 32u) verican_write(dev, VERICAN_IMASK2_OFFSET, dev->rx_mask[1] | tx_high);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

static void mask_interrupts(const verican_t *dev) {
  verican_write(dev, VERICAN_IMASK1_OFFSET, 0);
  if (dev->num_mb > 32u) verican_write(dev, VERICAN_IMASK2_OFFSET, 0);
  verican_write(dev, VERICAN_CTRL1_OFFSET, dev->ctrl);
}

verican_result_t verican_stop(verican_t *dev) {
  verican_result_t result = verican_check_started(dev);
  if (result != VERICAN_OK) return result;
  result = verican_freeze(dev);
  if (result != VERICAN_OK) {
    verican_write(dev, VERICAN_MCR_OFFSET, dev->mcr); /* or the core would freeze later */
    return result;
  }
  /* From here on the handler, which another device on the line may call, does nothing, and a
   * callback sends nothing. */
  const uint32_t token = verican_lock(dev);
  mask_interrupts(dev);
  dev->life = VERICAN_LIFE_STOPPING;
  verican_unlock(dev, token);
  (void)verican_serve(dev);
  verican_tx_drop_all(dev);
  /* A callback may have initialised the device anew: it is as that has left it. */
  if (dev->life != VERICAN_LIFE_STOPPING) return VERICAN_OK;
  dev->life = VERICAN_LIFE_STOPPED;
  dev->state = (uint8_t)VERICAN_STATE_STOPPED;
  verican_state_tell(dev);
  return VERICAN_OK;
}

verican_result_t verican_deinit(verican_t *dev) {
  verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  if (dev->life == VERICAN_LIFE_STOPPING) return VERICAN_ERR_STATE;
  if (dev->life == VERICAN_LIFE_STARTED) {
    result = verican_stop(dev);
    if (result != VERICAN_OK) return result;
  }
  const uint32_t token = verican_lock(dev);
  mask_interrupts(dev); /* a callback of verican_stop() may have started it anew */
  if (dev->time_unit) (void)verican_stamp_quiet(dev);
  verican_write(dev, VERICAN_MCR_OFFSET, dev->mcr | VERICAN_MCR_MDIS_MASK);
  dev->life = 0;
  verican_unlock(dev, token);
  return verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_LPM_ACK_MASK, VERICAN_MCR_LPM_ACK_MASK);
}

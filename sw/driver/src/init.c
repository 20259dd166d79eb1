/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Initialisation: the configuration is checked, then the core is found, reset and configured.
 */
#include "internal.h"

verican_result_t verican_config_default(verican_config_t *config) {
  if (config == NULL) return VERICAN_ERR_NULL;
  *config = (verican_config_t){0};
  config->tx_mailboxes = 8;
  return VERICAN_OK;
}

static bool enums_valid(const verican_config_t *config) {
  return (unsigned)config->mode <= (unsigned)VERICAN_MODE_LOOP_BACK &&
         (unsigned)config->rx_mode <= (unsigned)VERICAN_RX_FIFO &&
         (unsigned)config->fifo_format <= (unsigned)VERICAN_FIFO_FORMAT_C &&
         (unsigned)config->tx_order <= (unsigned)VERICAN_TX_BY_PRIORITY &&
         (unsigned)config->bus_off <= (unsigned)VERICAN_BUS_OFF_DELAYED;
}

static verican_result_t check_config(const verican_config_t *config) {
  const verican_port_t *port = &config->port;
  if (port->base == NULL && (port->read32 == NULL || port->write32 == NULL))
    return VERICAN_ERR_NULL;
  if ((port->lock == NULL) != (port->unlock == NULL)) return VERICAN_ERR_NULL;
  if (config->rx_ring == NULL) return VERICAN_ERR_NULL;
  if (config->rx_ring_size < 2u || config->tx_mailboxes == 0u) return VERICAN_ERR_RANGE;
  if (!enums_valid(config)) return VERICAN_ERR_RANGE;
  const uint8_t n = config->mailboxes;
  if (n != 0u && n != 16u && n != 32u && n != 64u) return VERICAN_ERR_RANGE;
  if (n != 0u && (config->one_shot || config->fd_tolerant)) return VERICAN_ERR_UNSUPPORTED;
  return VERICAN_OK;
}

static verican_result_t find_timing(const verican_config_t *config, verican_timing_t *timing) {
  if (config->timing == NULL)
    return verican_timing_find(config->clock_hz, config->bitrate, config->sample_point, timing);
  *timing = *config->timing;
  return verican_timing_check(config->clock_hz, timing);
}

static void copy_config(verican_t *dev, const verican_config_t *config) {
  dev->port = config->port;
  dev->callbacks = config->callbacks;
  dev->ring = config->rx_ring;
  dev->ring_size = config->rx_ring_size;
  dev->rx_mode = (uint8_t)config->rx_mode;
  dev->fifo_format = (uint8_t)config->fifo_format;
  dev->tx_order = (uint8_t)config->tx_order;
  dev->bus_off = (uint8_t)config->bus_off;
  dev->bus_off_delay_ms = config->bus_off_delay_ms;
  dev->abort = config->abort;
  dev->self_reception = config->self_reception;
  dev->num_mb = config->mailboxes;
}

/* The number of mailboxes, from the extension page or as configured, and what it offers. */
static verican_result_t find_core(verican_t *dev, const verican_config_t *config) {
  if (config->mailboxes == 0u) {
    if (verican_read(dev, VERICAN_XID_OFFSET) != VERICAN_XID_RESET) return VERICAN_ERR_DEVICE;
    const uint32_t offer = verican_read(dev, VERICAN_XCONFIG_OFFSET);
    dev->extension = true;
    dev->frame_one_shot = (offer & VERICAN_XCONFIG_OSMB_MASK) != 0u;
    verican_stamp_init(dev, offer, config->clock_hz);
    dev->num_mb = (uint8_t)(offer & VERICAN_XCONFIG_NUM_MB_MASK);
    if (dev->num_mb != 16u && dev->num_mb != 32u && dev->num_mb != 64u) return VERICAN_ERR_DEVICE;
    if (config->one_shot && (offer & VERICAN_XCONFIG_ONESHOT_MASK) == 0u)
      return VERICAN_ERR_UNSUPPORTED;
    if (config->fd_tolerant && (offer & VERICAN_XCONFIG_FDTOL_MASK) == 0u)
      return VERICAN_ERR_UNSUPPORTED;
  }
  const unsigned fifo = config->rx_mode == VERICAN_RX_FIFO ? 8u : 1u;
  if (config->tx_mailboxes > dev->num_mb - fifo) return VERICAN_ERR_SPACE;
  dev->first_tx = (uint8_t)(dev->num_mb - config->tx_mailboxes);
  return VERICAN_OK;
}

static void plan_registers(verican_t *dev, const verican_config_t *config) {
  dev->mcr = VERICAN_MCR_WRN_EN_MASK | VERICAN_MCR_BCC_MASK | (dev->num_mb - 1u);
  if (config->rx_mode == VERICAN_RX_FIFO)
    dev->mcr |= VERICAN_MCR_FEN_MASK | (uint32_t)config->fifo_format << VERICAN_MCR_IDAM_SHIFT;
  if (config->abort) dev->mcr |= VERICAN_MCR_AEN_MASK;
  if (config->tx_order == VERICAN_TX_BY_PRIORITY) dev->mcr |= VERICAN_MCR_LPRIO_EN_MASK;
  /* The clock source can be another in disable mode only: it stays as it is. */
  dev->ctrl = verican_read(dev, VERICAN_CTRL1_OFFSET) & VERICAN_CTRL1_CLK_SRC_MASK;
  dev->ctrl |= verican_timing_bits(&dev->timing);
  if (config->triple_sampling) dev->ctrl |= VERICAN_CTRL1_SMP_MASK;
  if (config->tx_order == VERICAN_TX_IN_ORDER) dev->ctrl |= VERICAN_CTRL1_LBUF_MASK;
  if (config->bus_off != VERICAN_BUS_OFF_AUTOMATIC) dev->ctrl |= VERICAN_CTRL1_BOFF_REC_MASK;
  verican_apply_mode(dev, config->mode);
}

/* What the core does not keep, it does not have. With a fixed MAXMB all of its buffers take part:
 * those beyond num_mb, which nobody clears, would send. */
static verican_result_t check_kept(verican_t *dev) {
  const uint32_t optional = VERICAN_MCR_FEN_MASK | VERICAN_MCR_AEN_MASK | VERICAN_MCR_LPRIO_EN_MASK;
  const uint32_t mcr = verican_read(dev, VERICAN_MCR_OFFSET);
  const uint32_t taking_part = (mcr & VERICAN_MCR_MAXMB_MASK) + 1u;
  if (taking_part != dev->num_mb)
    return taking_part < dev->num_mb ? VERICAN_ERR_SPACE : VERICAN_ERR_DEVICE;
  const uint32_t missing = dev->mcr & ~mcr;
  if ((missing & optional) != 0u) return VERICAN_ERR_UNSUPPORTED;
  if ((missing & ~VERICAN_MCR_BCC_MASK) != 0u) return VERICAN_ERR_DEVICE;
  dev->own_masks = missing == 0u;
  dev->mcr &= ~missing;
  const uint32_t differs = verican_read(dev, VERICAN_CTRL1_OFFSET) ^ dev->ctrl;
  if (differs == VERICAN_CTRL1_LBUF_MASK) return VERICAN_ERR_UNSUPPORTED;
  if (differs != 0u) return VERICAN_ERR_DEVICE;
  const uint32_t last = VERICAN_MB_DATA1_OFFSET(dev->num_mb - 1u);
  verican_write(dev, last, 0xA5C33C5Au);
  if (verican_read(dev, last) != 0xA5C33C5Au) return VERICAN_ERR_SPACE;
  return VERICAN_OK;
}

/* CTRL2, if there is one: format and kind of a frame are compared, remote frames received. */
static void set_ctrl2(verican_t *dev) {
  const uint32_t strict = VERICAN_CTRL2_EACEN_MASK | VERICAN_CTRL2_RRS_MASK;
  const uint32_t delay = verican_read(dev, VERICAN_CTRL2_OFFSET) & VERICAN_CTRL2_TASD_MASK;
  verican_write(dev, VERICAN_CTRL2_OFFSET, delay | strict);
  dev->ctrl2 = verican_read(dev, VERICAN_CTRL2_OFFSET);
  dev->eacen = (dev->ctrl2 & strict) == strict;
}

static void clear_buffers(const verican_t *dev) {
  for (unsigned mb = 0; mb < dev->num_mb; ++mb) {
    verican_write(dev, VERICAN_MB_CS_OFFSET(mb),
                  mb < dev->first_tx ? CS_CODE(RX_INACTIVE) : CS_CODE(TX_INACTIVE));
    verican_write(dev, verican_mask_offset(dev, mb), ~0u);
  }
  verican_write(dev, VERICAN_IMASK1_OFFSET, 0);
  verican_write(dev, VERICAN_IFLAG1_OFFSET, ~0u);
  if (dev->num_mb <= 32u) return;
  verican_write(dev, VERICAN_IMASK2_OFFSET, 0);
  verican_write(dev, VERICAN_IFLAG2_OFFSET, ~0u);
}

/* Under lock from the moment at which the handlers know the device no more until nothing of the
 * core interrupts: a device that runs could have asked in between, and for ever. */
static verican_result_t take_over(verican_t *dev, const verican_config_t *config,
                                  const verican_timing_t *timing) {
  const uint32_t token = verican_lock_port(&config->port);
  *dev = (verican_t){0};
  dev->timing = *timing;
  copy_config(dev, config);
  verican_result_t result = verican_reset_core(dev);
  if (result == VERICAN_OK) result = find_core(dev, config);
  verican_unlock(dev, token);
  return result;
}

static verican_result_t set_up(verican_t *dev, const verican_config_t *config) {
  plan_registers(dev, config);
  verican_write_settings(dev);
  const verican_result_t result = check_kept(dev);
  if (result != VERICAN_OK) return result;
  set_ctrl2(dev);
  clear_buffers(dev);
  if (dev->extension) {
    uint32_t control = config->fd_tolerant ? VERICAN_XCTRL_FDTOL_MASK : 0u;
    if (dev->frame_one_shot) control |= VERICAN_XCTRL_OSMB_MASK;
    if (config->one_shot) control |= VERICAN_XCTRL_ONESHOT_MASK;
    verican_write(dev, VERICAN_XCTRL_OFFSET, control);
  }
  dev->life = VERICAN_LIFE_STOPPED;
  return verican_accept_all(dev);
}

verican_result_t verican_init(verican_t *dev, const verican_config_t *config) {
  if (dev == NULL || config == NULL) return VERICAN_ERR_NULL;
  verican_timing_t timing;
  verican_result_t result = check_config(config);
  if (result == VERICAN_OK) result = find_timing(config, &timing);
  if (result != VERICAN_OK) return result;
  result = take_over(dev, config, &timing);
  if (result == VERICAN_OK) result = set_up(dev, config);
  if (result != VERICAN_OK) dev->life = 0;
  return result;
}

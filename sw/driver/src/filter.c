/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Filters of the mailboxes: each receiving mailbox has an identifier and a mask of its own; a
 * filter gets an equal share of the mailboxes, so that frames can queue in them.
 */
#include "internal.h"

static bool is_valid(const verican_filter_t *filter) {
  const uint32_t limit = filter->ide == VERICAN_SELECT_ONLY_1 ? 0x1FFFFFFFu : 0x7FFu;
  return (unsigned)filter->ide <= (unsigned)VERICAN_SELECT_BOTH &&
         (unsigned)filter->rtr <= (unsigned)VERICAN_SELECT_BOTH && filter->id <= limit &&
         filter->mask <= limit;
}

static uint32_t mask_of(const verican_filter_t *filter) {
  uint32_t mask =
      filter->mask << (filter->ide == VERICAN_SELECT_ONLY_1 ? 0u : VERICAN_MB_ID_STD_SHIFT);
  if (filter->ide != VERICAN_SELECT_BOTH) mask |= MASK_IDE;
  if (filter->rtr != VERICAN_SELECT_BOTH) mask |= MASK_RTR;
  return mask;
}

/* A core without CTRL2.EACEN compares IDE in any case: one mailbox for each format. */
static unsigned formats(const verican_t *dev, const verican_filter_t *filter) {
  return !dev->eacen && filter->ide == VERICAN_SELECT_BOTH ? 2u : 1u;
}

/* `format`: which of its formats. */
static void write_filter(const verican_t *dev, unsigned mb, const verican_filter_t *filter,
                         unsigned format) {
  const bool extended = filter->ide == VERICAN_SELECT_ONLY_1 || format == 1u;
  const unsigned shift = filter->ide == VERICAN_SELECT_ONLY_1 ? 0u : VERICAN_MB_ID_STD_SHIFT;
  uint32_t cs = CS_CODE(RX_EMPTY);
  if (extended) cs |= VERICAN_MB_CS_IDE_MASK;
  if (filter->rtr == VERICAN_SELECT_ONLY_1) cs |= VERICAN_MB_CS_RTR_MASK;
  verican_write(dev, verican_mask_offset(dev, mb), mask_of(filter));
  verican_write(dev, VERICAN_MB_ID_OFFSET(mb), filter->id << shift);
  verican_write(dev, VERICAN_MB_CS_OFFSET(mb), cs);
}

/* The filters one after the other, each with all of its formats, until no mailbox is left. */
static void share_mailboxes(verican_t *dev, const verican_filter_t *filters, unsigned count) {
  unsigned k = 0;
  unsigned format = 0;
  for (unsigned mb = 0; mb < dev->first_tx; ++mb) {
    write_filter(dev, mb, &filters[k], format);
    dev->rx_mask[mb / 32u] |= verican_bit(mb);
    if (++format < formats(dev, &filters[k])) continue;
    format = 0;
    k = (k + 1u) % count;
  }
}

static verican_result_t set_mailbox_filters(verican_t *dev, const verican_filter_t *filters,
                                            unsigned count) {
  unsigned wanted = 0;
  for (unsigned k = 0; k < count; ++k) {
    if (!dev->eacen && filters[k].rtr == VERICAN_SELECT_ONLY_1) return VERICAN_ERR_UNSUPPORTED;
    if (!dev->own_masks && mask_of(&filters[k]) != mask_of(&filters[0]))
      return VERICAN_ERR_UNSUPPORTED;
    wanted += formats(dev, &filters[k]);
  }
  if (wanted > dev->first_tx) return VERICAN_ERR_SPACE;
  if (!dev->own_masks && count != 0u) {
    verican_write(dev, VERICAN_RX14MASK_OFFSET, mask_of(&filters[0]));
    verican_write(dev, VERICAN_RX15MASK_OFFSET, mask_of(&filters[0]));
  }
  dev->rx_mask[0] = 0;
  dev->rx_mask[1] = 0;
  if (count != 0u) {
    share_mailboxes(dev, filters, count);
    return VERICAN_OK;
  }
  for (unsigned mb = 0; mb < dev->first_tx; ++mb)
    verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(RX_INACTIVE));
  return VERICAN_OK;
}

verican_result_t verican_set_filters(verican_t *dev, const verican_filter_t *filters,
                                     uint16_t count) {
  const verican_result_t result = verican_check_stopped(dev);
  if (result != VERICAN_OK) return result;
  if (filters == NULL && count != 0u) return VERICAN_ERR_NULL;
  for (unsigned k = 0; k < count; ++k) {
    if (!is_valid(&filters[k])) return VERICAN_ERR_RANGE;
  }
  if (dev->rx_mode == (uint8_t)VERICAN_RX_FIFO)
    return verican_set_fifo_filters(dev, filters, count);
  return set_mailbox_filters(dev, filters, count);
}

verican_result_t verican_accept_all(verican_t *dev) {
  const verican_filter_t all = {0, 0, VERICAN_SELECT_BOTH, VERICAN_SELECT_BOTH};
  return verican_set_filters(dev, &all, 1);
}

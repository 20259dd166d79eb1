/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Filters of the mailboxes: each receiving mailbox has an identifier and a mask of its own; a
 * filter gets an equal share of the mailboxes, so that frames can queue in them.
 */
#include "internal.h"

static verican_result_t check_filter(const verican_t *dev, const verican_filter_t *filter) {
  const uint32_t limit = filter->ide == VERICAN_SELECT_ONLY_1 ? 0x1FFFFFFFu : 0x7FFu;
  if ((unsigned)filter->ide > (unsigned)VERICAN_SELECT_BOTH) return VERICAN_ERR_RANGE;
  if ((unsigned)filter->rtr > (unsigned)VERICAN_SELECT_BOTH) return VERICAN_ERR_RANGE;
  if (filter->id > limit || filter->mask > limit) return VERICAN_ERR_RANGE;
  if (dev->rx_mode == (uint8_t)VERICAN_RX_MAILBOXES && !dev->eacen &&
      filter->rtr == VERICAN_SELECT_ONLY_1)
    return VERICAN_ERR_UNSUPPORTED;
  return VERICAN_OK;
}

/* `turn`: how many mailboxes this filter has already. A core without CTRL2.EACEN compares IDE in
 * any case, so mailboxes of a filter for both formats take turns. */
static void write_filter(const verican_t *dev, unsigned mb, const verican_filter_t *filter,
                         unsigned turn) {
  const bool both = filter->ide == VERICAN_SELECT_BOTH;
  const bool extended =
      filter->ide == VERICAN_SELECT_ONLY_1 || (both && !dev->eacen && (turn & 1u) != 0u);
  const unsigned shift = filter->ide == VERICAN_SELECT_ONLY_1 ? 0u : ID_STANDARD_SHIFT;
  uint32_t mask = filter->mask << shift;
  if (!both) mask |= MASK_IDE;
  if (filter->rtr != VERICAN_SELECT_BOTH) mask |= MASK_RTR;
  uint32_t cs = CS_RX_EMPTY;
  if (extended) cs |= CS_IDE;
  if (filter->rtr == VERICAN_SELECT_ONLY_1) cs |= CS_RTR;
  verican_write(dev, RXIMR(mb), mask);
  verican_write(dev, MB_ID(mb), filter->id << shift);
  verican_write(dev, MB_CS(mb), cs);
}

static verican_result_t set_mailbox_filters(verican_t *dev, const verican_filter_t *filters,
                                            unsigned count) {
  const unsigned room = dev->first_tx;
  unsigned wanted = 0;
  for (unsigned k = 0; k < count; ++k)
    wanted += !dev->eacen && filters[k].ide == VERICAN_SELECT_BOTH ? 2u : 1u;
  if (wanted > room) return VERICAN_ERR_SPACE;
  dev->rx_mask[0] = 0;
  dev->rx_mask[1] = 0;
  for (unsigned mb = 0; mb < room; ++mb) {
    if (count == 0u) {
      verican_write(dev, MB_CS(mb), CS_RX_INACTIVE);
      continue;
    }
    write_filter(dev, mb, &filters[mb % count], mb / count);
    dev->rx_mask[mb / 32u] |= verican_bit(mb);
  }
  return VERICAN_OK;
}

verican_result_t verican_set_filters(verican_t *dev, const verican_filter_t *filters,
                                     uint16_t count) {
  const verican_result_t result = verican_check_stopped(dev);
  if (result != VERICAN_OK) return result;
  if (filters == NULL && count != 0u) return VERICAN_ERR_NULL;
  for (unsigned k = 0; k < count; ++k) {
    const verican_result_t bad = check_filter(dev, &filters[k]);
    if (bad != VERICAN_OK) return bad;
  }
  return set_mailbox_filters(dev, filters, count);
}

verican_result_t verican_accept_all(verican_t *dev) {
  const verican_filter_t all = {0, 0, VERICAN_SELECT_BOTH, VERICAN_SELECT_BOTH};
  return verican_set_filters(dev, &all, 1);
}

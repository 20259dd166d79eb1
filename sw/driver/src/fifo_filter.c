/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Filters of the FIFO: a table of words with one, two or four filters each (flexcan.md 4). The
 * first words have masks of their own, those beyond share RXFGMASK and must be exact.
 */
#include "internal.h"

enum { BLOCK = 8, RFFN_MAX = 15, MASKS_MAX = 32 };

/* One filter or word of filters: what to compare and under which mask. */
typedef struct element {
  uint32_t value;
  uint32_t mask;
} element_t;

static unsigned per_word(const verican_t *dev) { return 1u << dev->fifo_format; }

static unsigned table_words(unsigned rffn) { return (unsigned)BLOCK * (rffn + 1u); }
static unsigned first_mailbox(unsigned rffn) { return (unsigned)BLOCK + 2u * rffn; }
static unsigned own_masks(const verican_t *dev, unsigned rffn) {
  if (!dev->own_masks) return 0;
  const unsigned masks = first_mailbox(rffn);
  return masks < (unsigned)MASKS_MAX ? masks : (unsigned)MASKS_MAX;
}

/* The filter as an element of format A; B and C are the upper bits of it. */
static element_t encode_whole(const verican_filter_t *filter) {
  const unsigned shift = filter->ide == VERICAN_SELECT_ONLY_1 ? VERICAN_FIFO_FILTER_A_EXT_ID_SHIFT
                                                              : VERICAN_FIFO_FILTER_A_STD_ID_SHIFT;
  element_t whole = {filter->id << shift, filter->mask << shift};
  if (filter->rtr != VERICAN_SELECT_BOTH) whole.mask |= VERICAN_FIFO_FILTER_A_REM_MASK;
  if (filter->rtr == VERICAN_SELECT_ONLY_1) whole.value |= VERICAN_FIFO_FILTER_A_REM_MASK;
  if (filter->ide != VERICAN_SELECT_BOTH) whole.mask |= VERICAN_FIFO_FILTER_A_EXT_MASK;
  if (filter->ide == VERICAN_SELECT_ONLY_1) whole.value |= VERICAN_FIFO_FILTER_A_EXT_MASK;
  return whole;
}

/* False if the format cannot express the filter exactly. */
static bool encode(const verican_t *dev, const verican_filter_t *filter, element_t *element) {
  const element_t whole = encode_whole(filter);
  switch (dev->fifo_format) {
    case VERICAN_FIFO_FORMAT_A: *element = whole; return true;
    case VERICAN_FIFO_FORMAT_B:
      element->value = whole.value >> 16;
      element->mask = whole.mask >> 16;
      return (whole.mask & 0xFFFFu) == 0u;
    default:
      element->value = (whole.value >> 22) & 0xFFu;
      element->mask = (whole.mask >> 22) & 0xFFu;
      return (whole.mask & ~0x3FC00000u) == 0u;
  }
}

/* Word n of the table. The last filter fills what is left over. */
static element_t encode_word(const verican_t *dev, const verican_filter_t *filters, unsigned count,
                             unsigned n) {
  const unsigned per = per_word(dev);
  const unsigned width = 32u / per;
  element_t word = {0, 0};
  for (unsigned i = 0; i < per; ++i) {
    const unsigned k = n * per + i < count ? n * per + i : count - 1u;
    element_t part;
    (void)encode(dev, &filters[k], &part);
    const unsigned shift = per == 1u ? 0u : 32u - width * (i + 1u);
    word.value |= part.value << shift;
    word.mask |= part.mask << shift;
  }
  return word;
}

/* The shared mask: all ones, or without masks of their own that of all filters. */
static uint32_t shared_mask(const verican_t *dev, const verican_filter_t *filters, unsigned count) {
  return dev->own_masks ? ~0u : encode_word(dev, filters, count, 0).mask;
}

/* A filter that a mask of ones leaves as it is. */
static bool is_exact(const verican_t *dev, const verican_filter_t *filter) {
  if (dev->fifo_format == (uint8_t)VERICAN_FIFO_FORMAT_C) return filter->mask == 0x7F8u;
  if (filter->ide == VERICAN_SELECT_BOTH || filter->rtr == VERICAN_SELECT_BOTH) return false;
  if (filter->ide == VERICAN_SELECT_ONLY_0) return filter->mask == 0x7FFu;
  return filter->mask ==
         (dev->fifo_format == (uint8_t)VERICAN_FIFO_FORMAT_A ? 0x1FFFFFFFu : 0x1FFF8000u);
}

static bool fits(const verican_t *dev, const verican_filter_t *filters, unsigned count,
                 unsigned rffn) {
  if (count > table_words(rffn) * per_word(dev)) return false;
  for (unsigned k = own_masks(dev, rffn) * per_word(dev); k < count; ++k) {
    if (dev->own_masks && !is_exact(dev, &filters[k])) return false;
  }
  return true;
}

/* Without masks of their own all filters have the same. */
static bool masks_possible(const verican_t *dev, const verican_filter_t *filters, unsigned count) {
  if (dev->own_masks) return true;
  for (unsigned k = 1; k < count; ++k) {
    if (encode_whole(&filters[k]).mask != encode_whole(&filters[0]).mask) return false;
  }
  return true;
}

static void write_table(verican_t *dev, const verican_filter_t *filters, unsigned count) {
  for (unsigned n = 0; n < table_words(dev->rffn); ++n) {
    const element_t word = encode_word(dev, filters, count, n);
    verican_write(dev, VERICAN_FIFO_FILTER_OFFSET(n), word.value);
    if (n < own_masks(dev, dev->rffn)) verican_write(dev, VERICAN_RXIMR_OFFSET(n), word.mask);
  }
  verican_write(dev, VERICAN_RXFGMASK_OFFSET, shared_mask(dev, filters, count));
}

verican_result_t verican_set_fifo_filters(verican_t *dev, const verican_filter_t *filters,
                                          unsigned count) {
  element_t unused;
  unsigned rffn = 0;
  for (unsigned k = 0; k < count; ++k) {
    if (!encode(dev, &filters[k], &unused)) return VERICAN_ERR_RANGE;
  }
  if (!masks_possible(dev, filters, count)) return VERICAN_ERR_UNSUPPORTED;
  const unsigned rffn_max = dev->eacen ? (unsigned)RFFN_MAX : 0u;
  while (!fits(dev, filters, count, rffn)) {
    if (++rffn > rffn_max || first_mailbox(rffn) > dev->first_tx) return VERICAN_ERR_SPACE;
  }
  dev->rffn = (uint8_t)rffn;
  dev->mcr &= ~VERICAN_MCR_IDAM_MASK;
  dev->mcr |= (count != 0u ? (uint32_t)dev->fifo_format : VERICAN_MCR_IDAM_REJECT)
              << VERICAN_MCR_IDAM_SHIFT;
  verican_write_settings(dev);
  verican_write(dev, VERICAN_CTRL2_OFFSET, dev->ctrl2 | rffn << VERICAN_CTRL2_RFFN_SHIFT);
  for (unsigned mb = first_mailbox(rffn); mb < dev->first_tx; ++mb)
    verican_write(dev, VERICAN_MB_CS_OFFSET(mb), CS_CODE(RX_INACTIVE));
  if (count != 0u) write_table(dev, filters, count);
  dev->rx_mask[0] = VERICAN_IFLAG1_FIFO_AVAILABLE_MASK | VERICAN_IFLAG1_FIFO_OVERFLOW_MASK;
  dev->rx_mask[1] = 0;
  return VERICAN_OK;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Access to the core: by pointer or by functions, and the caller's lock.
 */
#include "internal.h"

#define POLL_LIMIT_DEFAULT 100000u

uint32_t verican_read(const verican_t *dev, uint32_t offset) {
  if (dev->port.base != NULL) return dev->port.base[offset / 4u];
  return dev->port.read32(dev->port.context, offset);
}

void verican_write(const verican_t *dev, uint32_t offset, uint32_t value) {
  if (dev->port.base != NULL) {
    dev->port.base[offset / 4u] = value;
  } else {
    dev->port.write32(dev->port.context, offset, value);
  }
}

verican_result_t verican_wait(const verican_t *dev, uint32_t offset, uint32_t mask,
                              uint32_t value) {
  const uint32_t limit = dev->port.poll_limit != 0u ? dev->port.poll_limit : POLL_LIMIT_DEFAULT;
  for (uint32_t n = 0; n < limit; ++n) {
    if ((verican_read(dev, offset) & mask) == value) return VERICAN_OK;
  }
  return VERICAN_ERR_TIMEOUT;
}

static uint32_t flags_of(unsigned mb) {
  return mb < 32u ? VERICAN_IFLAG1_OFFSET : VERICAN_IFLAG2_OFFSET;
}

bool verican_is_flagged(const verican_t *dev, unsigned mb) {
  return (verican_read(dev, flags_of(mb)) & verican_bit(mb)) != 0u;
}

void verican_clear_flag(const verican_t *dev, unsigned mb) {
  verican_write(dev, flags_of(mb), verican_bit(mb));
}

uint32_t verican_lock_port(const verican_port_t *port) {
  return port->lock != NULL ? port->lock(port->context) : 0u;
}

uint32_t verican_lock(const verican_t *dev) { return verican_lock_port(&dev->port); }

void verican_unlock(const verican_t *dev, uint32_t token) {
  if (dev->port.unlock != NULL) dev->port.unlock(dev->port.context, token);
}

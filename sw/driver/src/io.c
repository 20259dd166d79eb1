/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Access to the core: by pointer or by functions, and the caller's lock.
 */
#include "internal.h"

/* Without a limit of the caller's. At slow bit rates a frame lasts longer than so many reads, of
 * which each takes a clock of the core at least; with what may follow it has so many bits at most.
 */
#define POLL_LIMIT_DEFAULT 100000u
#define POLL_BITS 200u

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

static uint32_t poll_limit(const verican_t *dev) {
  if (dev->port.poll_limit != 0u) return dev->port.poll_limit;
  const uint32_t frame = POLL_BITS * verican_bit_clocks(&dev->timing);
  return frame > POLL_LIMIT_DEFAULT ? frame : POLL_LIMIT_DEFAULT;
}

verican_result_t verican_wait(const verican_t *dev, uint32_t offset, uint32_t mask,
                              uint32_t value) {
  const uint32_t limit = poll_limit(dev);
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

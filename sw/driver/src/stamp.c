/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Stamps of frames from the time unit: what they are late by, and the rows of the mailboxes
 * (docs/time-spec.md, TM-26 to TM-28).
 */
#include "internal.h"
#include "verican/timesync.h"

/* Both edges at the sample point with POINT = 2; the own frame at the flip-flop or at the pin. */
void verican_stamp_latencies(verican_t *dev, uint32_t tctrl) {
  const uint32_t tcap = verican_read(dev, VERICAN_TCAP_OFFSET);
  const uint8_t rx = (uint8_t)VERICAN_TCAP_RXLAT_GET(tcap);
  const bool own_pin = (tctrl & VERICAN_TCTRL_TXPIN_MASK) != 0u;
  dev->rx_latency = rx;
  dev->tx_latency = own_pin ? rx : (uint8_t)VERICAN_TCAP_TXLAT_GET(tcap);
  if (VERICAN_TCTRL_POINT_GET(tctrl) == VERICAN_TCTRL_POINT_EOF) {
    dev->rx_latency = (uint8_t)VERICAN_TCAP_SPLAT_GET(tcap);
    dev->tx_latency = dev->rx_latency;
  }
}

/* A clock of 255 ns is the slowest that the increment can hold. */
uint32_t verican_stamp_quiet(const verican_t *dev) {
  const uint32_t tctrl = verican_read(dev, VERICAN_TCTRL_OFFSET) & ~VERICAN_CLOCK_EVENTS;
  verican_write(dev, VERICAN_TTXMB_OFFSET, 0);
  verican_write(dev, VERICAN_TCTRL_OFFSET, tctrl);
  return tctrl;
}

/* A soft reset leaves the clock: what is left of a slew would go on with the new rate. */
void verican_stamp_init(verican_t *dev, uint32_t xconfig, uint32_t clock_hz) {
  const uint64_t increment = (((uint64_t)1000000000u << 32) + clock_hz / 2u) / clock_hz;
  dev->time_unit = (xconfig & VERICAN_XCONFIG_TIME_MASK) != 0u && increment >> 40 == 0u;
  if (!dev->time_unit) return;
  dev->half_clock = (uint32_t)(increment >> 25);
  verican_write(dev, VERICAN_TSLEW_OFFSET, 0);
  verican_write_rate(dev, increment);
  const uint32_t tctrl = verican_stamp_quiet(dev);
  dev->pps = (tctrl & VERICAN_PPS_PARTS) == VERICAN_PPS_PARTS;
  verican_stamp_latencies(dev, tctrl);
}

uint64_t verican_half_clocks(const verican_t *dev, uint8_t half_clocks) {
  return half_clocks * dev->half_clock / 256u;
}

uint64_t verican_stamp(const verican_t *dev, unsigned mb, uint8_t latency) {
  if (!dev->time_unit) return 0;
  return verican_read_pair(dev, VERICAN_STAMPLO_OFFSET(mb)) - verican_half_clocks(dev, latency);
}

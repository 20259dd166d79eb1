/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The clock of the time unit (docs/time-spec.md, TM-10 to TM-16, TM-30 to TM-32, TM-91).
 */
#include "internal.h"
#include "verican/timesync.h"

#define SECOND_NS 1000000000u
/* Time to arm the compare unit before the second that it waits for. */
#define ARM_NS 1000000u
/* Two registers each. */
enum { READS_OF_A_JUMP = 4 };

static verican_result_t check(const verican_t *dev) {
  const verican_result_t result = verican_check(dev);
  if (result != VERICAN_OK) return result;
  return dev->time_unit ? VERICAN_OK : VERICAN_ERR_UNSUPPORTED;
}

/* Two words; the lower one first, which keeps the upper one where it matters. */
uint64_t verican_read_pair(const verican_t *dev, uint32_t low) {
  const uint32_t first = verican_read(dev, low);
  return (uint64_t)verican_read(dev, low + 4u) << 32 | first;
}

void verican_write_pair(const verican_t *dev, uint32_t first, uint32_t low, uint32_t high) {
  const uint32_t token = verican_lock(dev);
  verican_write(dev, first, low);
  verican_write(dev, first + 4u, high);
  verican_unlock(dev, token);
}

verican_result_t verican_clock_get(const verican_t *dev, uint64_t *ns) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  if (ns == NULL) return VERICAN_ERR_NULL;
  const uint32_t token = verican_lock(dev);
  *ns = verican_read_pair(dev, VERICAN_TIMELO_OFFSET);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

/* TCTRL with `clear` cleared and then `set` set; returns it. */
static uint32_t control(const verican_t *dev, uint32_t clear, uint32_t set) {
  const uint32_t token = verican_lock(dev);
  const uint32_t word = (verican_read(dev, VERICAN_TCTRL_OFFSET) & ~clear) | set;
  verican_write(dev, VERICAN_TCTRL_OFFSET, word);
  verican_unlock(dev, token);
  return word;
}

/* Under lock: the first pulse is that of the next whole second. What was written to the clock shows
 * five clocks later, which the reads take. Arming sets OUT to 0, and the pin is let out behind
 * that: one that was high would rise once more. */
static void start_pulses(const verican_t *dev) {
  uint64_t now = 0;
  for (unsigned n = 0; n < (unsigned)READS_OF_A_JUMP; ++n)
    now = verican_read_pair(dev, VERICAN_TIMELO_OFFSET);
  const uint64_t second = (now + ARM_NS) / SECOND_NS + 1u;
  (void)control(dev, VERICAN_PPS_PARTS, VERICAN_TCTRL_CMPEN_MASK);
  verican_write(dev, VERICAN_TCMPH_OFFSET, SECOND_NS / 2u);
  verican_write(dev, VERICAN_TCMP_OFFSET, (uint32_t)second * SECOND_NS);
  (void)control(dev, 0u, VERICAN_TCTRL_OUTEN_MASK);
}

/* The compare unit sees 32 bits, of which a second is no part: after a jump its pulses would go on
 * between the seconds. So a jump stops them, and they begin anew in a time that has arrived. A slew
 * was ordered for the time of before: it ends where another is set. */
static verican_result_t jump(const verican_t *dev, uint32_t low, uint64_t ns) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  const uint32_t token = verican_lock(dev);
  if (dev->pps) (void)control(dev, VERICAN_PPS_PARTS, 0u);
  if (low == (uint32_t)VERICAN_TIMELO_OFFSET) verican_write(dev, VERICAN_TSLEW_OFFSET, 0u);
  verican_write_pair(dev, low, (uint32_t)ns, (uint32_t)(ns >> 32));
  if (dev->pps) start_pulses(dev);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

verican_result_t verican_clock_set(const verican_t *dev, uint64_t ns) {
  return jump(dev, VERICAN_TIMELO_OFFSET, ns);
}

verican_result_t verican_clock_shift(const verican_t *dev, int64_t ns) {
  return jump(dev, VERICAN_TSHLO_OFFSET, (uint64_t)ns);
}

verican_result_t verican_clock_slew(const verican_t *dev, int32_t ns) {
  const verican_result_t result = check(dev);
  if (result == VERICAN_OK) verican_write(dev, VERICAN_TSLEW_OFFSET, (uint32_t)ns);
  return result;
}

void verican_write_rate(verican_t *dev, uint64_t increment) {
  dev->increment = increment;
  verican_write_pair(dev, VERICAN_TINCN_OFFSET, (uint32_t)(increment >> 32), (uint32_t)increment);
}

verican_result_t verican_clock_rate(verican_t *dev, uint64_t increment) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  if (increment >> 40 != 0u) return VERICAN_ERR_RANGE;
  verican_write_rate(dev, increment);
  return VERICAN_OK;
}

verican_result_t verican_clock_increment(const verican_t *dev, uint64_t *increment) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  if (increment == NULL) return VERICAN_ERR_NULL;
  *increment = dev->increment;
  return VERICAN_OK;
}

verican_result_t verican_clock_point(verican_t *dev, verican_stamp_point_t point, bool own_pin) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  if ((unsigned)point > (unsigned)VERICAN_STAMP_EOF) return VERICAN_ERR_RANGE;
  const uint32_t pin = own_pin ? VERICAN_TCTRL_TXPIN_MASK : 0u;
  verican_stamp_latencies(dev, control(dev, VERICAN_TCTRL_POINT_MASK | VERICAN_TCTRL_TXPIN_MASK,
                                       VERICAN_TCTRL_POINT_SET(point) | pin));
  return VERICAN_OK;
}

verican_result_t verican_clock_pps(verican_t *dev, bool on) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  const uint32_t token = verican_lock(dev);
  dev->pps = on;
  if (on)
    start_pulses(dev);
  else
    (void)control(dev, VERICAN_PPS_PARTS, 0u);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

/* The flags of TSTAT of these events, VERICAN_CLOCK_*. */
static uint32_t flags_of(uint32_t events) {
  uint32_t flags = 0;
  if ((events & VERICAN_TCTRL_EXTIE_MASK) != 0u)
    flags |= VERICAN_TSTAT_EXT_MASK | VERICAN_TSTAT_EXTOVR_MASK;
  if ((events & VERICAN_TCTRL_CMPIE_MASK) != 0u) flags |= VERICAN_TSTAT_CMP_MASK;
  if ((events & VERICAN_TCTRL_SLEWIE_MASK) != 0u) flags |= VERICAN_TSTAT_SLEWD_MASK;
  if ((events & VERICAN_TCTRL_TXIE_MASK) != 0u) flags |= VERICAN_TSTAT_TXREL_MASK;
  return flags;
}

/* Flags are set whether somebody has asked or not: those of before do not count. */
verican_result_t verican_clock_on_event(verican_t *dev, uint32_t events,
                                        verican_clock_event_t *on_event, void *user) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  if (on_event == NULL && events != 0u) return VERICAN_ERR_NULL;
  if ((events & ~(uint32_t)VERICAN_CLOCK_EVENTS) != 0u) return VERICAN_ERR_RANGE;
  const uint32_t token = verican_lock(dev);
  dev->on_clock = on_event;
  dev->clock_user = user;
  const uint32_t stale = flags_of(events & ~verican_read(dev, VERICAN_TCTRL_OFFSET));
  if (stale != 0u) verican_write(dev, VERICAN_TSTAT_OFFSET, stale);
  (void)control(dev, VERICAN_CLOCK_EVENTS, events);
  verican_unlock(dev, token);
  return VERICAN_OK;
}

verican_result_t verican_clock_irq_handler(verican_t *dev) {
  const verican_result_t result = check(dev);
  if (result != VERICAN_OK) return result;
  const uint32_t flags = verican_read(dev, VERICAN_TSTAT_OFFSET) & VERICAN_CLOCK_FLAGS;
  if (flags == 0u) return VERICAN_ERR_EMPTY;
  uint64_t time_ns = 0;
  if ((flags & VERICAN_TSTAT_EXT_MASK) != 0u) {
    const uint8_t latency = (uint8_t)VERICAN_TCAP_RXLAT_GET(verican_read(dev, VERICAN_TCAP_OFFSET));
    time_ns = verican_read_pair(dev, VERICAN_TEXTLO_OFFSET) - verican_half_clocks(dev, latency);
  }
  verican_write(dev, VERICAN_TSTAT_OFFSET, flags);
  if (dev->on_clock != NULL) dev->on_clock(dev->clock_user, dev, flags, time_ns);
  return VERICAN_OK;
}

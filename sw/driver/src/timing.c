/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Bit timing: from a bit rate to segments, and from segments to CTRL. Nothing here touches the
 * hardware. The limits are those of flexcan.md 1.2.
 */
#include "internal.h"

enum { QUANTA_MIN = 8, QUANTA_MAX = 25, SEGMENT_MAX = 8, PHASE2_MIN = 2, SJW_MAX = 4 };

static uint32_t distance(uint32_t a, uint32_t b) { return a > b ? a - b : b - a; }

static uint32_t quanta_of(const verican_timing_t *timing) {
  return 1u + timing->prop + timing->phase1 + timing->phase2;
}

uint32_t verican_bit_clocks(const verican_timing_t *timing) {
  return timing->prescaler * quanta_of(timing);
}

/* Error in ppm: the clock that would give the bit rate exactly, against the one there is. */
static uint32_t error_ppm(uint32_t clock_hz, uint32_t bitrate, uint32_t clocks_per_bit) {
  const uint32_t off = distance(clock_hz, bitrate * clocks_per_bit);
  if (off / (clock_hz / 1000u) >= 1000u) return 1000000u;
  /* 32 bits do: VERICAN_CLOCK_MAX / 100 x 1000 is below 2^32, beyond that the coarse way. */
  if (off <= 4000000u) return off * 1000u / (clock_hz / 1000u);
  return off / (clock_hz / 1000u) * 1000u;
}

/* Segments of a bit of `quanta` with the sample point nearest to the wish, in per mille. */
static void split(uint32_t quanta, uint32_t sample_point, verican_timing_t *timing) {
  uint32_t before = (quanta * sample_point + 500u) / 1000u; /* SYNC, PROP and PHASE1 */
  if (before > quanta - PHASE2_MIN) before = quanta - PHASE2_MIN;
  if (quanta - before > SEGMENT_MAX) before = quanta - SEGMENT_MAX;
  if (before > 1u + 2u * SEGMENT_MAX) before = 1u + 2u * SEGMENT_MAX;
  /* PHASE1 as long as PHASE2, but not less than half of what there is: the rest is propagation. */
  uint32_t phase1 = (before - 1u) / 2u;
  if (before - 1u - phase1 > SEGMENT_MAX) phase1 = before - 1u - SEGMENT_MAX;
  timing->prop = (uint8_t)(before - 1u - phase1);
  timing->phase1 = (uint8_t)phase1;
  timing->phase2 = (uint8_t)(quanta - before);
  timing->sample_point = (uint16_t)((before * 1000u + quanta / 2u) / quanta);
}

static uint8_t widest_sjw(const verican_timing_t *timing) {
  uint8_t sjw = timing->phase1 < timing->phase2 ? timing->phase1 : timing->phase2;
  return sjw < (uint8_t)SJW_MAX ? sjw : (uint8_t)SJW_MAX;
}

static uint32_t usual_sample_point(uint32_t bitrate) {
  if (bitrate > 800000u) return 750u;
  return bitrate > 500000u ? 800u : 875u;
}

verican_result_t verican_timing_find(uint32_t clock_hz, uint32_t bitrate, uint16_t sample_point,
                                     verican_timing_t *timing) {
  if (timing == NULL) return VERICAN_ERR_NULL;
  if (clock_hz < VERICAN_CLOCK_MIN || clock_hz > VERICAN_CLOCK_MAX) return VERICAN_ERR_RANGE;
  if (bitrate < VERICAN_BITRATE_MIN || bitrate > VERICAN_BITRATE_MAX) return VERICAN_ERR_RANGE;
  if (sample_point != 0u && (sample_point < 500u || sample_point > 900u)) return VERICAN_ERR_RANGE;

  const uint32_t wish = sample_point != 0u ? sample_point : usual_sample_point(bitrate);
  const uint32_t tolerance = sample_point != 0u ? VERICAN_SAMPLE_POINT_TOLERANCE : 1000u;
  verican_timing_t best = {0};
  uint32_t best_rate = VERICAN_BITRATE_TOLERANCE + 1u;
  uint32_t best_point = 0;
  for (uint32_t quanta = QUANTA_MAX; quanta >= QUANTA_MIN; --quanta) {
    const uint32_t per_bit = bitrate * quanta;
    const uint32_t prescaler = (clock_hz + per_bit / 2u) / per_bit;
    if (prescaler < 1u || prescaler > 256u) continue;
    verican_timing_t now = {0};
    split(quanta, wish, &now);
    const uint32_t rate = error_ppm(clock_hz, bitrate, prescaler * quanta);
    const uint32_t point = distance(now.sample_point, wish);
    if (rate > best_rate || point > tolerance) continue;
    if (rate == best_rate && point >= best_point) continue;
    best = now;
    best.prescaler = (uint16_t)prescaler;
    best.bitrate = clock_hz / (prescaler * quanta);
    best.error_ppm = rate;
    best_rate = rate;
    best_point = point;
  }
  if (best.prescaler == 0u) return VERICAN_ERR_TIMING;
  best.sjw = widest_sjw(&best);
  *timing = best;
  return VERICAN_OK;
}

static bool within(uint32_t value, uint32_t low, uint32_t high) {
  return value >= low && value <= high;
}

verican_result_t verican_timing_check(uint32_t clock_hz, verican_timing_t *timing) {
  if (timing == NULL) return VERICAN_ERR_NULL;
  if (!within(clock_hz, VERICAN_CLOCK_MIN, VERICAN_CLOCK_MAX)) return VERICAN_ERR_RANGE;
  const bool ok = within(timing->prescaler, 1, 256) && within(timing->prop, 1, SEGMENT_MAX) &&
                  within(timing->phase1, 1, SEGMENT_MAX) &&
                  within(timing->phase2, PHASE2_MIN, SEGMENT_MAX) &&
                  within(timing->sjw, 1, widest_sjw(timing)) &&
                  within(quanta_of(timing), QUANTA_MIN, QUANTA_MAX);
  if (!ok) return VERICAN_ERR_RANGE;
  const uint32_t quanta = quanta_of(timing);
  const uint32_t before = quanta - timing->phase2;
  timing->bitrate = clock_hz / (timing->prescaler * quanta);
  timing->sample_point = (uint16_t)((before * 1000u + quanta / 2u) / quanta);
  timing->error_ppm = 0;
  return VERICAN_OK;
}

uint32_t verican_timing_bits(const verican_timing_t *timing) {
  return (timing->prescaler - 1u) << VERICAN_CTRL1_PRESDIV_SHIFT |
         (timing->sjw - 1u) << VERICAN_CTRL1_RJW_SHIFT |
         (timing->phase1 - 1u) << VERICAN_CTRL1_PSEG1_SHIFT |
         (timing->phase2 - 1u) << VERICAN_CTRL1_PSEG2_SHIFT |
         (timing->prop - 1u) << VERICAN_CTRL1_PROPSEG_SHIFT;
}

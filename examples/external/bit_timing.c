/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The C driver without any controller: the bit timing for a clock.
 */
#include <stdio.h>

#include "verican/verican.h"

int main(void) {
  verican_timing_t t;
  const verican_result_t result = verican_timing_find(8000000, 500000, 875, &t);
  if (result != VERICAN_OK) {
    fprintf(stderr, "bit_timing: %s\n", verican_result_name(result));
    return 1;
  }
  printf("%lu bit/s: prescaler %u, %u quanta, sample point %u per mille\n",
         (unsigned long)t.bitrate, t.prescaler, 1u + t.prop + t.phase1 + t.phase2, t.sample_point);
  return 0;
}

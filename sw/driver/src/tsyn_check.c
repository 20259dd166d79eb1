/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Whether there is a time domain to work on.
 */
#include "tsyn_device.h"

verican_result_t verican_tsyn_check(const verican_tsyn_t *tsyn) {
  if (tsyn == NULL) return VERICAN_ERR_NULL;
  return tsyn->started ? VERICAN_OK : VERICAN_ERR_STATE;
}

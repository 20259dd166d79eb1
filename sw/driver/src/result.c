/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Names of results.
 */
#include "internal.h"

const char *verican_result_name(verican_result_t result) {
  static const char *const names[] = {
      "ok",
      "pointer missing",
      "value out of range",
      "wrong state",
      "timeout",
      "busy",
      "empty",
      "not supported by this core",
      "no space",
      "no such bit timing",
      "not this device",
      "self-test failed",
  };
  const int index = -(int)result;
  if (index < 0 || index >= (int)(sizeof names / sizeof names[0])) return "unknown";
  return names[index];
}

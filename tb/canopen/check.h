/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Checks of a test in C: what does not hold is printed and counted.
 */
#ifndef TB_CANOPEN_CHECK_H
#define TB_CANOPEN_CHECK_H

#include <stdio.h>

static unsigned failures;

#define CHECK(condition)                                         \
  do {                                                           \
    if (condition) break;                                        \
    ++failures;                                                  \
    printf("line %d: %s does not hold\n", __LINE__, #condition); \
  } while (0)

#endif

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What writers and readers of CanTSyn messages share (docs/time-spec.md 7.1).
 */
#ifndef VERICAN_SRC_TSYN_INTERNAL_H
#define VERICAN_SRC_TSYN_INTERNAL_H

#include "verican/tsyn.h"

/* Types without CRC; with it they are 0x10 higher. */
#define TSYN_SYNC 0x10u
#define TSYN_FUP 0x18u
#define TSYN_WITH_CRC 0x10u

/* Byte 3 of FUP. */
#define TSYN_SGW 0x04u
#define TSYN_OVS 0x03u

#endif /* VERICAN_SRC_TSYN_INTERNAL_H */

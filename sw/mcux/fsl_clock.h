/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The clock driver of NXP's SDK for a board with one clock, which nothing switches off: the SDK is
 * compiled with FSL_SDK_DISABLE_DRIVER_CLOCK_CONTROL.
 */
#ifndef VERICAN_FSL_CLOCK_H
#define VERICAN_FSL_CLOCK_H

#endif /* VERICAN_FSL_CLOCK_H */

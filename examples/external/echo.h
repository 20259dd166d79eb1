/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * echo: an application as it would run on a microcontroller: sends each frame back under the next
 * identifier.
 */
#ifndef ECHO_H
#define ECHO_H

#include "verican/verican.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Sets the controller behind `port` up for 500 kbit/s and joins the bus. */
verican_result_t echo_start(const verican_port_t *port, uint32_t clock_hz);
/** The interrupt handler. */
void echo_interrupt(void);
/** The main loop's work: answers what has come; returns the number of answers. */
unsigned echo_work(void);

#ifdef __cplusplus
}
#endif
#endif

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * uartbone: registers at the other end of a serial line, in the protocol of LiteX's UARTBone.
 */
#ifndef UARTBONE_H
#define UARTBONE_H

#include <stdbool.h>
#include <stdint.h>

/** A line that is open. */
typedef struct uartbone {
  int file;
  int timeout_ms;    /**< for each byte that is read */
  const char *error; /**< what went wrong first, or NULL; reads are 0 from then on */
} uartbone_t;

/** Opens a serial device or pseudo-terminal at 115,200 bit/s, 8N1. False: see errno. */
bool uartbone_open(uartbone_t *line, const char *path, int timeout_ms);

/** Reads the word at byte address `address`. */
uint32_t uartbone_read(uartbone_t *line, uint32_t address);

/** Writes it. */
void uartbone_write(uartbone_t *line, uint32_t address, uint32_t value);

#endif

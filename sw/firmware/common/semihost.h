/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Printing and ending by semihosting (BKPT 0xAB): a debugger, or `verican firmware`, serves it.
 */
#ifndef FIRMWARE_SEMIHOST_H
#define FIRMWARE_SEMIHOST_H

#include <stdint.h>

/** Prints a text. */
void semihost_print(const char *text);

/**
 * Prints with the conversions %s, %u, %d, %x (at least `n` digits with %0nx, n below 10), %c, %%.
 * Lines of up to 127 characters; what is longer is cut.
 */
void semihost_printf(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Microseconds since reset, modulo 2^32. */
uint32_t semihost_microseconds(void);

/** Ends the program; 0 is success. */
void semihost_exit(int code) __attribute__((noreturn));

#endif /* FIRMWARE_SEMIHOST_H */

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Semihosting calls and a small printf, so that the examples need no C library for output.
 */
#include "semihost.h"

#include <stdarg.h>
#include <stddef.h>

enum { SYS_WRITE0 = 0x04, SYS_EXIT_EXTENDED = 0x20, SYS_ELAPSED = 0x30 };
enum { ADP_APPLICATION_EXIT = 0x20026 };
enum { LINE = 128 };

static uint32_t call(uint32_t operation, const volatile void *parameter) {
  register uint32_t r0 __asm__("r0") = operation;
  register const volatile void *r1 __asm__("r1") = parameter;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

typedef struct {
  char text[LINE];
  size_t length;
} line_t;

static void put(line_t *line, char c) {
  if (line->length < LINE - 1) line->text[line->length++] = c;
}

static void put_number(line_t *line, uint32_t value, uint32_t base, unsigned digits) {
  char text[10];
  unsigned count = 0;
  do {
    const uint32_t digit = value % base;
    text[count++] = (char)(digit < 10 ? '0' + digit : 'A' + digit - 10);
    value /= base;
  } while (value != 0 || (count < digits && count < sizeof text));
  while (count > 0) put(line, text[--count]);
}

static void put_signed(line_t *line, int32_t value) {
  if (value < 0) put(line, '-');
  put_number(line, value < 0 ? 0u - (uint32_t)value : (uint32_t)value, 10, 1);
}

void semihost_print(const char *text) { call(SYS_WRITE0, text); }

void semihost_printf(const char *format, ...) {
  line_t line = {.length = 0};
  va_list arguments;
  va_start(arguments, format);
  for (const char *at = format; *at != '\0'; ++at) {
    if (*at != '%') {
      put(&line, *at);
      continue;
    }
    unsigned digits = 1;
    if (at[1] == '0') {
      digits = (unsigned)(at[2] - '0');
      at += 2;
    }
    switch (*++at) {
      case 's':
        for (const char *s = va_arg(arguments, const char *); *s != '\0'; ++s) put(&line, *s);
        break;
      case 'u': put_number(&line, va_arg(arguments, unsigned), 10, digits); break;
      case 'd': put_signed(&line, va_arg(arguments, int)); break;
      case 'x': put_number(&line, va_arg(arguments, unsigned), 16, digits); break;
      case 'c': put(&line, (char)va_arg(arguments, int)); break;
      default: put(&line, *at); break;
    }
  }
  va_end(arguments);
  line.text[line.length] = '\0';
  semihost_print(line.text);
}

uint32_t semihost_microseconds(void) {
  volatile uint32_t ticks[2] = {0, 0};
  call(SYS_ELAPSED, ticks);
  return ticks[0];
}

void semihost_exit(int code) {
  const uint32_t block[2] = {ADP_APPLICATION_EXIT, (uint32_t)code};
  call(SYS_EXIT_EXTENDED, block);
  for (;;) {
  }
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * uartbone: see uartbone.h.
 */
#define _DEFAULT_SOURCE
#include "uartbone.h"

#include <fcntl.h>
#include <poll.h>
#include <stddef.h>
#include <termios.h>
#include <unistd.h>

enum { WRITE_INCR = 1, READ_INCR = 2, HEAD = 6, WORD = 4 };

bool uartbone_open(uartbone_t *line, const char *path, int timeout_ms) {
  struct termios settings;
  line->timeout_ms = timeout_ms;
  line->error = NULL;
  line->file = open(path, O_RDWR | O_NOCTTY);
  if (line->file < 0) return false;
  if (tcgetattr(line->file, &settings) != 0) return false;
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~(tcflag_t)CSTOPB;
  (void)cfsetspeed(&settings, B115200);
  if (tcsetattr(line->file, TCSANOW, &settings) != 0) return false;
  return tcflush(line->file, TCIOFLUSH) == 0;
}

static void put(uint8_t *bytes, uint32_t word) {
  for (int i = 0; i < WORD; ++i) bytes[i] = (uint8_t)(word >> (24 - 8 * i));
}

static void send(uartbone_t *line, const uint8_t *bytes, size_t count) {
  while (count > 0 && line->error == NULL) {
    const ssize_t written = write(line->file, bytes, count);
    if (written <= 0) {
      line->error = "the serial line cannot be written";
      return;
    }
    bytes += written;
    count -= (size_t)written;
  }
}

static void receive(uartbone_t *line, uint8_t *bytes, size_t count) {
  while (count > 0 && line->error == NULL) {
    struct pollfd ready = {.fd = line->file, .events = POLLIN};
    if (poll(&ready, 1, line->timeout_ms) <= 0) {
      line->error = "no answer on the serial line";
      return;
    }
    const ssize_t got = read(line->file, bytes, count);
    if (got <= 0) {
      line->error = "the serial line cannot be read";
      return;
    }
    bytes += got;
    count -= (size_t)got;
  }
}

uint32_t uartbone_read(uartbone_t *line, uint32_t address) {
  uint8_t command[HEAD] = {READ_INCR, 1};
  uint8_t word[WORD] = {0};
  put(command + 2, address >> 2);
  send(line, command, sizeof command);
  receive(line, word, sizeof word);
  if (line->error != NULL) return 0;
  return (uint32_t)word[0] << 24 | (uint32_t)word[1] << 16 | (uint32_t)word[2] << 8 | word[3];
}

void uartbone_write(uartbone_t *line, uint32_t address, uint32_t value) {
  uint8_t command[HEAD + WORD] = {WRITE_INCR, 1};
  put(command + 2, address >> 2);
  put(command + HEAD, value);
  send(line, command, sizeof command);
}

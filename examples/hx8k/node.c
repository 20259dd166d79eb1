/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * node: the C driver on a PC, with the core at the other end of a serial line (can_hx8k). Prints
 * what it receives as candump -L does, sends the lines of its standard input, such as 123#1122.
 */
#define _DEFAULT_SOURCE
#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "uartbone.h"
#include "verican/verican.h"

#define CLOCK_HZ 12000000u

/** What the command line says. */
typedef struct options {
  const char *device;
  uint32_t bitrate;
  int timeout_ms;
  bool listen; /* after the end of the input, too */
} options_t;

static const char usage[] =
    "usage: node [-b BITRATE] [-t MS] [-l] DEVICE\n"
    "  DEVICE      serial port of the board, such as /dev/ttyUSB1\n"
    "  -b BITRATE  of the bus, bit/s (500000)\n"
    "  -t MS       how long the board may take to answer (2000)\n"
    "  -l          goes on after the end of the input\n"
    "Input, a frame a line: 123#1122 (data), 12345678# (29 bits), 123#R4 (remote)\n";

static uint32_t read32(void *line, uint32_t offset) { return uartbone_read(line, offset); }
static void write32(void *line, uint32_t offset, uint32_t value) {
  uartbone_write(line, offset, value);
}

static void on_state(void *user, verican_t *dev, verican_state_t state) {
  (void)user;
  (void)dev;
  const char *name = state == VERICAN_STATE_BUS_OFF   ? "bus-off"
                     : state == VERICAN_STATE_PASSIVE ? "error passive"
                     : state == VERICAN_STATE_WARNING ? "error warning"
                                                      : "error active";
  (void)fprintf(stderr, "node: %s\n", name);
}

static bool number(const char *text, uint32_t least, uint32_t most, uint32_t *value) {
  char *end = NULL;
  errno = 0;
  const unsigned long got = strtoul(text, &end, 10);
  if (errno != 0 || end == text || *end != '\0' || got < least || got > most) return false;
  *value = (uint32_t)got;
  return true;
}

static bool parse_options(int argc, char **argv, options_t *options) {
  uint32_t timeout = 2000;
  *options = (options_t){.bitrate = 500000};
  for (int letter = 0; (letter = getopt(argc, argv, "b:t:l")) != -1;) {
    if (letter == 'l') {
      options->listen = true;
    } else if (letter == 'b' && !number(optarg, 1000, 1000000, &options->bitrate)) {
      (void)fprintf(stderr, "node: -b %s: allowed are 1000 to 1000000\n", optarg);
      return false;
    } else if (letter == 't' && !number(optarg, 1, 600000, &timeout)) {
      (void)fprintf(stderr, "node: -t %s: allowed are 1 to 600000\n", optarg);
      return false;
    } else if (letter == '?') {
      (void)fputs(usage, stderr);
      return false;
    }
  }
  options->timeout_ms = (int)timeout;
  if (optind + 1 != argc) (void)fputs(usage, stderr);
  options->device = argv[optind];
  return optind + 1 == argc;
}

/* False, with a word of it, if the output cannot be written. A frame may tell that one before it
 * was overwritten. */
static bool print_frame(const verican_frame_t *frame, uint32_t bitrate) {
  if ((frame->flags & VERICAN_FRAME_OVERRUN) != 0)
    (void)fputs("node: frames were lost: the serial port is slower than the bus\n", stderr);
  const unsigned long long micros = frame->timestamp * 1000000u / bitrate;
  (void)printf("(%llu.%06llu) can0 ", micros / 1000000u, micros % 1000000u);
  (void)printf((frame->flags & VERICAN_FRAME_EXTENDED) != 0 ? "%08X#" : "%03X#",
               (unsigned)frame->id);
  if ((frame->flags & VERICAN_FRAME_REMOTE) != 0) {
    (void)printf("R%u", frame->dlc < 8 ? frame->dlc : 8u);
  } else {
    for (unsigned i = 0; i < frame->dlc && i < 8; ++i) (void)printf("%02X", frame->data[i]);
  }
  (void)putchar('\n');
  if (fflush(stdout) == 0) return true;
  (void)fprintf(stderr, "node: standard output: %s\n", strerror(errno));
  return false;
}

/* A line of the input as a frame; false if it is none. */
static bool parse_frame(const char *text, verican_frame_t *frame) {
  static const char hexadecimal[] = "0123456789abcdefABCDEF";
  const char *mark = strchr(text, '#');
  *frame = (verican_frame_t){0};
  if (mark == NULL || (mark - text != 3 && mark - text != 8)) return false;
  if (strspn(text, hexadecimal) != (size_t)(mark - text)) return false;
  frame->id = (uint32_t)strtoul(text, NULL, 16);
  if (mark - text == 8) frame->flags = VERICAN_FRAME_EXTENDED;
  if (mark[1] == 'R') {
    frame->flags |= VERICAN_FRAME_REMOTE;
    frame->dlc = (uint8_t)(mark[2] >= '0' && mark[2] <= '8' ? mark[2] - '0' : 0);
    return mark[2] == '\0' || (mark[2] <= '8' && mark[2] >= '0' && mark[3] == '\0');
  }
  const size_t digits = strlen(mark + 1);
  if (digits > 16 || digits % 2 != 0) return false;
  if (strspn(mark + 1, hexadecimal) != digits) return false;
  frame->dlc = (uint8_t)(digits / 2);
  for (size_t i = 0; i < digits / 2; ++i) {
    const char byte[3] = {mark[1 + 2 * i], mark[2 + 2 * i], '\0'};
    frame->data[i] = (uint8_t)strtoul(byte, NULL, 16);
  }
  return true;
}

/** Standard input, read without waiting. */
typedef struct input {
  char text[4096];
  size_t used;
  bool ended;
} input_t;

static void fill(input_t *input) {
  struct pollfd ready = {.fd = STDIN_FILENO, .events = POLLIN};
  if (input->ended || input->used == sizeof input->text) return;
  if (poll(&ready, 1, 0) <= 0) return;
  const ssize_t got =
      read(STDIN_FILENO, input->text + input->used, sizeof input->text - input->used);
  if (got > 0) input->used += (size_t)got;
  if (got > 0) return;
  input->ended = true;
  /* The last line may have no end. */
  if (input->used != 0 && input->text[input->used - 1] != '\n') input->text[input->used++] = '\n';
}

/* Sends the first whole line if there is one and a mailbox is free. */
static bool send_line(verican_t *can, input_t *input) {
  char *end = memchr(input->text, '\n', input->used);
  verican_frame_t frame;
  if (end == NULL) {
    if (input->used < sizeof input->text) return true;
    (void)fputs("node: a line of the input is too long\n", stderr);
    return false;
  }
  *end = '\0';
  if (*input->text != '\0') {
    if (!parse_frame(input->text, &frame)) {
      (void)fprintf(stderr, "node: '%s' is no frame; 123#1122 is one\n", input->text);
      return false;
    }
    const verican_result_t result = verican_send(can, &frame, NULL);
    *end = '\n';
    if (result == VERICAN_ERR_BUSY) return true; /* later */
    if (result != VERICAN_OK) {
      (void)fprintf(stderr, "node: %s\n", verican_result_name(result));
      return false;
    }
  }
  input->used -= (size_t)(end + 1 - input->text);
  memmove(input->text, end + 1, input->used);
  return true;
}

static verican_result_t start(verican_t *can, uartbone_t *line, const options_t *options) {
  static verican_frame_t ring[256];
  verican_config_t config;
  verican_result_t result = verican_config_default(&config);
  if (result != VERICAN_OK) return result;
  config.port.read32 = read32;
  config.port.write32 = write32;
  config.port.context = line;
  config.clock_hz = CLOCK_HZ;
  config.bitrate = options->bitrate;
  config.tx_order = VERICAN_TX_IN_ORDER; /* as the lines came */
  config.rx_ring = ring;
  config.rx_ring_size = sizeof ring / sizeof ring[0];
  config.callbacks.on_state = on_state;
  result = verican_init(can, &config);
  return result == VERICAN_OK ? verican_start(can) : result;
}

/* Until the input is over and everything sent, or the line fails. */
static bool work(verican_t *can, uartbone_t *line, const options_t *options) {
  static input_t input;
  for (;;) {
    verican_frame_t frame;
    uint64_t now = 0;
    uint8_t waiting = 0;
    (void)verican_irq_handler(can);
    (void)verican_time(can, &now); /* or a silence would be missing in the times of frames */
    if (line->error != NULL) return false;
    while (verican_receive(can, &frame) == VERICAN_OK)
      if (!print_frame(&frame, options->bitrate)) return false;
    fill(&input);
    if (!send_line(can, &input)) return false;
    (void)verican_tx_waiting(can, &waiting);
    if (input.ended && input.used == 0 && waiting == 0 && !options->listen) return true;
  }
}

int main(int argc, char **argv) {
  options_t options;
  uartbone_t line;
  verican_t can;
  if (!parse_options(argc, argv, &options)) return 2;
  if (!uartbone_open(&line, options.device, options.timeout_ms)) {
    (void)fprintf(stderr, "node: %s: %s\n", options.device, strerror(errno));
    return 1;
  }
  memset(&can, 0, sizeof can);
  const verican_result_t result = start(&can, &line, &options);
  if (result == VERICAN_OK && work(&can, &line, &options)) return 0;
  if (line.error != NULL)
    (void)fprintf(stderr, "node: %s: %s\n", options.device, line.error);
  else if (result != VERICAN_OK)
    (void)fprintf(stderr, "node: the core cannot be started: %s\n", verican_result_name(result));
  return 1;
}

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// request DEVICE perout PERIOD [start=NS] [phase=NS] [on=NS] [once]
// request DEVICE pps 0|1
// request DEVICE phase NS
// One request to a hardware clock, with what testptp has no option for; prints ok or the error's
// name. Times in ns; a period of 0 turns the output off.
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <linux/ptp_clock.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/timex.h>
#include <time.h>

static struct ptp_clock_time clock_time(const char *text) {
  const long long ns = atoll(text);
  return (struct ptp_clock_time){.sec = ns / 1000000000, .nsec = (unsigned)(ns % 1000000000)};
}

static int perout(int clock, int words, char **word) {
  struct ptp_perout_request request = {.period = clock_time(word[0])};
  for (int n = 1; n < words; ++n) {
    if (strncmp(word[n], "start=", 6) == 0) request.start = clock_time(word[n] + 6);
    if (strncmp(word[n], "phase=", 6) == 0) {
      request.phase = clock_time(word[n] + 6);
      request.flags |= PTP_PEROUT_PHASE;
    }
    if (strncmp(word[n], "on=", 3) == 0) {
      request.on = clock_time(word[n] + 3);
      request.flags |= PTP_PEROUT_DUTY_CYCLE;
    }
    if (strcmp(word[n], "once") == 0) request.flags |= PTP_PEROUT_ONE_SHOT;
  }
  return ioctl(clock, PTP_PEROUT_REQUEST2, &request);
}

static int phase(int clock, const char *text) {
  struct timex change = {.modes = ADJ_OFFSET | ADJ_NANO, .offset = atol(text)};
  const clockid_t id = ~(clockid_t)clock << 3 | 3;  // as the kernel makes one of a descriptor
  return clock_adjtime(id, &change) < 0 ? -1 : 0;
}

static int asked(int clock, int words, char **word) {
  if (strcmp(word[0], "pps") == 0) return ioctl(clock, PTP_ENABLE_PPS, atoi(word[1]));
  if (strcmp(word[0], "phase") == 0) return phase(clock, word[1]);
  return perout(clock, words - 1, word + 1);
}

int main(int argc, char **argv) {
  if (argc < 4) return 2;
  const int clock = open(argv[1], O_RDWR);
  if (clock < 0) return 2;
  const int result = asked(clock, argc - 2, argv + 2);
  puts(result == 0 ? "ok" : strerrorname_np(errno));
  return 0;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A follower of IEEE 1588 over CAN as it was published (TM-57). All followers share the identifiers
 * of their messages, so each sends at a time of its own.
 */
#include "verican/delay.h"

#define REQUEST_AFTER_NS 5000000u
#define REPORT_AFTER_NS 2000000u

static void write_word(uint32_t word, uint8_t *data) {
  for (unsigned i = 0; i < 4u; ++i) data[i] = (uint8_t)(word >> (24u - 8u * i));
}

void verican_p4_write_time(uint64_t time, uint8_t data[8]) {
  write_word((uint32_t)(time >> 32), data);
  write_word((uint32_t)time, data + 4);
}

uint64_t verican_p4_read_time(const uint8_t data[8]) {
  uint64_t time = 0;
  for (unsigned i = 0; i < 8u; ++i) time = time << 8 | data[i];
  return time;
}

void verican_p4_on_sync(verican_p4_t *p4, uint64_t stamp) { p4->pair.local = stamp; }

int64_t verican_p4_on_follow_up(verican_p4_t *p4, const uint8_t data[8], uint64_t now) {
  p4->pair.master = verican_p4_read_time(data);
  p4->offset = (int64_t)(p4->pair.local - p4->pair.master - (uint64_t)(int64_t)p4->delay);
  (void)verican_delay_start(&p4->measure, 1);
  (void)verican_delay_pair(&p4->measure, &p4->pair, 0);
  p4->due = now + p4->number * (uint64_t)REQUEST_AFTER_NS;
  p4->next = VERICAN_P4_DELAY_REQ;
  return p4->offset;
}

void verican_p4_shifted(verican_p4_t *p4, int64_t shift) {
  p4->due += (uint64_t)shift;
  p4->measure.forth = (int64_t)((uint64_t)p4->measure.forth + (uint64_t)shift);
}

uint32_t verican_p4_poll(verican_p4_t *p4, uint64_t now, uint8_t data[8]) {
  const uint32_t message = p4->next;
  if (message == 0u || (int64_t)(now - p4->due) < 0) return 0;
  p4->next = 0;
  if (message == (uint32_t)VERICAN_P4_DELAY_OFFSET) {
    write_word((uint32_t)p4->delay, data);
    write_word((uint32_t)p4->offset, data + 4);
  }
  return message;
}

void verican_p4_on_sent(verican_p4_t *p4, uint64_t stamp) {
  verican_delay_sent(&p4->measure, stamp);
}

bool verican_p4_on_response(verican_p4_t *p4, const uint8_t data[8], uint64_t now) {
  if (!verican_delay_response(&p4->measure, verican_p4_read_time(data), &p4->delay)) return false;
  p4->due = now + REPORT_AFTER_NS;
  p4->next = VERICAN_P4_DELAY_OFFSET;
  return true;
}

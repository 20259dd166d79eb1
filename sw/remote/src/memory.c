/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reading, writing and configuring one node.
 */
#include <string.h>

#include "internal.h"

/* Writes that one reading of STATUS confirms: its counts are modulo 256, and a write may come
 * twice (RN-31). */
enum { CONFIRMED_AT_ONCE = 100 };

result_t verican_remote_init(client_t *c, const verican_remote_port_t *port, uint8_t name_bits) {
  if (c == NULL || port == NULL || port->send == NULL || port->receive == NULL ||
      port->now_us == NULL || (name_bits != 3 && name_bits != 5))
    return VERICAN_REMOTE_ARGUMENT;
  memset(c, 0, sizeof *c);
  c->port = *port;
  c->name_bits = name_bits;
  c->timeout_us = 150000;
  c->select_us = 50000;
  c->tries = 3;
  return VERICAN_REMOTE_OK;
}

bool vr_range_is_good(const void *data, size_t address, size_t length) {
  return data != NULL && length >= 1 && length <= MEMORY_END && address + length <= MEMORY_END;
}

result_t verican_remote_read(client_t *c, uint8_t number, uint16_t address, uint8_t *data,
                             size_t length) {
  if (c == NULL || !vr_is_node(c, number) || !vr_range_is_good(data, address, length))
    return VERICAN_REMOTE_ARGUMENT;
  while (length != 0) {
    frame_t request, frame;
    answer_t answer;
    const unsigned n = vr_read_request(c, number, address, (unsigned)length, &request, &answer);
    const result_t result = vr_ask_again(c, number, &request, &answer, &frame);
    c->address = address;
    if (result != VERICAN_REMOTE_OK) return result;
    memcpy(data, frame.data + answer.head, n);
    data += n;
    length -= n;
    address = (uint16_t)(address + n);
  }
  return VERICAN_REMOTE_OK;
}

/* Bytes of a write of `length` from `address` that one frame takes. */
static unsigned write_size(const client_t *c, unsigned address, size_t length) {
  const unsigned window = vr_window(c);
  unsigned room = 6;
  if (address < window) room = window - address < 8 ? window - address : 8;
  return length < room ? (unsigned)length : room;
}

/* The frame that writes `n` bytes as write_size() told them. */
static frame_t write_frame(const client_t *c, unsigned number, unsigned address,
                           const uint8_t *data, unsigned n) {
  const bool direct = address < vr_window(c);
  const unsigned head = direct ? 0 : 2;
  frame_t frame = {.id = vr_id(c, number, direct ? address : vr_port(c, PORT_WRITE)),
                   .dlc = (uint8_t)(head + n),
                   .data = {(uint8_t)address, (uint8_t)(address >> 8)}};
  memcpy(frame.data + head, data, n);
  return frame;
}

result_t verican_remote_write(client_t *c, uint8_t number, uint16_t address, const uint8_t *data,
                              size_t length) {
  if (c == NULL || (number != VERICAN_REMOTE_ALL && !vr_is_node(c, number)) ||
      !vr_range_is_good(data, address, length))
    return VERICAN_REMOTE_ARGUMENT;
  while (length != 0) {
    const unsigned n = write_size(c, address, length);
    const frame_t frame = write_frame(c, number, address, data, n);
    const result_t result = vr_send(c, &frame);
    c->address = address;
    if (result != VERICAN_REMOTE_OK) return result;
    data += n;
    length -= n;
    address = (uint16_t)(address + n);
  }
  return VERICAN_REMOTE_OK;
}

/* Bytes 2 to 7 of STATUS at one moment, REC, code, A, accepted, refused and TRIGGER, into row[2] to
 * row[7]. READ brings them, never a remote frame: what a node sends by itself (ACKW, ERRS, a
 * heartbeat) looks like the answer to that one, and the real one then makes the node busy. `ask`:
 * once, or as often as the client tries. */
static result_t read_counts(client_t *c, unsigned number,
                            result_t (*ask)(client_t *, unsigned, const frame_t *, const answer_t *,
                                            frame_t *),
                            uint8_t row[8]) {
  frame_t request, frame;
  answer_t answer;
  (void)vr_read_request(c, number, ROW_STATUS + 2u, 6, &request, &answer);
  const result_t result = ask(c, number, &request, &answer, &frame);
  if (result != VERICAN_REMOTE_OK) return result;
  memcpy(row, frame.data, 8); /* the two bytes of the head take the place of state and TEC */
  vr_note_refusals(c, number, row[6]);
  return VERICAN_REMOTE_OK;
}

/* Whether more has been refused since `before` than readings of the counts, of which `unanswered`
 * brought nothing. One more than those would be a request whose refusal the last one hides. */
static bool is_refused(const client_t *c, const uint8_t before[8], const uint8_t row[8],
                       unsigned unanswered) {
  const unsigned more = (uint8_t)(row[6] - before[6]);
  const bool busy = row[3] == VERICAN_REMOTE_CODE_BUSY && row[4] == vr_port(c, PORT_READ);
  return more != 0 && !(busy && more <= unanswered);
}

/* Whether `writes` more have been accepted since `before`, and none refused. TIMEOUT: nobody knows,
 * or they have been lost. */
static result_t confirm(client_t *c, unsigned number, const uint8_t before[8], unsigned writes) {
  uint8_t row[8];
  unsigned unanswered = 0;
  for (unsigned i = 0; i < vr_tries(c); i++) {
    const result_t result = read_counts(c, number, vr_ask, row);
    if (result == VERICAN_REMOTE_BUS_OFF) return result;
    if (result != VERICAN_REMOTE_OK) {
      unanswered++; /* busy: a refusal, but of this reading */
      continue;
    }
    if (is_refused(c, before, row, unanswered)) {
      c->code = row[3];
      return VERICAN_REMOTE_REFUSED;
    }
    if ((uint8_t)(row[5] - before[5]) >= writes) return VERICAN_REMOTE_OK;
  }
  return VERICAN_REMOTE_TIMEOUT;
}

/* Bytes that the next CONFIRMED_AT_ONCE frames of a write hold, and how many frames it takes. */
static size_t part_of_write(const client_t *c, unsigned address, size_t length, unsigned *frames) {
  size_t bytes = 0;
  for (*frames = 0; *frames < CONFIRMED_AT_ONCE && bytes < length; ++*frames)
    bytes += write_size(c, address + (unsigned)bytes, length - bytes);
  return bytes;
}

/* One part, confirmed, with all its tries. */
static result_t write_part(client_t *c, uint8_t number, uint16_t address, const uint8_t *data,
                           size_t length, unsigned frames) {
  uint8_t before[8];
  result_t result = VERICAN_REMOTE_TIMEOUT;
  for (unsigned i = 0; i < vr_tries(c) && result == VERICAN_REMOTE_TIMEOUT; i++) {
    result = read_counts(c, number, vr_ask_again, before);
    if (result == VERICAN_REMOTE_OK)
      result = verican_remote_write(c, number, address, data, length);
    if (result == VERICAN_REMOTE_OK) result = confirm(c, number, before, frames);
  }
  return result;
}

result_t verican_remote_write_confirmed(client_t *c, uint8_t number, uint16_t address,
                                        const uint8_t *data, size_t length) {
  if (c == NULL || !vr_is_node(c, number) || !vr_range_is_good(data, address, length))
    return VERICAN_REMOTE_ARGUMENT;
  while (length != 0) {
    unsigned frames;
    const size_t n = part_of_write(c, address, length, &frames);
    const result_t result = write_part(c, number, address, data, n, frames);
    c->address = address;
    if (result != VERICAN_REMOTE_OK) return result;
    data += n;
    length -= n;
    address = (uint16_t)(address + n);
  }
  return VERICAN_REMOTE_OK;
}

/* A row by remote frame, or in two parts by READ. */
static result_t read_row(client_t *c, unsigned number, unsigned port, unsigned address,
                         uint8_t row[8]) {
  if (c == NULL || !vr_is_node(c, number)) return VERICAN_REMOTE_ARGUMENT;
  if (c->data_frames) return verican_remote_read(c, (uint8_t)number, (uint16_t)address, row, 8);
  const uint16_t id = vr_id(c, number, vr_port(c, port));
  const frame_t request = {.id = id, .remote = true, .dlc = 8};
  const answer_t answer = {.id = (uint16_t)(id | STATEMENT), .dlc = 8, .bytes = 8};
  frame_t frame;
  const result_t result = vr_ask_again(c, number, &request, &answer, &frame);
  if (result == VERICAN_REMOTE_OK) memcpy(row, frame.data, 8);
  return result;
}

result_t verican_remote_status(client_t *c, uint8_t number, verican_remote_status_t *status) {
  uint8_t row[8];
  if (status == NULL) return VERICAN_REMOTE_ARGUMENT;
  const result_t result = read_row(c, number, PORT_STATUS, ROW_STATUS, row);
  if (result != VERICAN_REMOTE_OK) return result;
  vr_note_refusals(c, number, row[6]);
  vr_take_status(row, status);
  return VERICAN_REMOTE_OK;
}

result_t verican_remote_identity(client_t *c, uint8_t number, verican_remote_identity_t *identity) {
  uint8_t row[8];
  if (identity == NULL) return VERICAN_REMOTE_ARGUMENT;
  const result_t result = read_row(c, number, PORT_IDENT, ROW_IDENT, row);
  if (result == VERICAN_REMOTE_OK) vr_take_identity(number, row, identity);
  return result;
}

/* Operations of SETUP. */
enum { SETUP_UNLOCK = 1, SETUP_LOCK = 2, SETUP_CLEAR = 4 };

/* UNLOCK has the key behind it. */
static frame_t setup_frame(const client_t *c, unsigned number, unsigned op, uint32_t key) {
  const bool unlock = op == SETUP_UNLOCK;
  frame_t frame = {.id = vr_id(c, number, vr_port(c, PORT_SETUP)), .dlc = unlock ? 5 : 1};
  frame.data[0] = (uint8_t)op;
  for (unsigned i = 0; unlock && i < 4; i++) frame.data[1 + i] = (uint8_t)(key >> (8u * i));
  return frame;
}

/* Sends it, confirmed; `before`: the node's counts until then. */
static result_t setup(client_t *c, unsigned number, const frame_t *frame, const uint8_t before[8]) {
  const result_t result = vr_send(c, frame);
  return result == VERICAN_REMOTE_OK ? confirm(c, number, before, 1) : result;
}

result_t verican_remote_clear(client_t *c, uint8_t number) {
  if (c == NULL || !vr_is_node(c, number)) return VERICAN_REMOTE_ARGUMENT;
  const frame_t frame = setup_frame(c, number, SETUP_CLEAR, 0);
  uint8_t before[8];
  result_t result = VERICAN_REMOTE_TIMEOUT;
  for (unsigned i = 0; i < vr_tries(c) && result == VERICAN_REMOTE_TIMEOUT; i++) {
    result = read_counts(c, number, vr_ask_again, before);
    if (result == VERICAN_REMOTE_OK) result = setup(c, number, &frame, before);
  }
  return result;
}

/* A node that does not answer is told all the same. */
static result_t lock(client_t *c, unsigned number) {
  const frame_t frame = setup_frame(c, number, SETUP_LOCK, 0);
  uint8_t before[8];
  const result_t result = read_counts(c, number, vr_ask_again, before);
  if (result == VERICAN_REMOTE_OK) return setup(c, number, &frame, before);
  (void)vr_send(c, &frame);
  return result;
}

result_t verican_remote_configure(client_t *c, uint8_t number, uint32_t serial,
                                  const verican_remote_setting_t *settings, size_t count) {
  if (c == NULL || !vr_is_node(c, number) || (settings == NULL && count != 0))
    return VERICAN_REMOTE_ARGUMENT;
  for (size_t i = 0; i < count; i++)
    if (settings[i].length > 8 ||
        !vr_range_is_good(settings[i].data, settings[i].address, settings[i].length))
      return VERICAN_REMOTE_ARGUMENT;
  const frame_t unlock = setup_frame(c, number, SETUP_UNLOCK, serial);
  uint8_t before[8];
  result_t result = read_counts(c, number, vr_ask_again, before);
  if (result != VERICAN_REMOTE_OK) return result;
  result = setup(c, number, &unlock, before);
  for (size_t i = 0; i < count && result == VERICAN_REMOTE_OK; i++)
    result = verican_remote_write_confirmed(c, number, settings[i].address, settings[i].data,
                                            settings[i].length);
  const uint8_t code = c->code;            /* c->address stays: LOCK is no access to memory */
  const result_t locked = lock(c, number); /* also if nobody knows whether it was unlocked */
  if (result == VERICAN_REMOTE_OK) return locked;
  c->code = code;
  return result;
}

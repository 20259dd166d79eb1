/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What concerns all nodes: polls, TRIGGER, states, and who is there.
 */
#include <string.h>

#include "internal.h"

/* Collects what nodes answer to a request to all. `answer`: as node 0 would give it. */
static result_t gather(client_t *c, const frame_t *request, const answer_t *answer,
                       uint32_t expected, verican_remote_answers_t *poll) {
  memset(poll, 0, sizeof *poll);
  result_t result = vr_flush(c);
  if (result == VERICAN_REMOTE_OK) result = vr_send(c, request);
  if (result != VERICAN_REMOTE_OK) return result;
  wait_t wait = vr_wait(c, c->timeout_us);
  while (expected == 0 || (expected & ~poll->answered) != 0) {
    frame_t frame;
    result = vr_receive(c, &wait, &frame);
    if (result == VERICAN_REMOTE_TIMEOUT && expected == 0) return VERICAN_REMOTE_OK;
    if (result != VERICAN_REMOTE_OK) return result;
    const unsigned number = (frame.id & 0x3FFu) >> (10u - c->name_bits);
    answer_t wanted = *answer;
    wanted.id = (uint16_t)(answer->id | vr_id(c, number, 0));
    if (!vr_answers(&wanted, request, &frame)) {
      vr_pass_on(c, &frame);
      continue;
    }
    poll->answered |= UINT32_C(1) << number;
    memcpy(poll->data[number], frame.data + answer->head, answer->bytes);
  }
  return VERICAN_REMOTE_OK;
}

result_t verican_remote_poll(client_t *c, uint16_t address, uint8_t length, uint32_t expected,
                             verican_remote_answers_t *poll) {
  frame_t request;
  answer_t answer;
  if (c == NULL || poll == NULL || length == 0 || (uint32_t)address + length > MEMORY_END ||
      (expected >> 1 >> ((1u << c->name_bits) - 1u)) != 0)
    return VERICAN_REMOTE_ARGUMENT;
  if (vr_read_request(c, VERICAN_REMOTE_ALL, address, length, &request, &answer) != length)
    return VERICAN_REMOTE_ARGUMENT; /* more than one frame: not of one moment */
  return gather(c, &request, &answer, expected, poll);
}

result_t verican_remote_trigger(client_t *c, uint8_t count) {
  if (c == NULL) return VERICAN_REMOTE_ARGUMENT;
  const frame_t frame = {.id = vr_id(c, NAME_SYSTEM, SYSTEM_TRIGGER), .dlc = 1, .data = {count}};
  return vr_send(c, &frame);
}

result_t verican_remote_state(client_t *c, uint8_t number, uint8_t command) {
  if (c == NULL || (number != 0 && !vr_is_node(c, number)) ||
      (command != VERICAN_REMOTE_OPERATE && command != VERICAN_REMOTE_SAFE &&
       command != VERICAN_REMOTE_RESTART))
    return VERICAN_REMOTE_ARGUMENT;
  const frame_t frame = {
      .id = vr_id(c, NAME_SYSTEM, SYSTEM_STATE), .dlc = 2, .data = {command, number}};
  return vr_send(c, &frame);
}

result_t verican_remote_select(client_t *c, uint32_t value, uint32_t mask, bool only_new,
                               bool *here) {
  if (c == NULL || here == NULL) return VERICAN_REMOTE_ARGUMENT;
  frame_t frame = {.id = vr_id(c, NAME_SYSTEM, only_new ? SYSTEM_SELECT_NEW : SYSTEM_SELECT),
                   .dlc = 8};
  for (unsigned i = 0; i < 4; i++) {
    frame.data[2 * i] = (uint8_t)(value >> (8u * i));
    frame.data[2 * i + 1] = (uint8_t)(mask >> (8u * i));
  }
  result_t result = vr_flush(c);
  if (result == VERICAN_REMOTE_OK) result = vr_send(c, &frame);
  wait_t wait = vr_wait(c, c->select_us);
  *here = false;
  while (result == VERICAN_REMOTE_OK && !*here) {
    result = vr_receive(c, &wait, &frame);
    if (result != VERICAN_REMOTE_OK) break;
    *here = !frame.remote && frame.dlc == 0 && frame.id == (SYSTEM_SELECT | STATEMENT);
    if (!*here) vr_pass_on(c, &frame);
  }
  return result == VERICAN_REMOTE_TIMEOUT ? VERICAN_REMOTE_OK : result;
}

/* The smallest serial number from `*serial` on that a node without a number has, `*found`. Walks
 * down a tree of prefixes, most significant bit first: 33 SELECTs for a number (RN-26). */
static result_t next_serial(client_t *c, uint32_t *serial, bool *found) {
  uint32_t value = *serial;
  unsigned bit = 31; /* the last one of the prefix that is tried */
  for (;;) {
    const uint32_t mask = ~UINT32_C(0) << bit;
    const result_t result = verican_remote_select(c, value, mask, true, found);
    if (result != VERICAN_REMOTE_OK) return result;
    if (*found && bit == 0) {
      *serial = value;
      return VERICAN_REMOTE_OK;
    }
    if (*found) {
      bit--;
      continue;
    }
    /* Nobody has this prefix: on to the next larger one, which may be shorter. */
    while (bit < 32 && (value >> bit & 1u) != 0) bit++;
    if (bit == 32) return VERICAN_REMOTE_OK;
    value = (value | UINT32_C(1) << bit) & ~UINT32_C(0) << bit;
  }
}

/* Nodes with a number, by their IDENT. */
static result_t scan_numbers(client_t *c, verican_remote_identity_t *nodes, size_t places,
                             size_t *count) {
  verican_remote_answers_t head, tail;
  result_t result = verican_remote_poll(c, ROW_IDENT, 4, 0, &head);
  if (result == VERICAN_REMOTE_OK)
    result = verican_remote_poll(c, ROW_IDENT + 4, 4, head.answered, &tail);
  if (result != VERICAN_REMOTE_OK) return result;
  for (unsigned number = 0; number < VERICAN_REMOTE_NUMBERS && *count < places; number++) {
    if ((head.answered >> number & 1u) == 0) continue;
    memcpy(head.data[number] + 4, tail.data[number], 4);
    vr_take_identity(number, head.data[number], &nodes[(*count)++]);
  }
  return VERICAN_REMOTE_OK;
}

result_t verican_remote_scan(client_t *c, verican_remote_identity_t *nodes, size_t *count) {
  if (c == NULL || nodes == NULL || count == NULL) return VERICAN_REMOTE_ARGUMENT;
  const size_t places = *count;
  size_t found = 0;
  result_t result = scan_numbers(c, nodes, places, &found);
  uint32_t serial = 0;
  bool here = true;
  while (result == VERICAN_REMOTE_OK && here && found < places) {
    result = next_serial(c, &serial, &here);
    if (result != VERICAN_REMOTE_OK || !here) break;
    nodes[found++] = (verican_remote_identity_t){.serial = serial};
    here = ++serial != 0;
  }
  if (result == VERICAN_REMOTE_OK) *count = found;
  return result;
}

/* Whether a node has this serial number (`only_new`: and no number). */
static result_t find(client_t *c, uint32_t serial, bool only_new, bool *here) {
  result_t result = VERICAN_REMOTE_OK;
  *here = false;
  for (unsigned i = 0; i < c->tries && result == VERICAN_REMOTE_OK && !*here; i++)
    result = verican_remote_select(c, serial, ~UINT32_C(0), only_new, here);
  return result;
}

/* Sends ASSIGN 0: a node that has no number any more can only say that it is new. */
static result_t take_number(client_t *c, uint32_t serial, const frame_t *request) {
  bool here = false;
  result_t result = vr_send(c, request);
  if (result == VERICAN_REMOTE_OK) result = find(c, serial, true, &here);
  return result == VERICAN_REMOTE_OK && !here ? VERICAN_REMOTE_NOT_TAKEN : result;
}

/* Sends ASSIGN, which may come more than once (RN-27): the answer is STATUS of the new number. */
static result_t give_number(client_t *c, uint8_t number, const frame_t *request) {
  const answer_t answer = {.id = (uint16_t)(vr_id(c, number, vr_port(c, PORT_STATUS)) | STATEMENT),
                           .dlc = 8};
  frame_t frame;
  c->refusals_known &= ~(UINT32_C(1) << number);
  const result_t result = vr_ask_again(c, number, request, &answer, &frame);
  return result == VERICAN_REMOTE_TIMEOUT ? VERICAN_REMOTE_NOT_TAKEN : result;
}

result_t verican_remote_assign(client_t *c, uint32_t serial, uint8_t number) {
  if (c == NULL || (number != 0 && !vr_is_node(c, number))) return VERICAN_REMOTE_ARGUMENT;
  bool here = false;
  const result_t result = find(c, serial, false, &here);
  if (result != VERICAN_REMOTE_OK) return result;
  if (!here) return VERICAN_REMOTE_TIMEOUT;
  const frame_t request = {.id = vr_id(c, NAME_SYSTEM, SYSTEM_ASSIGN), .dlc = 1, .data = {number}};
  return number == 0 ? take_number(c, serial, &request) : give_number(c, number, &request);
}

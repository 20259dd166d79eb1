/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What concerns all nodes: polls, TRIGGER, states, and who is there.
 */
#include <string.h>

#include "internal.h"

/* Keeps the bytes of a node. The same once more is one frame that has come twice (VA-03). */
static void take_answer(verican_remote_answers_t *poll, unsigned number, const uint8_t *bytes,
                        size_t length) {
  const uint32_t bit = UINT32_C(1) << number;
  if ((poll->answered & bit) != 0 && memcmp(poll->data[number], bytes, length) != 0)
    poll->differing |= bit;
  poll->answered |= bit;
  memcpy(poll->data[number], bytes, length);
}

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
    if (!vr_is_node(c, number) || !vr_answers(&wanted, request, &frame)) {
      vr_pass_on(c, &frame);
      continue;
    }
    take_answer(poll, number, frame.data + answer->head, answer->bytes);
  }
  return VERICAN_REMOTE_OK;
}

result_t verican_remote_poll(client_t *c, uint16_t address, uint8_t length, uint32_t expected,
                             verican_remote_answers_t *poll) {
  frame_t request;
  answer_t answer;
  if (c == NULL || poll == NULL || length == 0 || (uint32_t)address + length > MEMORY_END ||
      (expected & 3u) != 0 || (expected >> 1 >> ((1u << c->name_bits) - 1u)) != 0)
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

/* Waits until HERE comes, for select_us at most. */
static result_t wait_for_here(client_t *c) {
  wait_t wait = vr_wait(c, c->select_us);
  result_t result = VERICAN_REMOTE_OK;
  while (result == VERICAN_REMOTE_OK && !c->here) {
    frame_t frame;
    result = vr_receive(c, &wait, &frame);
    if (result == VERICAN_REMOTE_OK) vr_pass_on(c, &frame);
  }
  return result == VERICAN_REMOTE_TIMEOUT ? VERICAN_REMOTE_OK : result;
}

/* Asks a node that answers for something, twice. HERE wins arbitration against all other frames of
 * nodes, so it comes before what answers a request behind SELECT, however slow the bus and the
 * computer are. Twice: a node that is error passive and has to repeat its HERE lets one frame pass
 * (IF-10). What the witness answers, or whether it does, is the same to us. */
static result_t wait_for_witness(client_t *c, unsigned witness) {
  enum { TIMES = 2 };
  frame_t request, frame;
  answer_t answer;
  (void)vr_read_request(c, witness, ROW_IDENT, 1, &request, &answer);
  result_t result = VERICAN_REMOTE_OK;
  for (unsigned i = 0; i < TIMES && result != VERICAN_REMOTE_BUS_OFF; i++)
    result = vr_ask_again(c, witness, &request, &answer, &frame);
  return result == VERICAN_REMOTE_BUS_OFF ? result : VERICAN_REMOTE_OK;
}

result_t vr_select(client_t *c, uint32_t value, uint32_t mask, bool only_new, unsigned witness,
                   bool *here) {
  frame_t frame = {.id = vr_id(c, NAME_SYSTEM, only_new ? SYSTEM_SELECT_NEW : SYSTEM_SELECT),
                   .dlc = 8};
  for (unsigned i = 0; i < 4; i++) {
    frame.data[2 * i] = (uint8_t)(value >> (8u * i));
    frame.data[2 * i + 1] = (uint8_t)(mask >> (8u * i));
  }
  result_t result = vr_flush(c);
  c->here = false;
  if (result == VERICAN_REMOTE_OK) result = vr_send(c, &frame);
  if (result == VERICAN_REMOTE_OK)
    result = witness == 0 ? wait_for_here(c) : wait_for_witness(c, witness);
  *here = c->here;
  return result;
}

result_t verican_remote_select(client_t *c, uint32_t value, uint32_t mask, bool only_new,
                               bool *here) {
  if (c == NULL || here == NULL) return VERICAN_REMOTE_ARGUMENT;
  return vr_select(c, value, mask, only_new, 0, here);
}

/* Whether a node has this serial number (`only_new`: and no number). */
static result_t find(client_t *c, uint32_t serial, bool only_new, bool *here) {
  result_t result = VERICAN_REMOTE_OK;
  *here = false;
  for (unsigned i = 0; i < vr_tries(c) && result == VERICAN_REMOTE_OK && !*here; i++)
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

/* Whether this node, and no other, has the number: what comes from there is its serial number. */
static result_t require_alone(client_t *c, uint8_t number, uint32_t serial) {
  verican_remote_answers_t its;
  const result_t result = verican_remote_poll(c, ROW_IDENT + 4, 4, 0, &its);
  if (result != VERICAN_REMOTE_OK) return result;
  const uint32_t bit = UINT32_C(1) << number;
  const bool alone = (its.answered & ~its.differing & bit) != 0;
  return alone && vr_serial(its.data[number]) == serial ? VERICAN_REMOTE_OK : VERICAN_REMOTE_IN_USE;
}

/* IN_USE if another node than that one has the number. Whoever has it answers a reading of what is
 * the same in all nodes, or refuses it; asked once, for what is disturbed on the bus is repeated
 * there. */
static result_t require_free(client_t *c, uint8_t number, uint32_t serial) {
  frame_t request, frame;
  answer_t answer;
  (void)vr_read_request(c, number, ROW_IDENT, 1, &request, &answer);
  const result_t result = vr_ask(c, number, &request, &answer, &frame);
  if (result == VERICAN_REMOTE_TIMEOUT) return VERICAN_REMOTE_OK;
  return result == VERICAN_REMOTE_BUS_OFF ? result : require_alone(c, number, serial);
}

result_t verican_remote_assign(client_t *c, uint32_t serial, uint8_t number) {
  if (c == NULL || (number != 0 && !vr_is_node(c, number))) return VERICAN_REMOTE_ARGUMENT;
  bool here = false;
  result_t result = find(c, serial, false, &here);
  if (result != VERICAN_REMOTE_OK) return result;
  if (!here) return VERICAN_REMOTE_TIMEOUT;
  if (number != 0) result = require_free(c, number, serial);
  if (result != VERICAN_REMOTE_OK) return result;
  const frame_t request = {.id = vr_id(c, NAME_SYSTEM, SYSTEM_ASSIGN), .dlc = 1, .data = {number}};
  return number == 0 ? take_number(c, serial, &request) : give_number(c, number, &request);
}

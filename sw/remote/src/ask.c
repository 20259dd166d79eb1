/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Requests and the wait for their answers.
 */
#include <string.h>

#include "internal.h"

/* Whether a frame is STATUS as it follows a result, of any node: *number. */
static bool is_status(const client_t *c, const frame_t *frame, unsigned *number) {
  *number = (frame->id & 0x3FFu) >> (10u - c->name_bits);
  const unsigned id = vr_id(c, *number, vr_port(c, PORT_STATUS)) | STATEMENT;
  return !frame->remote && frame->dlc == 8 && frame->id == id;
}

void vr_note_refusals(client_t *c, unsigned number, uint8_t count) {
  c->refusals_known |= UINT32_C(1) << number;
  c->refusals[number] = count;
}

void vr_pass_on(client_t *c, const frame_t *frame) {
  if (!frame->remote && frame->dlc == 0 && frame->id == (SYSTEM_SELECT | STATEMENT)) {
    c->here = true;
    return;
  }
  unsigned number;
  if (is_status(c, frame, &number)) vr_note_refusals(c, number, frame->data[6]);
  if (c->on_statement != NULL) c->on_statement(c->user, frame);
}

result_t vr_receive(client_t *c, wait_t *wait, frame_t *frame) {
  const uint32_t passed = c->port.now_us(c->port.context) - wait->start;
  const bool over = passed >= wait->limit_us;
  if (over && wait->begun) return VERICAN_REMOTE_TIMEOUT;
  wait->begun = true;
  return c->port.receive(c->port.context, frame, over || wait->look ? 0u : wait->limit_us - passed);
}

result_t vr_flush(client_t *c) {
  frame_t frame;
  wait_t look = vr_look(c, c->timeout_us); /* what comes later is looked at anyhow */
  result_t result = vr_receive(c, &look, &frame);
  for (; result == VERICAN_REMOTE_OK; result = vr_receive(c, &look, &frame)) vr_pass_on(c, &frame);
  return result == VERICAN_REMOTE_BUS_OFF ? result : VERICAN_REMOTE_OK;
}

result_t vr_send(client_t *c, const frame_t *frame) { return c->port.send(c->port.context, frame); }

unsigned vr_read_request(const client_t *c, unsigned number, unsigned address, unsigned length,
                         frame_t *request, answer_t *answer) {
  const unsigned window = vr_window(c);
  const unsigned node = number == VERICAN_REMOTE_ALL ? 0u : number;
  memset(request, 0, sizeof *request);
  if (!c->data_frames && address < window) {
    const unsigned room = window - address < 8u ? window - address : 8u;
    length = length < room ? length : room;
    *request = (frame_t){.id = vr_id(c, number, address), .remote = true, .dlc = (uint8_t)length};
    *answer = (answer_t){.id = (uint16_t)(vr_id(c, node, address) | STATEMENT),
                         .dlc = (uint8_t)length,
                         .bytes = (uint8_t)length};
    return length;
  }
  length = length < READ_MOST ? length : READ_MOST;
  request->id = vr_id(c, number, vr_port(c, PORT_READ));
  request->dlc = 3;
  request->data[0] = (uint8_t)address;
  request->data[1] = (uint8_t)(address >> 8);
  request->data[2] = (uint8_t)length;
  *answer = (answer_t){.id = (uint16_t)(vr_id(c, node, vr_port(c, PORT_READ)) | STATEMENT),
                       .dlc = (uint8_t)(length + 2u),
                       .head = 2,
                       .bytes = (uint8_t)length};
  return length;
}

bool vr_answers(const answer_t *answer, const frame_t *request, const frame_t *frame) {
  return !frame->remote && frame->id == answer->id && frame->dlc == answer->dlc &&
         memcmp(frame->data, request->data, answer->head) == 0;
}

bool vr_refuses(const client_t *c, unsigned number, const frame_t *request, const frame_t *frame,
                bool *certain) {
  const unsigned a = request->id & ((1u << (10u - c->name_bits)) - 1u);
  unsigned from;
  if (!is_status(c, frame, &from) || from != number || frame->data[4] != a) return false;
  /* A heartbeat repeats the last code for ever; only the count tells what is new. */
  const bool known = (c->refusals_known >> number & 1u) != 0;
  *certain = known && c->refusals[number] != frame->data[6];
  const bool refusal = frame->data[3] != 0 && frame->data[3] != VERICAN_REMOTE_CODE_OPEN;
  return refusal && (*certain || !known);
}

result_t vr_ask(client_t *c, unsigned number, const frame_t *request, const answer_t *answer,
                frame_t *frame) {
  uint8_t suspected = 0;
  result_t result = vr_flush(c);
  if (result == VERICAN_REMOTE_OK) result = vr_send(c, request);
  wait_t wait = vr_wait(c, c->timeout_us);
  while (result == VERICAN_REMOTE_OK) {
    bool certain = false;
    result = vr_receive(c, &wait, frame);
    if (result != VERICAN_REMOTE_OK) break;
    if (vr_answers(answer, request, frame)) return VERICAN_REMOTE_OK;
    if (vr_refuses(c, number, request, frame, &certain)) suspected = frame->data[3];
    vr_pass_on(c, frame);
    if (certain && suspected != 0) break;
  }
  if (suspected == 0 || result == VERICAN_REMOTE_BUS_OFF) return result;
  c->code = suspected;
  return VERICAN_REMOTE_REFUSED;
}

result_t vr_ask_again(client_t *c, unsigned number, const frame_t *request, const answer_t *answer,
                      frame_t *frame) {
  result_t result = VERICAN_REMOTE_TIMEOUT;
  for (unsigned i = 0; i < vr_tries(c); i++) {
    result = vr_ask(c, number, request, answer, frame);
    const bool busy = result == VERICAN_REMOTE_REFUSED && c->code == VERICAN_REMOTE_CODE_BUSY;
    if (result != VERICAN_REMOTE_TIMEOUT && !busy) break;
  }
  return result;
}

void vr_take_status(const uint8_t row[8], verican_remote_status_t *status) {
  *status = (verican_remote_status_t){.state = row[0] & 3u,
                                      .unlocked = (row[0] & 0x04u) != 0,
                                      .error_passive = (row[0] & 0x08u) != 0,
                                      .duplicate = (row[0] & 0x10u) != 0,
                                      .stale = (row[0] & 0x20u) != 0,
                                      .watchdog = (row[0] & 0x40u) != 0,
                                      .bus_off = (row[0] & 0x80u) != 0,
                                      .tec = row[1],
                                      .rec = row[2],
                                      .code = row[3],
                                      .a = row[4],
                                      .accepted = row[5],
                                      .refused = row[6],
                                      .trigger = row[7]};
}

void vr_take_identity(unsigned number, const uint8_t row[8], verican_remote_identity_t *identity) {
  *identity = (verican_remote_identity_t){.number = (uint8_t)number,
                                          .version = row[0],
                                          .features = row[1],
                                          .name_bits = (uint8_t)(row[2] >> 4),
                                          .memory = (uint16_t)(1u << (row[2] & 0x0Fu)),
                                          .stage = row[3],
                                          .serial = vr_serial(row + 4)};
}

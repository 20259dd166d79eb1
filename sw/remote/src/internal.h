/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the files of the client share: identifiers, requests and the wait for their answers.
 */
#ifndef VERICAN_REMOTE_INTERNAL_H
#define VERICAN_REMOTE_INTERNAL_H

#include "../verican_remote.h"

typedef verican_remote_t client_t;
typedef verican_remote_frame_t frame_t;
typedef verican_remote_result_t result_t;

/* Ports, counted from the first (RN-04). */
enum { PORT_READ, PORT_WRITE, PORT_BLOCK, PORT_DATA, PORT_SETUP, PORT_STATUS = 6, PORT_IDENT };

/* Names 0 and its functions (section 3.3). */
enum { NAME_SYSTEM = 0 };
enum { SYSTEM_STATE, SYSTEM_TRIGGER, SYSTEM_SELECT, SYSTEM_ASSIGN, SYSTEM_SELECT_NEW };

enum { ROW_STATUS = 0xFF0, ROW_IDENT = 0xFF8, MEMORY_END = 0x1000, READ_MOST = 6 };

/* The first A that is a port. */
static inline unsigned vr_window(const client_t *c) { return (1u << (10u - c->name_bits)) - 8u; }
static inline unsigned vr_port(const client_t *c, unsigned port) { return vr_window(c) + port; }
/* Identifier {dir 0, name, A}; statements have bit 10 set. */
static inline uint16_t vr_id(const client_t *c, unsigned name, unsigned a) {
  return (uint16_t)(name << (10u - c->name_bits) | a);
}
enum { STATEMENT = 0x400 };

/* How often what may be repeated is sent at most. */
static inline unsigned vr_tries(const client_t *c) { return c->tries != 0 ? c->tries : 1u; }

static inline bool vr_is_node(const client_t *c, unsigned number) {
  return number >= 2u && number < (1u << c->name_bits);
}

/* Whether `length` bytes from `address` may be named at all. */
bool vr_range_is_good(const void *data, size_t address, size_t length);

/* What answers a request: a data frame with this identifier, DLC and first bytes. */
typedef struct answer {
  uint16_t id;
  uint8_t dlc;
  uint8_t head;  /* bytes that are those of the request */
  uint8_t bytes; /* of `dlc`, behind the head */
} answer_t;

/* A wait for frames. It ends on a bus on which one always waits, too. */
typedef struct wait {
  uint32_t start, limit_us;
  bool look;  /* takes only what has come already */
  bool begun; /* the first frame is taken however late the client comes to look for it */
} wait_t;

/* A wait from now on; what has come already, for `limit_us` at most. */
static inline wait_t vr_wait(const client_t *c, uint32_t limit_us) {
  return (wait_t){.start = c->port.now_us(c->port.context), .limit_us = limit_us};
}
static inline wait_t vr_look(const client_t *c, uint32_t limit_us) {
  return (wait_t){.start = c->port.now_us(c->port.context), .limit_us = limit_us, .look = true};
}

/* Passes what has come before to on_statement: it answers nothing that is asked from now on. */
result_t vr_flush(client_t *c);
/* Sends a frame. */
result_t vr_send(client_t *c, const frame_t *frame);
/* The next frame of a wait; TIMEOUT. */
result_t vr_receive(client_t *c, wait_t *wait, frame_t *frame);
/* Nobody waits for this frame; what it tells of refusals is kept, and that it is HERE. */
void vr_pass_on(client_t *c, const frame_t *frame);

/* A request for `length` bytes from `address`, at most as many as one frame brings; the answer of
 * node `number` (of any, if that is ALL, then with the identifier of node 0). Returns how many. */
unsigned vr_read_request(const client_t *c, unsigned number, unsigned address, unsigned length,
                         frame_t *request, answer_t *answer);
/* Whether `frame` is that answer, to this request. */
bool vr_answers(const answer_t *answer, const frame_t *request, const frame_t *frame);
/* A STATUS frame of node `number` tells that this request has been refused, in byte 3 why.
 * `certain`: it is not an older refusal that is told once more. */
bool vr_refuses(const client_t *c, unsigned number, const frame_t *request, const frame_t *frame,
                bool *certain);
/* The node has refused so many requests until now. */
void vr_note_refusals(client_t *c, unsigned number, uint8_t count);
/* Sends `request` to node `number` and waits for the answer; TIMEOUT, REFUSED with code. */
result_t vr_ask(client_t *c, unsigned number, const frame_t *request, const answer_t *answer,
                frame_t *frame);
/* The same, several times if there is no answer or the node is busy. */
result_t vr_ask_again(client_t *c, unsigned number, const frame_t *request, const answer_t *answer,
                      frame_t *frame);

/* As verican_remote_select(). `witness`: a node that answers, so that nothing depends on how long
 * HERE takes; 0: nobody is known, and select_us must do. */
result_t vr_select(client_t *c, uint32_t value, uint32_t mask, bool only_new, unsigned witness,
                   bool *here);

/* Fields of the rows. */
static inline uint32_t vr_serial(const uint8_t bytes[4]) {
  return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}
void vr_take_status(const uint8_t row[8], verican_remote_status_t *status);
void vr_take_identity(unsigned number, const uint8_t row[8], verican_remote_identity_t *identity);

#endif

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Block transfers.
 */
#include <string.h>

#include "internal.h"

enum { OP_ABORT, OP_READ, OP_WRITE };
/* `LOOK_US`: for an early end, behind each frame that is sent. A node that ends a write is heard at
 * the next look, or at the end. */
enum { IN_A_FRAME = 7, LOOK_US = 1000 };

/* A transfer under way. */
typedef struct transfer {
  client_t *c;
  unsigned number;
  unsigned op;
  uint8_t *to;         /* of a read */
  const uint8_t *from; /* of a write */
  size_t moved;        /* bytes, in the tries before */
  unsigned done;       /* bytes since BLOCK */
  frame_t request;     /* BLOCK */
} transfer_t;

/* The end of a transfer, or of a wait for one. */
typedef enum event { EVENT_DATA, EVENT_ANSWER, EVENT_FAILED } event_t;

static result_t send_block(transfer_t *t, unsigned address, size_t length) {
  client_t *c = t->c;
  const bool gap = t->op == OP_READ && c->gap_ms != 0;
  c->tag++;
  t->done = 0;
  t->request = (frame_t){.id = vr_id(c, t->number, vr_port(c, PORT_BLOCK)),
                         .dlc = gap ? 7 : 6,
                         .data = {(uint8_t)t->op, c->tag, (uint8_t)address, (uint8_t)(address >> 8),
                                  (uint8_t)length, (uint8_t)(length >> 8), gap ? c->gap_ms : 0}};
  const result_t result = vr_flush(c);
  return result == VERICAN_REMOTE_OK ? vr_send(c, &t->request) : result;
}

static void abort_block(transfer_t *t) {
  t->request.data[0] = OP_ABORT;
  t->request.dlc = 6;
  (void)vr_send(t->c, &t->request);
}

static bool is_answer_of_block(const transfer_t *t, const frame_t *frame) {
  const unsigned block = vr_id(t->c, t->number, vr_port(t->c, PORT_BLOCK)) | STATEMENT;
  return !frame->remote && frame->id == block && frame->dlc == 6;
}

/* Ends a transfer that a host has left open. The answer has the tag of that one, which may be that
 * of the next try: it is waited for, and that tag is not given again. */
static void abort_other(transfer_t *t) {
  client_t *c = t->c;
  wait_t wait = vr_wait(c, c->timeout_us);
  frame_t frame;
  abort_block(t);
  while (vr_receive(c, &wait, &frame) == VERICAN_REMOTE_OK) {
    if (is_answer_of_block(t, &frame) && frame.data[2] == VERICAN_REMOTE_CODE_ABORTED) {
      c->tag = frame.data[1];
      return;
    }
    vr_pass_on(c, &frame);
  }
}

/* Waits for the next frame of the transfer. EVENT_FAILED: *result says why. */
static event_t next_event(transfer_t *t, wait_t *wait, frame_t *frame, result_t *result) {
  client_t *c = t->c;
  const unsigned data = vr_id(c, t->number, vr_port(c, PORT_DATA)) | STATEMENT;
  uint8_t suspected = 0;
  bool certain = false;
  while (!certain) {
    *result = vr_receive(c, wait, frame);
    if (*result != VERICAN_REMOTE_OK) break;
    if (!frame->remote && frame->id == data && frame->dlc >= 2 && t->op == OP_READ)
      return EVENT_DATA;
    if (is_answer_of_block(t, frame) && frame->data[0] == t->op && frame->data[1] == c->tag)
      return EVENT_ANSWER;
    if (vr_refuses(c, t->number, &t->request, frame, &certain)) suspected = frame->data[3];
    /* Busy may be said of a BLOCK that came twice: then the transfer goes on nevertheless. */
    certain = certain && suspected != 0 && suspected != VERICAN_REMOTE_CODE_BUSY;
    vr_pass_on(c, frame);
  }
  if (suspected != 0 && *result != VERICAN_REMOTE_BUS_OFF) {
    c->code = suspected;
    *result = VERICAN_REMOTE_REFUSED;
  }
  return EVENT_FAILED;
}

/* What the answer of BLOCK that ends a transfer of `length` bytes says: OK only if all of them have
 * been moved. */
static result_t result_of(transfer_t *t, const frame_t *answer, size_t length) {
  const uint8_t code = answer->data[2];
  t->c->code = code;
  switch (code) {
    case 0: return t->done == length ? VERICAN_REMOTE_OK : VERICAN_REMOTE_SEQUENCE;
    case VERICAN_REMOTE_CODE_SEQUENCE: return VERICAN_REMOTE_SEQUENCE;
    case VERICAN_REMOTE_CODE_TIMEOUT: return VERICAN_REMOTE_TIMEOUT;
    default: return VERICAN_REMOTE_REFUSED;
  }
}

/* One block read; what is in order is kept, t->done bytes. */
static result_t read_once(transfer_t *t, unsigned address, size_t length) {
  uint8_t seq = 0;
  bool lost = false;
  frame_t frame;
  result_t result = send_block(t, address, length);
  const uint32_t limit = t->c->timeout_us + 1000u * t->c->gap_ms;
  wait_t wait = vr_wait(t->c, limit);
  /* Each frame of the transfer begins the wait anew. They may come twice (VA-03); a node that sends
   * more does not hold the client up. */
  size_t renewals = 2u * (length / IN_A_FRAME + 1u);
  while (result == VERICAN_REMOTE_OK) {
    switch (next_event(t, &wait, &frame, &result)) {
      case EVENT_FAILED:
        if (result == VERICAN_REMOTE_TIMEOUT) abort_block(t);
        return result;
      case EVENT_ANSWER: return result_of(t, &frame, length);
      case EVENT_DATA: break;
    }
    if (renewals != 0) {
      renewals--;
      wait = vr_wait(t->c, limit);
    }
    const unsigned n = frame.dlc - 1u;
    if (!lost && frame.data[0] == (uint8_t)(seq - 1u) && t->done != 0) continue; /* once more */
    lost = lost || frame.data[0] != seq || n > length - t->done;
    if (lost) continue; /* the rest of it goes by */
    memcpy(t->to + t->moved + t->done, frame.data + 1, n);
    t->done += n;
    seq++;
  }
  return result;
}

/* Waits as next_event() for the answer that ends a block write. The one that has opened it may come
 * once more (VA-03). */
static event_t next_end(transfer_t *t, wait_t *wait, frame_t *frame, result_t *result) {
  event_t event = EVENT_FAILED;
  do {
    event = next_event(t, wait, frame, result);
  } while (event == EVENT_ANSWER && frame->data[2] == VERICAN_REMOTE_CODE_OPEN);
  return event;
}

/* Sends the bytes of a block write that has been opened; stops if the node closes it. */
static event_t send_data(transfer_t *t, const uint8_t *data, size_t length, frame_t *frame,
                         result_t *result) {
  uint8_t seq = 0;
  for (size_t at = 0; at < length; at += IN_A_FRAME) {
    const size_t n = length - at < IN_A_FRAME ? length - at : IN_A_FRAME;
    frame_t part = {.id = vr_id(t->c, t->number, vr_port(t->c, PORT_DATA)),
                    .dlc = (uint8_t)(n + 1),
                    .data = {seq++}};
    memcpy(part.data + 1, data + at, n);
    *result = vr_send(t->c, &part);
    if (*result != VERICAN_REMOTE_OK) return EVENT_FAILED;
    wait_t look = vr_look(t->c, LOOK_US);
    const event_t event = next_end(t, &look, frame, result);
    if (event == EVENT_ANSWER || *result != VERICAN_REMOTE_TIMEOUT) return event;
  }
  wait_t wait = vr_wait(t->c, t->c->timeout_us);
  return next_end(t, &wait, frame, result);
}

/* One block write; the node has t->done bytes then, if it says so. */
static result_t write_once(transfer_t *t, unsigned address, size_t length) {
  frame_t frame;
  result_t result = send_block(t, address, length);
  if (result != VERICAN_REMOTE_OK) return result;
  wait_t wait = vr_wait(t->c, t->c->timeout_us);
  if (next_event(t, &wait, &frame, &result) == EVENT_FAILED) {
    if (result == VERICAN_REMOTE_TIMEOUT) abort_block(t);
    return result;
  }
  if (frame.data[2] != VERICAN_REMOTE_CODE_OPEN) return result_of(t, &frame, length);
  if (send_data(t, t->from + t->moved, length, &frame, &result) == EVENT_FAILED) {
    if (result == VERICAN_REMOTE_TIMEOUT) abort_block(t);
    return result;
  }
  t->done = frame.data[4] | (unsigned)frame.data[5] << 8;
  if (t->done > length) t->done = (unsigned)length;
  return result_of(t, &frame, length);
}

/* Whether a transfer that ended so is worth another try from where it ended. */
static bool again(transfer_t *t, result_t result) {
  if (result == VERICAN_REMOTE_REFUSED && t->c->code == VERICAN_REMOTE_CODE_BUSY) {
    abort_other(t);
    return true;
  }
  return result == VERICAN_REMOTE_SEQUENCE || result == VERICAN_REMOTE_TIMEOUT;
}

/* Tries until all has been moved: `once` goes on where the try before has ended. */
static result_t transfer(transfer_t *t, result_t (*once)(transfer_t *, unsigned, size_t),
                         unsigned address, size_t length) {
  result_t result = VERICAN_REMOTE_TIMEOUT;
  size_t at = 0;
  for (unsigned tries = vr_tries(t->c); tries != 0; tries--) {
    result = once(t, address + (unsigned)at, length - at);
    at += t->done;
    t->moved = at;
    if (at == length) return VERICAN_REMOTE_OK; /* though the answer to it may have been lost */
    if (!again(t, result)) break;
  }
  return result;
}

result_t verican_remote_block_read(client_t *c, uint8_t number, uint16_t address, uint8_t *data,
                                   size_t length) {
  if (c == NULL || !vr_is_node(c, number) || !vr_range_is_good(data, address, length))
    return VERICAN_REMOTE_ARGUMENT;
  transfer_t t = {.c = c, .number = number, .op = OP_READ, .to = data};
  return transfer(&t, read_once, address, length);
}

result_t verican_remote_block_write(client_t *c, uint8_t number, uint16_t address,
                                    const uint8_t *data, size_t length) {
  if (c == NULL || !vr_is_node(c, number) || !vr_range_is_good(data, address, length))
    return VERICAN_REMOTE_ARGUMENT;
  transfer_t t = {.c = c, .number = number, .op = OP_WRITE, .from = data};
  return transfer(&t, write_once, address, length);
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Who is there. Nodes that share a number answer at once, under one identifier: equal answers are
 * one frame, different ones destroy each other (RN-15). So a poll of bytes that are the same in all
 * nodes tells which numbers there are, one of serial numbers tells those of nodes that are alone
 * under their number, and SELECT, to which equal frames answer, finds whoever is left.
 */
#include "internal.h"

/* The list as it grows. */
typedef struct scan {
  client_t *client;
  verican_remote_identity_t *nodes;
  size_t places, count;
  uint32_t numbers; /* bit n: somebody has number n */
  uint32_t silent;  /* of these, those whose serial number has not come */
  unsigned witness; /* for vr_select() */
} scan_t;

static void add(scan_t *s, unsigned number, uint32_t serial) {
  if (s->count < s->places)
    s->nodes[s->count++] = (verican_remote_identity_t){.number = (uint8_t)number, .serial = serial};
}

static unsigned lowest(uint32_t numbers) {
  unsigned number = 0;
  while (numbers != 0 && (numbers >> number & 1u) == 0) number++;
  return number;
}

/* Which numbers there are, and the serial numbers that answer. */
static result_t scan_numbers(scan_t *s) {
  verican_remote_answers_t version, serial;
  result_t result = verican_remote_poll(s->client, ROW_IDENT, 1, 0, &version);
  if (result != VERICAN_REMOTE_OK || version.answered == 0) return result;
  s->numbers = version.answered;
  result = verican_remote_poll(s->client, ROW_IDENT + 4, 4, s->numbers, &serial);
  if (result != VERICAN_REMOTE_OK && result != VERICAN_REMOTE_TIMEOUT) return result;
  for (unsigned number = 0; number < VERICAN_REMOTE_NUMBERS; number++)
    if ((serial.answered >> number & 1u) != 0) add(s, number, vr_serial(serial.data[number]));
  s->silent = s->numbers & ~serial.answered;
  s->witness = lowest(serial.answered != 0 ? serial.answered : s->numbers);
  return VERICAN_REMOTE_OK;
}

/* Whether a node of the list, from `from` on, has these bits in its serial number. */
static bool is_known(const scan_t *s, size_t from, uint32_t value, uint32_t mask) {
  for (size_t i = from; i < s->count; i++)
    if (((s->nodes[i].serial ^ value) & mask) == 0) return true;
  return false;
}

/* A walk over serial numbers: `only_new`: of nodes without a number. Of nodes of the list from
 * `from` on it is known that they are there. */
typedef struct walk {
  bool only_new;
  size_t from;
} walk_t;

static result_t is_there(const scan_t *s, const walk_t *walk, uint32_t value, uint32_t mask,
                         bool *here) {
  *here = is_known(s, walk->from, value, mask);
  if (*here) return VERICAN_REMOTE_OK;
  return vr_select(s->client, value, mask, walk->only_new, s->witness, here);
}

/* The smallest serial number from `*serial` on that a node has, `*found`. Walks down a tree of
 * prefixes, most significant bit first: 33 SELECTs for a number (RN-26). */
static result_t next_serial(const scan_t *s, const walk_t *walk, uint32_t *serial, bool *found) {
  uint32_t value = *serial;
  unsigned bit = 31; /* the last one of the prefix that is tried */
  for (;;) {
    const result_t result = is_there(s, walk, value, ~UINT32_C(0) << bit, found);
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

/* Adds the nodes of a walk that are not known yet, with this number. */
static result_t add_walk(scan_t *s, const walk_t *walk, unsigned number) {
  uint32_t serial = 0;
  bool more = true;
  while (more && s->count < s->places) {
    bool found = false;
    const result_t result = next_serial(s, walk, &serial, &found);
    if (result != VERICAN_REMOTE_OK || !found) return result;
    if (!is_known(s, walk->from, serial, ~UINT32_C(0))) add(s, number, serial);
    more = ++serial != 0;
  }
  return VERICAN_REMOTE_OK;
}

/* The number of the nodes that share one: that whose serial number does not come, or differs. */
static result_t shared_number(scan_t *s, unsigned *number) {
  uint32_t shared = s->silent;
  if (shared == 0) {
    verican_remote_answers_t serial;
    const result_t result = verican_remote_poll(s->client, ROW_IDENT + 4, 4, 0, &serial);
    if (result != VERICAN_REMOTE_OK) return result;
    shared = (s->numbers & ~serial.answered) | serial.differing;
  }
  const bool one = shared != 0 && (shared & (shared - 1u)) == 0;
  *number = one ? lowest(shared) : VERICAN_REMOTE_UNKNOWN;
  return VERICAN_REMOTE_OK;
}

/* Nodes that have a number, but did not tell their serial number by it. */
static result_t scan_shared(scan_t *s) {
  const walk_t walk = {.only_new = false, .from = 0};
  const size_t first = s->count;
  result_t result = add_walk(s, &walk, VERICAN_REMOTE_UNKNOWN);
  if (result != VERICAN_REMOTE_OK || s->count == first) return result;
  unsigned number = VERICAN_REMOTE_UNKNOWN;
  result = shared_number(s, &number);
  for (size_t i = first; i < s->count; i++) s->nodes[i].number = (uint8_t)number;
  return result;
}

/* Whether another node of the list has the number of this one. */
static bool is_doubled(const scan_t *s, size_t node) {
  for (size_t i = 0; i < s->count; i++)
    if (i != node && s->nodes[i].number == s->nodes[node].number) return true;
  return s->nodes[node].number == VERICAN_REMOTE_UNKNOWN;
}

/* Asks each node that is alone under its number what it is; one that is silent keeps its secret. */
static result_t add_identities(scan_t *s) {
  for (size_t i = 0; i < s->count; i++) {
    verican_remote_identity_t *node = &s->nodes[i], identity;
    if (node->number == 0) continue;
    node->doubled = is_doubled(s, i);
    if (node->doubled) continue;
    const result_t result = verican_remote_identity(s->client, node->number, &identity);
    if (result == VERICAN_REMOTE_BUS_OFF) return result;
    if (result == VERICAN_REMOTE_OK && identity.serial == node->serial) *node = identity;
  }
  return VERICAN_REMOTE_OK;
}

static bool is_before(const verican_remote_identity_t *a, const verican_remote_identity_t *b) {
  const unsigned none = 0x100;
  const unsigned x = a->number == 0 ? none : a->number, y = b->number == 0 ? none : b->number;
  return x != y ? x < y : a->serial < b->serial;
}

static void sort(scan_t *s) {
  for (size_t i = 1; i < s->count; i++)
    for (size_t k = i; k > 0 && is_before(&s->nodes[k], &s->nodes[k - 1]); k--) {
      const verican_remote_identity_t node = s->nodes[k];
      s->nodes[k] = s->nodes[k - 1];
      s->nodes[k - 1] = node;
    }
}

result_t verican_remote_scan(client_t *c, verican_remote_identity_t *nodes, size_t *count) {
  if (c == NULL || nodes == NULL || count == NULL) return VERICAN_REMOTE_ARGUMENT;
  scan_t s = {.client = c, .nodes = nodes, .places = *count};
  result_t result = scan_numbers(&s);
  const walk_t new_nodes = {.only_new = true, .from = s.count};
  if (result == VERICAN_REMOTE_OK) result = add_walk(&s, &new_nodes, 0);
  if (result == VERICAN_REMOTE_OK && s.numbers != 0) result = scan_shared(&s);
  if (result == VERICAN_REMOTE_OK) result = add_identities(&s);
  if (result != VERICAN_REMOTE_OK) return result;
  sort(&s);
  *count = s.count;
  return VERICAN_REMOTE_OK;
}

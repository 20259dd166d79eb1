/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Messages of AUTOSAR CanTSyn: how SYNC and FUP are written, and their CRC (TM-50, TM-52).
 */
#include "tsyn_internal.h"

#define SECOND_NS 1000000000u

verican_result_t verican_tsyn_rules_default(verican_tsyn_rules_t *rules) {
  if (rules == NULL) return VERICAN_ERR_NULL;
  *rules = (verican_tsyn_rules_t){0};
  rules->fup_timeout_us = 100000;
  rules->jump_width = 15;
  return VERICAN_OK;
}

static uint8_t crc_step(uint8_t crc, uint8_t byte) {
  unsigned rest = (unsigned)crc ^ byte;
  for (unsigned n = 0; n < 8u; ++n) rest = (rest & 0x80u) != 0u ? rest << 1 ^ 0x2Fu : rest << 1;
  return (uint8_t)rest;
}

uint8_t verican_tsyn_crc8(const uint8_t *data, const uint8_t *ids) {
  uint8_t crc = 0xFF;
  for (unsigned i = 2; i < 8u; ++i) crc = crc_step(crc, data[i]);
  return crc_step(crc, ids[data[2] & 0xFu]) ^ 0xFFu;
}

/* The bytes that SYNC and FUP share; the last four hold `word`. `ids` or NULL decides of the CRC.
 */
static void write(const verican_tsyn_rules_t *rules, uint8_t type, uint8_t sc, uint32_t word,
                  const uint8_t *ids, uint8_t *data) {
  data[0] = ids != NULL ? (uint8_t)(type + TSYN_WITH_CRC) : type;
  data[2] = (uint8_t)((unsigned)rules->domain << 4 | sc);
  for (unsigned i = 0; i < 4u; ++i) data[4u + i] = (uint8_t)(word >> (24u - 8u * i));
  if (ids != NULL) data[1] = verican_tsyn_crc8(data, ids);
}

void verican_tsyn_write_sync(verican_tsyn_sender_t *sender, const verican_tsyn_rules_t *rules,
                             uint64_t t0, uint8_t data[8]) {
  const uint64_t seconds = t0 / SECOND_NS;
  sender->second = seconds * SECOND_NS;
  data[1] = rules->user[1];
  data[3] = rules->user[0];
  write(rules, TSYN_SYNC, sender->sc, (uint32_t)seconds, rules->sync_ids, data);
  sender->sc = (uint8_t)((sender->sc + 1u) & 0xFu);
}

bool verican_tsyn_write_fup(const verican_tsyn_sender_t *sender, const verican_tsyn_rules_t *rules,
                            uint64_t t1, uint8_t data[8]) {
  const uint64_t t4 = t1 - sender->second;
  if (t4 >= (uint64_t)4 * SECOND_NS) return false;
  const uint32_t overflow = (uint32_t)(t4 / SECOND_NS);
  data[1] = rules->user[2];
  data[3] = (uint8_t)((rules->sub_domain ? TSYN_SGW : 0u) | overflow);
  write(rules, TSYN_FUP, (uint8_t)((sender->sc + 15u) & 0xFu), (uint32_t)(t4 % SECOND_NS),
        rules->fup_ids, data);
  return true;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * SYNC and FUP as a follower takes them (TM-51, TM-53 to TM-55).
 */
#include "tsyn_internal.h"

#define SECOND_NS 1000000000u

static uint32_t word_of(const uint8_t *data) {
  return (uint32_t)data[4] << 24 | (uint32_t)data[5] << 16 | (uint32_t)data[6] << 8 | data[7];
}

/* OFS, OFNS, and the forms of 16 bytes. */
static bool is_other(uint8_t type) {
  static const uint8_t types[] = {0x34, 0x3C, 0x44, 0x4C, 0x54, 0x64};
  for (unsigned i = 0; i < sizeof types; ++i)
    if (type == types[i]) return true;
  return false;
}

/* VERICAN_TSYN_CAUSES: nothing is wrong with the frame by itself. */
static verican_tsyn_cause_t check(const verican_tsyn_rules_t *rules, const uint8_t *data,
                                  uint8_t dlc, bool *fup) {
  if (dlc < 1u) return VERICAN_TSYN_TYPE;
  const uint8_t type = data[0];
  if (is_other(type)) return VERICAN_TSYN_OTHER;
  /* Bits of a type tell what it is: 0x10 SYNC, 0x18 FUP, 0x20 and 0x28 the same with CRC. */
  const bool with_crc = type >= TSYN_SYNC + TSYN_WITH_CRC;
  if (dlc != 8u || type < TSYN_SYNC || type > TSYN_FUP + TSYN_WITH_CRC ||
      (type & ~(TSYN_SYNC | TSYN_FUP | (TSYN_SYNC + TSYN_WITH_CRC))) != 0u)
    return VERICAN_TSYN_TYPE;
  if (rules->crc ==
      (uint8_t)(with_crc ? VERICAN_TSYN_CRC_NOT_VALIDATED : VERICAN_TSYN_CRC_VALIDATED))
    return VERICAN_TSYN_TYPE;
  if (data[2] >> 4 != rules->domain) return VERICAN_TSYN_DOMAIN;
  *fup = (type & (TSYN_SYNC ^ TSYN_FUP)) != 0u;
  if (!with_crc || rules->crc == (uint8_t)VERICAN_TSYN_CRC_IGNORED) return VERICAN_TSYN_CAUSES;
  const uint8_t *ids = *fup ? rules->fup_ids : rules->sync_ids;
  if (ids == NULL || data[1] != verican_tsyn_crc8(data, ids)) return VERICAN_TSYN_CRC;
  return VERICAN_TSYN_CAUSES;
}

bool verican_tsyn_is_sync(const verican_tsyn_rules_t *rules, const uint8_t *data, uint8_t dlc,
                          verican_tsyn_cause_t *cause) {
  bool fup = false;
  *cause = check(rules, data, dlc, &fup);
  return *cause == VERICAN_TSYN_CAUSES && !fup;
}

static void count(verican_tsyn_receiver_t *receiver, verican_tsyn_cause_t cause) {
  if (receiver->refused[cause] < UINT16_MAX) ++receiver->refused[cause];
}

/* The SC of the one whose FUP is due is a repetition: receivers took it, the sender did not see
 * that (VA-03). FUP tells of the last one. */
static bool continues(const verican_tsyn_receiver_t *receiver, const verican_tsyn_rules_t *rules,
                      uint8_t sc, bool silence) {
  const unsigned jump = (sc - (unsigned)receiver->sc) & 0xFu;
  return !receiver->seen || silence || (jump == 0u && receiver->waiting) ||
         (jump > 0u && jump <= rules->jump_width);
}

/* VERICAN_TSYN_CAUSES: it is taken. */
static verican_tsyn_cause_t take_sync(verican_tsyn_receiver_t *receiver,
                                      const verican_tsyn_rules_t *rules, const uint8_t *data,
                                      uint64_t stamp, uint64_t silence_ns) {
  const uint8_t sc = data[2] & 0xFu;
  const uint64_t since = stamp - receiver->stamp;
  if (!continues(receiver, rules, sc, since > silence_ns)) return VERICAN_TSYN_SC;
  if (receiver->waiting && sc != receiver->sc) count(receiver, VERICAN_TSYN_MISSING);
  receiver->second = word_of(data);
  receiver->stamp = stamp;
  receiver->sc = sc;
  receiver->seen = true;
  receiver->waiting = true;
  receiver->user[0] = data[3];
  receiver->user[1] = data[1];
  return VERICAN_TSYN_CAUSES;
}

static verican_tsyn_cause_t take_fup(verican_tsyn_receiver_t *receiver,
                                     const verican_tsyn_rules_t *rules, const uint8_t *data,
                                     uint64_t stamp, verican_sync_pair_t *pair) {
  const uint32_t nanoseconds = word_of(data);
  if (!receiver->waiting) return VERICAN_TSYN_MISSING;
  receiver->waiting = false;
  if ((data[2] & 0xFu) != receiver->sc) return VERICAN_TSYN_SC;
  if (stamp - receiver->stamp > (uint64_t)rules->fup_timeout_us * 1000u) return VERICAN_TSYN_LATE;
  if (nanoseconds >= SECOND_NS) return VERICAN_TSYN_TYPE;
  receiver->sub_domain = (data[3] & TSYN_SGW) != 0u;
  receiver->user[2] = data[1];
  pair->local = receiver->stamp;
  pair->master = (receiver->second + (data[3] & TSYN_OVS)) * SECOND_NS + nanoseconds;
  return VERICAN_TSYN_CAUSES;
}

verican_tsyn_heard_t verican_tsyn_receive(verican_tsyn_receiver_t *receiver,
                                          const verican_tsyn_rules_t *rules, const uint8_t *data,
                                          uint8_t dlc, uint64_t stamp, uint64_t silence_ns,
                                          verican_sync_pair_t *pair) {
  bool fup = false;
  verican_tsyn_cause_t cause = check(rules, data, dlc, &fup);
  if (cause == VERICAN_TSYN_CAUSES) {
    cause = fup ? take_fup(receiver, rules, data, stamp, pair)
                : take_sync(receiver, rules, data, stamp, silence_ns);
  } else if (fup && cause == VERICAN_TSYN_CRC) {
    receiver->waiting = false;
  }
  if (cause == VERICAN_TSYN_CAUSES) return fup ? VERICAN_TSYN_PAIR : VERICAN_TSYN_SYNC;
  count(receiver, cause);
  return VERICAN_TSYN_NOTHING;
}

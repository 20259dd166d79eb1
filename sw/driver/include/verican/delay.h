/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The delay from a master's stamp point to a follower's, measured by the way back, and IEEE 1588
 * over CAN as it was published (P4); without hardware. Rules: docs/time-spec.md, TM-57 and TM-58.
 */
#ifndef VERICAN_DELAY_H
#define VERICAN_DELAY_H

#include "verican/servo.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Measurement of the delay by requests and responses. Zero is its beginning. */
typedef struct verican_delay {
  int64_t sum;     /* of twice the delays, ns */
  int64_t forth;   /* from the master to here by both clocks: delay and offset */
  uint64_t master; /* the master's time of the pair */
  uint64_t sent;   /* own time of the request, 0: none is under way */
  uint8_t wanted;
  uint8_t count;
  bool paired; /* there is a pair, and no exchange with it yet */
} verican_delay_t;

/** Asks for `exchanges` exchanges, 1.. (8 are usual). VERICAN_ERR_RANGE. */
verican_result_t verican_delay_start(verican_delay_t *delay, uint8_t exchanges);

/**
 * A pair, corrected by `shift`. True: now the request is to be sent. False also if the last one,
 * not answered yet, went behind this pair's SYNC: its response could not be told from the next.
 */
bool verican_delay_pair(verican_delay_t *delay, const verican_sync_pair_t *pair, int64_t shift);

/** The request was sent at the own time `stamp`. */
void verican_delay_sent(verican_delay_t *delay, uint64_t stamp);

/**
 * The response tells when the master had it; one of before the pair's SYNC, late, is of an older
 * request and is passed over. True: all exchanges are done, `delay_ns` is the mean.
 */
bool verican_delay_response(verican_delay_t *delay, uint64_t master, int32_t *delay_ns);

/** Metres of cable at 5 ns each, and the transceivers' delay. */
static inline int32_t verican_delay_of_cable(uint16_t metres, uint16_t transceivers_ns) {
  return 5 * (int32_t)metres + (int32_t)transceivers_ns;
}

/* ---- IEEE 1588 over CAN, as published (P4) --------------------------------------------------- */

/** Identifiers of its messages. */
enum {
  VERICAN_P4_SYNC = 0x001,
  VERICAN_P4_FOLLOW_UP = 0x002,
  VERICAN_P4_DELAY_REQ = 0x003,
  VERICAN_P4_DELAY_RESP = 0x004,
  VERICAN_P4_DELAY_OFFSET = 0x005
};

/** A time, 64 bits of ns, as FollowUp and DelayResp carry it. */
void verican_p4_write_time(uint64_t time, uint8_t data[8]);
uint64_t verican_p4_read_time(const uint8_t data[8]);

/** A follower. `number` is to be set, 1..; the rest begins with zero. */
typedef struct verican_p4 {
  verican_delay_t measure;
  verican_sync_pair_t pair;
  uint64_t due;   /* own time of the next message */
  int64_t offset; /* TS1 - TM1 - delay */
  int32_t delay;
  uint8_t number;
  uint8_t next; /* identifier of the next message, 0: none */
} verican_p4_t;

/** Sync was received at the own time `stamp`, TS1. */
void verican_p4_on_sync(verican_p4_t *p4, uint64_t stamp);

/** FollowUp was read at the own time `now`: the offset by which the own clock is ahead. */
int64_t verican_p4_on_follow_up(verican_p4_t *p4, const uint8_t data[8], uint64_t now);

/** The own clock was shifted for it. */
void verican_p4_shifted(verican_p4_t *p4, int64_t shift);

/** The message that is due: its identifier, or 0, and eight bytes of data (DelayReq has none). */
uint32_t verican_p4_poll(verican_p4_t *p4, uint64_t now, uint8_t data[8]);

/** DelayReq was sent at the own time `stamp`, TS2. */
void verican_p4_on_sent(verican_p4_t *p4, uint64_t stamp);

/** DelayResp was read at the own time `now`. True: it answers the own request, and tells the delay.
 */
bool verican_p4_on_response(verican_p4_t *p4, const uint8_t data[8], uint64_t now);

#ifdef __cplusplus
}
#endif

#endif /* VERICAN_DELAY_H */

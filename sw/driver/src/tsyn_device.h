/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the parts of a time domain on a core share.
 */
#ifndef VERICAN_SRC_TSYN_DEVICE_H
#define VERICAN_SRC_TSYN_DEVICE_H

#include "internal.h"
#include "verican/timesync.h"

/* verican_tsyn_t.step */
enum { TSYN_IDLE = 0, TSYN_SYNC_OUT = 1, TSYN_SYNC_SENT = 2, TSYN_PROBING = 3 };

/* tsyn_check.c */
verican_result_t verican_tsyn_check(const verican_tsyn_t *tsyn);

/* tsyn.c */
/* Follows a clock that somebody has set back by more than R: what was to come, and what was heard
 * and accepted, would else lie that far ahead. `now`: the time, or a stamp. */
void verican_tsyn_look(verican_tsyn_t *tsyn, uint64_t now);

/* tsyn_master.c */
/* Sends what is due. */
void verican_tsyn_run_master(verican_tsyn_t *tsyn, uint64_t now);
/* Stops being master: a better one is there, or nobody hears this one. */
void verican_tsyn_yield(verican_tsyn_t *tsyn, uint64_t now);
/* Sends eight bytes, or none if `data` is NULL, under an identifier with VERICAN_TSYN_EXTENDED. */
verican_result_t verican_tsyn_send(verican_tsyn_t *tsyn, uint32_t id, const uint8_t *data,
                                   uint8_t *mailbox);

#endif /* VERICAN_SRC_TSYN_DEVICE_H */

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The 17 periodic messages of the SAE class-C benchmark, as Tindell and Burns (1994) put them on
 * CAN.
 */
#ifndef FIRMWARE_SAE_TABLE_H
#define FIRMWARE_SAE_TABLE_H

#include <stdint.h>

#define SAE_MESSAGES 17u

/** A message that is due every period; the smallest identifier is the most urgent. */
typedef struct sae_message {
  uint32_t id;
  uint8_t bytes;
  uint16_t period_ms;
} sae_message_t;

extern const sae_message_t sae_table[SAE_MESSAGES];

#endif /* FIRMWARE_SAE_TABLE_H */

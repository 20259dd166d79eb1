/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Storage in memory that survives a reset: see co_storage.h.
 */
#include "co_storage.h"

#include <string.h>

#include "301/crc16-ccitt.h"

#define STORED 0x5643414Eu

/* Head of a group in the memory, its bytes behind it. */
typedef struct {
  uint32_t mark; /* STORED, or anything: nothing is stored */
  uint16_t crc;
  uint16_t length;
} head_t;

static uint8_t *bytes_of(const CO_storage_entry_t *entry) {
  return (uint8_t *)entry->memory + sizeof(head_t);
}

static ODR_t store(CO_storage_entry_t *entry, CO_CANmodule_t *module) {
  head_t *head = entry->memory;
  (void)module;
  head->mark = 0; /* until all is written */
  memcpy(bytes_of(entry), entry->addr, entry->len);
  head->length = (uint16_t)entry->len;
  head->crc = crc16_ccitt(bytes_of(entry), entry->len, 0);
  head->mark = STORED;
  return ODR_OK;
}

/* Defaults come with the next reset. */
static ODR_t restore(CO_storage_entry_t *entry, CO_CANmodule_t *module) {
  (void)module;
  ((head_t *)entry->memory)->mark = 0;
  return ODR_OK;
}

/* False: damaged. */
static bool load(const CO_storage_entry_t *entry) {
  const head_t *head = entry->memory;
  if (head->mark != STORED) return true;
  if (head->length != entry->len || head->crc != crc16_ccitt(bytes_of(entry), entry->len, 0))
    return false;
  memcpy(entry->addr, bytes_of(entry), entry->len);
  return true;
}

CO_ReturnError_t co_storage_open(CO_storage_t *storage, CO_CANmodule_t *module,
                                 OD_entry_t *entry_1010, OD_entry_t *entry_1011,
                                 CO_storage_entry_t *entries, uint8_t count, uint8_t *damaged) {
  const CO_ReturnError_t result =
      CO_storage_init(storage, module, entry_1010, entry_1011, store, restore, entries, count);
  if (result != CO_ERROR_NO) return result;
  *damaged = 0;
  for (uint8_t i = 0; i < count; ++i)
    if (!load(&entries[i])) ++*damaged;
  storage->enabled = true;
  return CO_ERROR_NO;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Objects 1010 and 1011 on memory that survives a reset: RAM that the startup code leaves alone, a
 * battery RAM, a mapped FRAM. For flash write store and restore functions of your own.
 */
#ifndef CO_STORAGE_VERICAN_H
#define CO_STORAGE_VERICAN_H

#include "storage/CO_storage.h"

/** Bytes of memory for a group of `length` bytes: mark and CRC are in front of it. It is aligned as
 * a uint32_t is. */
#define CO_STORAGE_MEMORY(length) ((length) + 8u)

/**
 * Copies what was stored into the variables and serves 1010 and 1011 from now on; once, before
 * CO_CANopenInit(). Groups that were never stored, or are damaged, keep their defaults: the number
 * of the damaged ones goes to `damaged`.
 */
CO_ReturnError_t co_storage_open(CO_storage_t *storage, CO_CANmodule_t *module,
                                 OD_entry_t *entry_1010, OD_entry_t *entry_1011,
                                 CO_storage_entry_t *entries, uint8_t count, uint8_t *damaged);

#endif /* CO_STORAGE_VERICAN_H */

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Objects of the drive that are more than memory: domains, a range, a provoked error.
 */
#ifndef OBJECTS_H
#define OBJECTS_H

#include "co_node.h"

/** Bytes of the download area, object 2000, and of the trace, object 2001. */
#define DOWNLOAD_BYTES 4096u
#define TRACE_BYTES 10000u

/** Byte `n` of the trace; a master can compute it as well. */
static inline uint8_t trace_byte(uint32_t n) { return (uint8_t)(n * 7u + (n >> 8)); }

/** Puts the objects into the dictionary; after each communication reset. */
void objects_install(co_node_t *node);

/** Error code written to object 2008 since the last call: reports it, or with 0 takes it back;
 * true: the drive has to fail. */
bool objects_serve(co_node_t *node);

#endif /* OBJECTS_H */

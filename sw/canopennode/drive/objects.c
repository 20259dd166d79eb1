/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Objects of the drive: see objects.h. The functions are those of CANopenNode's OD_extension_t.
 */
#include "objects.h"

#include "OD.h"

/* Of CANopenNode's error status bits: the first that shows in the error register as bit 7. */
#define ERROR_BIT 0x40u

enum { CURRENT_MIN = 100, CURRENT_MAX = 5000 }; /* object 2004, as in drive.eds */

static uint8_t area[DOWNLOAD_BYTES];
static OD_size_t area_length;
static volatile uint16_t error_code;
static volatile bool error_written;
static bool error_reported;

static OD_extension_t download, trace, limit, provoke;

static OD_size_t least(OD_size_t a, OD_size_t b) { return a < b ? a : b; }

/* ---- Object 2000: takes up to DOWNLOAD_BYTES and gives them back ---- */

static ODR_t write_area(OD_stream_t *stream, const void *buffer, OD_size_t count,
                        OD_size_t *written) {
  if (stream == NULL || buffer == NULL || written == NULL) return ODR_DEV_INCOMPAT;
  if (stream->dataOffset == 0u) area_length = 0;
  if (stream->dataLength > sizeof area || stream->dataOffset + count > sizeof area)
    return ODR_OUT_OF_MEM;
  memcpy(&area[stream->dataOffset], buffer, count);
  stream->dataOffset += count;
  area_length = stream->dataOffset;
  *written = count;
  /* Without a length the server says by its own ODR_PARTIAL handling when it is over. */
  return stream->dataLength == 0u || stream->dataOffset < stream->dataLength ? ODR_PARTIAL : ODR_OK;
}

/* What a domain has from the offset of the stream on. */
static ODR_t read_domain(OD_stream_t *stream, void *buffer, OD_size_t count, OD_size_t *read,
                         OD_size_t length, uint8_t (*byte)(uint32_t n)) {
  if (stream == NULL || buffer == NULL || read == NULL) return ODR_DEV_INCOMPAT;
  if (length == 0u) return ODR_NO_DATA;
  if (stream->dataOffset == 0u) stream->dataLength = length;
  const OD_size_t now = least(count, length - stream->dataOffset);
  uint8_t *to = buffer;
  for (OD_size_t i = 0; i < now; ++i) to[i] = byte((uint32_t)(stream->dataOffset + i));
  stream->dataOffset += now;
  *read = now;
  if (stream->dataOffset < length) return ODR_PARTIAL;
  stream->dataOffset = 0;
  return ODR_OK;
}

static uint8_t area_byte(uint32_t n) { return area[n]; }

static ODR_t read_area(OD_stream_t *stream, void *buffer, OD_size_t count, OD_size_t *read) {
  return read_domain(stream, buffer, count, read, area_length, area_byte);
}

static uint8_t byte_of_trace(uint32_t n) { return trace_byte(n); }

static ODR_t read_trace(OD_stream_t *stream, void *buffer, OD_size_t count, OD_size_t *read) {
  return read_domain(stream, buffer, count, read, TRACE_BYTES, byte_of_trace);
}

/* ---- Object 2004: a range ---- */

static ODR_t write_limit(OD_stream_t *stream, const void *buffer, OD_size_t count,
                         OD_size_t *written) {
  if (stream == NULL || buffer == NULL || count != 2u) return ODR_DEV_INCOMPAT;
  const uint16_t value = CO_getUint16(buffer);
  if (value < CURRENT_MIN) return ODR_VALUE_LOW;
  if (value > CURRENT_MAX) return ODR_VALUE_HIGH;
  return OD_writeOriginal(stream, buffer, count, written);
}

/* ---- Object 2008: an error on request ---- */

static ODR_t write_error(OD_stream_t *stream, const void *buffer, OD_size_t count,
                         OD_size_t *written) {
  if (stream == NULL || buffer == NULL || count != 2u) return ODR_DEV_INCOMPAT;
  error_code = CO_getUint16(buffer);
  error_written = true;
  return OD_writeOriginal(stream, buffer, count, written);
}

bool objects_serve(co_node_t *node) {
  if (!error_written) return false;
  error_written = false;
  if (error_reported) CO_errorReset(node->co->em, ERROR_BIT, 0);
  error_reported = error_code != 0u;
  if (error_reported) CO_errorReport(node->co->em, ERROR_BIT, error_code, 0);
  return error_reported;
}

void objects_install(co_node_t *node) {
  if (node->co->nodeIdUnconfigured) return;
  download = (OD_extension_t){.read = read_area, .write = write_area};
  trace = (OD_extension_t){.read = read_trace};
  limit = (OD_extension_t){.read = OD_readOriginal, .write = write_limit};
  provoke = (OD_extension_t){.read = OD_readOriginal, .write = write_error};
  (void)OD_extension_init(OD_find(node->od, 0x2000), &download);
  (void)OD_extension_init(OD_find(node->od, 0x2001), &trace);
  (void)OD_extension_init(OD_find(node->od, 0x2004), &limit);
  (void)OD_extension_init(OD_find(node->od, 0x2008), &provoke);
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Self-test: buffer memory, then frames through loop-back from mailbox 1 to mailbox 0. Everything
 * that is touched is kept on the stack and put back.
 */
#include "internal.h"

enum { RX = 0, TX = 1, WORDS = 8, FRAMES = 18 };

static verican_result_t fail(verican_test_report_t *report, verican_test_step_t step,
                             uint32_t where, uint32_t expected, uint32_t found) {
  const verican_test_report_t seen = {step, where, expected, found};
  *report = seen;
  return VERICAN_ERR_SELF_TEST;
}

/* Each word of the buffers but C/S, which acts: its address and its complement, then the old
 * value. */
static verican_result_t test_memory(const verican_t *dev, verican_test_report_t *report) {
  for (unsigned mb = 0; mb < dev->num_mb; ++mb) {
    for (uint32_t word = VERICAN_MB_ID_OFFSET(mb); word <= VERICAN_MB_DATA1_OFFSET(mb);
         word += 4u) {
      const uint32_t old = verican_read(dev, word);
      for (unsigned round = 0; round < 2u; ++round) {
        const uint32_t pattern = round == 0u ? word * 0x00010001u : ~(word * 0x00010001u);
        verican_write(dev, word, pattern);
        const uint32_t found = verican_read(dev, word);
        if (found != pattern) return fail(report, VERICAN_TEST_MEMORY, word, pattern, found);
      }
      verican_write(dev, word, old);
    }
  }
  return VERICAN_OK;
}

/* Frame n: lengths 0..8, standard and extended; its identifier and data follow from n. */
static void make_frame(unsigned n, verican_frame_t *frame) {
  *frame = (verican_frame_t){0};
  const bool extended = n >= (unsigned)FRAMES / 2u;
  frame->flags = extended ? VERICAN_FRAME_EXTENDED : 0;
  frame->id = extended ? 0x0AAAAAAAu + n * 0x01010101u : 0x2AAu + n * 0x21u;
  frame->dlc = (uint8_t)(n % ((unsigned)FRAMES / 2u));
  for (unsigned i = 0; i < frame->dlc; ++i) frame->data[i] = (uint8_t)(0x55u * (i + 1u) + n);
}

static verican_result_t compare(unsigned n, const verican_frame_t *sent, const verican_frame_t *got,
                                verican_test_report_t *report) {
  if (got->id != sent->id) return fail(report, VERICAN_TEST_FRAME, n, sent->id, got->id);
  if (got->dlc != sent->dlc || got->flags != sent->flags)
    return fail(report, VERICAN_TEST_FRAME, n, sent->dlc, got->dlc);
  for (unsigned i = 0; i < 8u; ++i) {
    if (got->data[i] != sent->data[i])
      return fail(report, VERICAN_TEST_FRAME, n, sent->data[i], got->data[i]);
  }
  return VERICAN_OK;
}

static verican_result_t loop_frame(verican_t *dev, unsigned n, verican_test_report_t *report) {
  verican_frame_t sent;
  verican_frame_t got;
  make_frame(n, &sent);
  const uint32_t ide = (sent.flags & VERICAN_FRAME_EXTENDED) != 0u ? VERICAN_MB_CS_IDE_MASK : 0u;
  const uint32_t both = verican_bit(RX) | verican_bit(TX);
  verican_write(dev, VERICAN_MB_CS_OFFSET(RX), CS_CODE(RX_EMPTY) | ide);
  verican_frame_write(dev, TX, &sent);
  if (verican_wait(dev, VERICAN_IFLAG1_OFFSET, both, both) != VERICAN_OK)
    return fail(report, VERICAN_TEST_LOOP_BACK, n, both,
                verican_read(dev, VERICAN_IFLAG1_OFFSET) & both);
  verican_frame_read(dev, RX, verican_read(dev, VERICAN_MB_CS_OFFSET(RX)), &got);
  verican_write(dev, VERICAN_IFLAG1_OFFSET, both);
  (void)verican_now(dev);
  return compare(n, &sent, &got, report);
}

/* Two mailboxes only, and no FIFO: what the others hold is neither sent nor overwritten, and is
 * plain memory. Where MAXMB is fixed none of the others sends, and mailbox 0 comes first. */
#define TEST_MCR (VERICAN_MCR_BCC_MASK | (uint32_t)TX)
#define TEST_MCR_FROZEN (TEST_MCR | VERICAN_MCR_FRZ_MASK | VERICAN_MCR_HALT_MASK)

/* In bus-off nothing comes back: what holds a node there does not hold here, and its 1,408 bits
 * are as long as eight waits for a frame. */
enum { BUS_OFF_WAITS = 8 };

static void leave_bus_off(const verican_t *dev) {
  const uint32_t off = VERICAN_ESR1_FLT_CONF_SET(2u);
  for (unsigned n = 0; n < (unsigned)BUS_OFF_WAITS; ++n)
    if (verican_wait(dev, VERICAN_ESR1_OFFSET, off, 0) == VERICAN_OK) return;
}

static verican_result_t test_loop_back(verican_t *dev, verican_test_report_t *report) {
  const uint32_t in_the_way = VERICAN_CTRL1_LOM_MASK | VERICAN_CTRL1_BOFF_REC_MASK;
  verican_write(dev, VERICAN_CTRL1_OFFSET, (dev->ctrl & ~in_the_way) | VERICAN_CTRL1_LPB_MASK);
  verican_write(dev, verican_mask_offset(dev, RX), MASK_IDE);
  verican_write(dev, VERICAN_MB_CS_OFFSET(TX), CS_CODE(TX_INACTIVE));
  verican_write(dev, VERICAN_MCR_OFFSET, TEST_MCR);
  verican_result_t result = verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_FRZ_ACK_MASK, 0);
  if (result == VERICAN_OK) leave_bus_off(dev);
  for (unsigned n = 0; result == VERICAN_OK && n < (unsigned)FRAMES; ++n)
    result = loop_frame(dev, n, report);
  verican_write(dev, VERICAN_MCR_OFFSET, TEST_MCR_FROZEN);
  const verican_result_t frozen_again =
      verican_wait(dev, VERICAN_MCR_OFFSET, VERICAN_MCR_FRZ_ACK_MASK, VERICAN_MCR_FRZ_ACK_MASK);
  return result != VERICAN_OK ? result : frozen_again;
}

/* Both mailboxes as they were. A frame in them had been read, or the next one would count as an
 * overrun: a C/S word that is written takes the mark of that back (flexcan.md 3.6). */
static void put_back(verican_t *dev, const uint32_t kept[WORDS]) {
  const uint32_t first = VERICAN_MB_CS_OFFSET(RX);
  for (unsigned i = (unsigned)WORDS; i-- > 0u;) verican_write(dev, first + 4u * i, kept[i]);
  (void)verican_read(dev, VERICAN_MB_CS_OFFSET(RX));
  (void)verican_read(dev, VERICAN_MB_CS_OFFSET(TX));
  (void)verican_now(dev);
}

verican_result_t verican_self_test(verican_t *dev, verican_test_report_t *report) {
  verican_result_t result = verican_check_stopped(dev);
  if (result != VERICAN_OK) return result;
  verican_test_report_t seen = {VERICAN_TEST_PASSED, 0, 0, 0};
  const uint32_t first = VERICAN_MB_CS_OFFSET(RX);
  const uint32_t kept_mask = verican_read(dev, verican_mask_offset(dev, RX));
  uint32_t kept[WORDS];
  verican_write(dev, VERICAN_MCR_OFFSET, TEST_MCR_FROZEN);
  for (unsigned i = 0; i < (unsigned)WORDS; ++i) kept[i] = verican_read(dev, first + 4u * i);
  result = test_memory(dev, &seen);
  if (result == VERICAN_OK) result = test_loop_back(dev, &seen);
  put_back(dev, kept);
  verican_write(dev, verican_mask_offset(dev, RX), kept_mask);
  verican_write(dev, VERICAN_IFLAG1_OFFSET, verican_bit(RX) | verican_bit(TX));
  verican_write_settings(dev);
  if (report != NULL) *report = seen;
  return result;
}

/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * NXP's SDK driver fsl_flexcan, as it is, against a partner (peer.c) on a bus of 500 kbit/s: what
 * it does in polling and by interrupts, with mailboxes and the FIFO, in loop-back, when a frame is
 * taken back, listening only, and through bus-off. Prints a line for each; the exit code is the
 * number that failed.
 */
#include <stdbool.h>
#include <stdint.h>

#include "board.h"
#include "fsl_flexcan.h"
#include "partner.h"
#include "semihost.h"

/* Mailboxes behind those that a FIFO with eight filters takes, and behind the first free one, which
 * the driver keeps for itself for parts with erratum 5829. */
enum { TX_MB = 9, RX_MB = 10, RX_EXT_MB = 11, REMOTE_MB = 12 };
enum { BITRATE = 500000, MAILBOXES = 16, PATIENCE_US = 50000, OFF_AT_US = 100000 };

static flexcan_handle_t handle;
static volatile bool done[MAILBOXES], fifo_done, was_off;
static volatile uint32_t switched;

void CAN0_DriverIRQHandler(void);
void can0_handler(void) { CAN0_DriverIRQHandler(); }
void systick_handler(void) {} /* wakes the program up */

void __assert_func(const char *file, int line, const char *function, const char *text) {
  semihost_printf("%s:%d: %s: %s\n", file, line, function, text);
  semihost_exit(99);
}

static FLEXCAN_CALLBACK(on_event) {
  (void)base;
  (void)handle;
  (void)userData;
  if (status == kStatus_FLEXCAN_TxIdle || status == kStatus_FLEXCAN_RxIdle ||
      status == kStatus_FLEXCAN_RxRemote)
    done[result] = true;
  if (status == kStatus_FLEXCAN_TxSwitchToRx) ++switched;
  if (status == kStatus_FLEXCAN_RxFifoIdle) fifo_done = true;
  if (status == kStatus_FLEXCAN_ErrorStatus)
    was_off = was_off || (result & kFLEXCAN_BusOffIntFlag) != 0u;
}

static bool wait_for(const volatile bool *flag, uint32_t microseconds) {
  const uint32_t begin = semihost_microseconds();
  while (!*flag)
    if (semihost_microseconds() - begin > microseconds) return false;
  return true;
}

static uint8_t byte_of(const flexcan_frame_t *frame, unsigned i) {
  const uint32_t word = i < 4u ? frame->dataWord0 : frame->dataWord1;
  return (uint8_t)(word >> (24u - 8u * (i % 4u)));
}

static flexcan_frame_t frame_of(bool extended, uint32_t id, unsigned length, uint32_t data) {
  flexcan_frame_t frame = {0};
  frame.format = extended ? kFLEXCAN_FrameFormatExtend : kFLEXCAN_FrameFormatStandard;
  frame.type = kFLEXCAN_FrameTypeData;
  frame.id = extended ? FLEXCAN_ID_EXT(id) : FLEXCAN_ID_STD(id);
  frame.length = length;
  frame.dataWord0 = data;
  frame.dataWord1 = data * 2654435761u;
  return frame;
}

/* Whether `got` is what the partner answers to `sent`: its identifier, and all bits inverted. */
static bool is_answer(const flexcan_frame_t *sent, const flexcan_frame_t *got) {
  const uint32_t bit = sent->format ? FLEXCAN_ID_EXT(ANSWER) : FLEXCAN_ID_STD(ANSWER);
  if (got->id != (sent->id | bit) || got->format != sent->format || got->length != sent->length ||
      got->type != kFLEXCAN_FrameTypeData)
    return false;
  for (unsigned i = 0; i < sent->length; ++i)
    if ((byte_of(sent, i) ^ byte_of(got, i)) != 0xFFu) return false;
  return true;
}

/* The driver's settings for the bit rate; joins the bus. */
enum mode { NORMAL, LOOP_BACK, LISTEN_ONLY };
static bool join(enum mode mode) {
  flexcan_config_t config;
  FLEXCAN_GetDefaultConfig(&config);
  config.bitRate = BITRATE;
  config.maxMbNum = MAILBOXES;
  config.enableIndividMask = true;
  config.enableLoopBack = mode == LOOP_BACK;
  config.disableSelfReception = mode != LOOP_BACK;
  config.enableListenOnlyMode = mode == LISTEN_ONLY;
  if (!FLEXCAN_CalculateImprovedTimingValues(CAN0, BITRATE, BOARD_CLOCK_HZ, &config.timingConfig))
    return false;
  FLEXCAN_Init(CAN0, &config, BOARD_CLOCK_HZ);
  FLEXCAN_TransferCreateHandle(CAN0, &handle, on_event, NULL);
  FLEXCAN_SetTxMbConfig(CAN0, TX_MB, true);
  return true;
}

static void receive_into(uint8_t mb, bool extended, uint32_t id, uint32_t mask) {
  flexcan_rx_mb_config_t config = {
      .id = extended ? FLEXCAN_ID_EXT(id) : FLEXCAN_ID_STD(id),
      .format = extended ? kFLEXCAN_FrameFormatExtend : kFLEXCAN_FrameFormatStandard,
      .type = kFLEXCAN_FrameTypeData};
  FLEXCAN_SetRxIndividualMask(
      CAN0, mb, extended ? FLEXCAN_RX_MB_EXT_MASK(mask, 1, 1) : FLEXCAN_RX_MB_STD_MASK(mask, 1, 1));
  FLEXCAN_SetRxMbConfig(CAN0, mb, &config, true);
}

static bool polling(void) {
  receive_into(RX_MB, false, 0x500, 0x7F0);
  for (unsigned length = 0; length <= 8; ++length) {
    flexcan_frame_t sent = frame_of(false, 0x100u + length, length, 0x01234567u * length), got;
    if (FLEXCAN_TransferSendBlocking(CAN0, TX_MB, &sent) != kStatus_Success) return false;
    if (FLEXCAN_TransferReceiveBlocking(CAN0, RX_MB, &got) != kStatus_Success) return false;
    if (!is_answer(&sent, &got)) return false;
  }
  return true;
}

static bool send_by_interrupt(flexcan_frame_t *frame) {
  flexcan_mb_transfer_t transfer = {.frame = frame, .mbIdx = TX_MB};
  done[TX_MB] = false;
  return FLEXCAN_TransferSendNonBlocking(CAN0, &handle, &transfer) == kStatus_Success;
}

static bool interrupts(void) {
  receive_into(RX_EXT_MB, true, 0x12340400, 0x1FFFFF00);
  for (unsigned n = 0; n < 20; ++n) {
    flexcan_frame_t sent = frame_of(true, 0x12340000u + n, n % 9u, 0x9E3779B9u * n), got;
    flexcan_mb_transfer_t transfer = {.frame = &got, .mbIdx = RX_EXT_MB};
    done[RX_EXT_MB] = false;
    if (FLEXCAN_TransferReceiveNonBlocking(CAN0, &handle, &transfer) != kStatus_Success ||
        !send_by_interrupt(&sent) || !wait_for(&done[TX_MB], PATIENCE_US) ||
        !wait_for(&done[RX_EXT_MB], PATIENCE_US) || !is_answer(&sent, &got))
      return false;
  }
  return true;
}

/* A mailbox that has sent a remote frame waits for the data frame. */
static bool remote(void) {
  flexcan_frame_t sent = frame_of(false, REMOTE_ID, 5, 0), got;
  sent.type = kFLEXCAN_FrameTypeRemote;
  FLEXCAN_SetTxMbConfig(CAN0, REMOTE_MB, true);
  if (FLEXCAN_TransferSendBlocking(CAN0, REMOTE_MB, &sent) != kStatus_Success) return false;
  while (FLEXCAN_GetMbStatusFlags(CAN0, 1u << REMOTE_MB) == 0u) {
  }
  if (FLEXCAN_ReadRxMb(CAN0, REMOTE_MB, &got) != kStatus_Success || got.length != 5u) return false;
  for (unsigned i = 0; i < 5; ++i)
    if (byte_of(&got, i) != REMOTE_BYTE(i)) return false;
  FLEXCAN_ClearMbStatusFlags(CAN0, 1u << REMOTE_MB);
  return true;
}

/* With asserts, the driver for parts with erratum 5829 cannot switch the FIFO off: it refuses
 * mailbox 0, which it keeps for itself. There it starts anew. */
static bool fifo_off(void) {
#if FSL_FEATURE_FLEXCAN_HAS_ERRATA_5829
  FLEXCAN_Deinit(CAN0);
  return join(NORMAL);
#else
  FLEXCAN_SetRxFifoConfig(CAN0, NULL, false);
  return true;
#endif
}

/* Six answers fit into the FIFO; the filters let the second half of what is asked for through. */
static bool fifo_with(uint32_t *table, flexcan_rx_fifo_filter_type_t type) {
  enum { FILTERS = 8, FRAMES = 6 };
  flexcan_rx_fifo_config_t config = {.idFilterTable = table,
                                     .idFilterNum = FILTERS,
                                     .idFilterType = type,
                                     .priority = kFLEXCAN_RxFifoPrioHigh};
  FLEXCAN_SetRxFifoConfig(CAN0, &config, true);
  FLEXCAN_SetRxFifoGlobalMask(CAN0, 0xFFFFFFFFu);
  for (uint8_t i = 0; i < FILTERS; ++i) FLEXCAN_SetRxIndividualMask(CAN0, i, 0xFFFFFFFFu);
  flexcan_frame_t sent[2 * FRAMES], got[FRAMES];
  flexcan_fifo_transfer_t transfer = {.frame = got, .frameNum = FRAMES};
  fifo_done = false;
  if (FLEXCAN_TransferReceiveFifoNonBlocking(CAN0, &handle, &transfer) != kStatus_Success)
    return false;
  for (unsigned n = 0; n < 2 * FRAMES; ++n) {
    sent[n] = frame_of(false, 0x140u + n, 1u + n % 8u, 0xDEADBEEFu * n);
    if (!send_by_interrupt(&sent[n]) || !wait_for(&done[TX_MB], PATIENCE_US)) return false;
  }
  if (!wait_for(&fifo_done, PATIENCE_US)) return false;
  for (unsigned n = 0; n < FRAMES; ++n)
    if (!is_answer(&sent[FRAMES + n], &got[n])) return false;
  return fifo_off();
}

static bool fifo_a(void) {
  uint32_t table[8];
  for (unsigned i = 0; i < 8; ++i)
    table[i] = FLEXCAN_RX_FIFO_STD_FILTER_TYPE_A(0x546u + (i < 6u ? i : 0u), 0, 0);
  return fifo_with(table, kFLEXCAN_RxFifoFilterTypeA);
}

static bool fifo_b(void) {
  uint32_t table[8];
  for (unsigned i = 0; i < 8; ++i)
    table[i] = FLEXCAN_RX_FIFO_STD_FILTER_TYPE_B_HIGH(0x546u + 2u * (i % 3u), 0, 0) |
               FLEXCAN_RX_FIFO_STD_FILTER_TYPE_B_LOW(0x547u + 2u * (i % 3u), 0, 0);
  return fifo_with(table, kFLEXCAN_RxFifoFilterTypeB);
}

/* Bits 10:3 of identifiers: 540 to 547 do not fit, of 548 to 54F all do. */
static bool fifo_c(void) {
  enum { FRAMES = 4 };
  uint32_t table[8];
  for (unsigned i = 0; i < 8; ++i)
    table[i] = FLEXCAN_RX_FIFO_STD_FILTER_TYPE_C_HIGH(0x548u) |
               FLEXCAN_RX_FIFO_STD_FILTER_TYPE_C_MID_HIGH(0x548u) |
               FLEXCAN_RX_FIFO_STD_FILTER_TYPE_C_MID_LOW(0x548u) |
               FLEXCAN_RX_FIFO_STD_FILTER_TYPE_C_LOW(0x548u);
  flexcan_rx_fifo_config_t config = {.idFilterTable = table,
                                     .idFilterNum = 8,
                                     .idFilterType = kFLEXCAN_RxFifoFilterTypeC,
                                     .priority = kFLEXCAN_RxFifoPrioLow};
  FLEXCAN_SetRxFifoConfig(CAN0, &config, true);
  for (unsigned n = 0; n < 2 * FRAMES; ++n) {
    flexcan_frame_t sent = frame_of(false, 0x144u + n, 8, 0xC0FFEE00u + n), got;
    if (FLEXCAN_TransferSendBlocking(CAN0, TX_MB, &sent) != kStatus_Success) return false;
    if (n < FRAMES) continue;
    if (FLEXCAN_TransferReceiveFifoBlocking(CAN0, &got) != kStatus_Success) return false;
    if (!is_answer(&sent, &got)) return false;
  }
  return fifo_off();
}

static bool order(unsigned count, unsigned delay_ms) {
  flexcan_frame_t frame = frame_of(false, ORDER_ID, 2, count << 24 | delay_ms << 16);
  return FLEXCAN_TransferSendBlocking(CAN0, TX_MB, &frame) == kStatus_Success;
}

static bool is_of_burst(const flexcan_frame_t *frame, unsigned n) {
  return frame->id == FLEXCAN_ID_STD(BURST_ID) && frame->length == 1u && byte_of(frame, 0) == n;
}

/* Frames without a pause: the FIFO and its interrupts lose none. The driver reads five at each
 * warning and the last ones one by one; of a multiple of five it never reads the last five. */
static bool flood(void) {
  enum { FRAMES = 98 };
  static flexcan_frame_t got[FRAMES];
  uint32_t table[8];
  for (unsigned i = 0; i < 8; ++i) table[i] = FLEXCAN_RX_FIFO_STD_FILTER_TYPE_A(BURST_ID, 0, 0);
  flexcan_rx_fifo_config_t config = {.idFilterTable = table,
                                     .idFilterNum = 8,
                                     .idFilterType = kFLEXCAN_RxFifoFilterTypeA,
                                     .priority = kFLEXCAN_RxFifoPrioHigh};
  FLEXCAN_SetRxFifoConfig(CAN0, &config, true);
  flexcan_fifo_transfer_t transfer = {.frame = got, .frameNum = FRAMES};
  fifo_done = false;
  if (!order(FRAMES, 1) ||
      FLEXCAN_TransferReceiveFifoNonBlocking(CAN0, &handle, &transfer) != kStatus_Success ||
      !wait_for(&fifo_done, PATIENCE_US))
    return false;
  for (unsigned n = 0; n < FRAMES; ++n)
    if (!is_of_burst(&got[n], n)) return false;
  return fifo_off();
}

/* Nobody acknowledges the partner's frame, which it repeats; one that listens only receives it. */
static bool listen_only(void) {
  flexcan_frame_t got;
  if (!order(1, 3)) return false;
  FLEXCAN_Deinit(CAN0);
  if (!join(LISTEN_ONLY)) return false;
  receive_into(RX_MB, false, BURST_ID, 0x7FF);
  if (FLEXCAN_TransferReceiveBlocking(CAN0, RX_MB, &got) != kStatus_Success) return false;
  FLEXCAN_Deinit(CAN0);
  return is_of_burst(&got, 0) && join(NORMAL);
}

/* A frame that is taken back: the mailbox is free at once, and the next frame leaves. */
static bool abort_send(void) {
  flexcan_frame_t first = frame_of(false, 0x180, 8, 1), second = frame_of(false, 0x181, 8, 2), got;
  receive_into(RX_MB, false, 0x581, 0x7FF);
  if (!send_by_interrupt(&first)) return false;
  FLEXCAN_TransferAbortSend(CAN0, &handle, TX_MB);
  if (!send_by_interrupt(&second) || !wait_for(&done[TX_MB], PATIENCE_US)) return false;
  return FLEXCAN_TransferReceiveBlocking(CAN0, RX_MB, &got) == kStatus_Success &&
         is_answer(&second, &got);
}

/* Of a loop-back the partner sees nothing: it would answer. */
static bool loop_back(void) {
  FLEXCAN_Deinit(CAN0);
  if (!join(LOOP_BACK)) return false;
  receive_into(RX_MB, false, 0x190, 0x7FF);
  flexcan_frame_t sent = frame_of(false, 0x190, 8, 0x55AA55AAu), got;
  const bool same = FLEXCAN_TransferSendBlocking(CAN0, TX_MB, &sent) == kStatus_Success &&
                    FLEXCAN_TransferReceiveBlocking(CAN0, RX_MB, &got) == kStatus_Success &&
                    got.id == sent.id && got.dataWord0 == sent.dataWord0 &&
                    got.dataWord1 == sent.dataWord1;
  FLEXCAN_Deinit(CAN0);
  return same && join(NORMAL);
}

/* From OFF_AT_US on nothing that the node sends comes back to it, for some milliseconds. */
static bool bus_off(void) {
  flexcan_frame_t sent = frame_of(false, 0x1A0, 8, 3), got;
  receive_into(RX_MB, false, 0x5A0, 0x7FF);
  if (semihost_microseconds() > OFF_AT_US) return false;
  while (semihost_microseconds() < OFF_AT_US + 500u) {
  }
  uint8_t tec, rec;
  if (!send_by_interrupt(&sent) || !wait_for(&was_off, PATIENCE_US) ||
      !wait_for(&done[TX_MB], PATIENCE_US) ||
      FLEXCAN_TransferReceiveBlocking(CAN0, RX_MB, &got) != kStatus_Success)
    return false;
  FLEXCAN_GetBusErrCount(CAN0, &tec, &rec);
  return is_answer(&sent, &got) && tec == 0u;
}

static unsigned failures;

static void check(const char *name, bool (*run)(void)) {
  const bool ok = run();
  semihost_printf("%s %s\n", ok ? "ok" : "FAILED", name);
  if (!ok) ++failures;
}

int main(void) {
  board_irq_enable(BOARD_IRQ_CAN0, 1);
  if (!join(NORMAL)) return 98;
  while (semihost_microseconds() < READY_US) {
  }
  check("polling", polling);
  check("interrupts", interrupts);
  check("remote", remote);
  check("fifo, table A", fifo_a);
  check("fifo, table B", fifo_b);
  check("fifo, table C", fifo_c);
  check("flood", flood);
  check("abort", abort_send);
  check("loop-back", loop_back);
  check("listen-only", listen_only);
  check("bus-off", bus_off);
  flexcan_frame_t end = frame_of(false, END_ID, 0, 0);
  (void)FLEXCAN_TransferSendBlocking(CAN0, TX_MB, &end);
  FLEXCAN_Deinit(CAN0);
  return (int)failures;
}

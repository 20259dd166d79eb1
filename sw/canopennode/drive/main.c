/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The servo drive as Cortex-M3 firmware: CANopenNode on the board of sw/firmware/common.
 */
#include "OD.h"
#include "board.h"
#include "co_node.h"
#include "co_storage.h"
#include "drive.h"
#include "objects.h"
#include "semihost.h"

enum { TICK_US = 1000, CAN_PRIORITY = 4, BUS_OFF_DELAY_MS = 20 };

#define SCB_ICSR (*(volatile uint32_t *)0xE000ED04u)
#define ICSR_PENDSVSET (1u << 28)
#define SCB_SHPR3_PENDSV (*(volatile uint8_t *)0xE000ED22u)
#define SCB_AIRCR (*(volatile uint32_t *)0xE000ED0Cu)
#define AIRCR_RESET 0x05FA0004u /* key, SYSRESETREQ */
#define LEAST_URGENT 0xFFu

/* From the linker, an image for each drive (sw/canopennode/build.py): node-ID, or 255 for one that
 * LSS gives; serial number; bit rate in kbit/s. */
extern const char drive_node_id[], drive_serial[], drive_kbit[];

static co_node_t node;
static drive_t drive;
static volatile uint32_t milliseconds;

/* Survives SYSRESETREQ: the startup code does not clear it. */
static struct {
  uint8_t comm[CO_STORAGE_MEMORY(sizeof(OD_PERSIST_COMM_t))] __attribute__((aligned(4)));
  uint8_t app[CO_STORAGE_MEMORY(sizeof(OD_PERSIST_APP_t))] __attribute__((aligned(4)));
} kept __attribute__((section(".noinit")));

static CO_storage_t storage;
static CO_storage_entry_t groups[] = {
    {&OD_PERSIST_COMM, sizeof OD_PERSIST_COMM, 2, CO_storage_cmd | CO_storage_restore, kept.comm},
    {&OD_PERSIST_APP, sizeof OD_PERSIST_APP, 3, CO_storage_cmd | CO_storage_restore, kept.app}};

/* ---- Time -------------------------------------------------------------------------------------
 */

static uint32_t now_ms(void) { return milliseconds; }

static uint32_t now_us(void) { return board_systick_us(&milliseconds, TICK_US); }

/* ---- Interrupts -------------------------------------------------------------------------------
 */

void can0_handler(void) { co_node_can_interrupt(&node); }

static void request_real_time(void) { SCB_ICSR = ICSR_PENDSVSET; }

void systick_handler(void) {
  ++milliseconds;
  request_real_time();
}

void pendsv_handler(void);
void pendsv_handler(void) { co_node_real_time(&node); }

static void wait(co_node_t *of) {
  const uint32_t since = milliseconds;
  while (milliseconds == since) {
    board_irq_off();
    const bool work = co_node_work(of);
    if (!work) board_wait();
    board_irq_on();
    if (work) return;
  }
}

/* ---- The device -------------------------------------------------------------------------------
 */

static void on_real_time(co_node_t *of, bool sync, uint32_t elapsed_us) {
  (void)of;
  if (!sync) return;
  static uint32_t last_us;
  const uint32_t now = now_us();
  (void)elapsed_us;
  /* The short set point, for PDOs that several drives share, is on top of the long one. */
  const int64_t target = (int64_t)OD_RAM.x607A_targetPosition + OD_RAM.x2009_shortSetPoint;
  drive_cycle(&drive, OD_RAM.x6040_controlword, target, now - last_us);
  last_us = now;
  OD_RAM.x6041_statusword = drive.status;
  OD_RAM.x6064_positionActualValue = drive.position;
  OD_RAM.x200A_shortPosition = (int16_t)drive.position;
  OD_RAM.x606C_velocityActualValue = drive.velocity;
}

static void on_loop(co_node_t *of) {
  if (of->co->nodeIdUnconfigured) return;
  if (objects_serve(of)) drive_fail(&drive);
}

static void on_reset(co_node_t *of) {
  objects_install(of);
  drive_init(&drive);
  semihost_printf("node %u on the bus at %u kbit/s\n", of->active_id, of->kbit);
}

static bool store_lss(co_node_t *of, uint8_t id, uint16_t kbit) {
  (void)of;
  semihost_printf("LSS: node-ID %u, %u kbit/s stored\n", id, kbit);
  return true;
}

static void set_up(void) {
  board_can_port(&node.can.port, 0);
  node.can.clock_hz = BOARD_CLOCK_HZ;
  node.can.bus_off_delay_ms = BUS_OFF_DELAY_MS;
  node.can.now_ms = now_ms;
  node.board = (co_node_board_t){now_us, request_real_time, wait};
  node.hooks = (co_node_hooks_t){.on_reset = on_reset,
                                 .on_real_time = on_real_time,
                                 .on_loop = on_loop,
                                 .store_lss = store_lss};
  OD_RAM.x1018_identityObject.serialNumber = (uint32_t)(uintptr_t)drive_serial;
  node.od = OD;
  node.identity.identity.vendorID = OD_RAM.x1018_identityObject.vendorID;
  node.identity.identity.productCode = OD_RAM.x1018_identityObject.productCode;
  node.identity.identity.revisionNumber = OD_RAM.x1018_identityObject.revisionNumber;
  node.identity.identity.serialNumber = OD_RAM.x1018_identityObject.serialNumber;
  node.node_id = (uint8_t)(uintptr_t)drive_node_id;
  node.kbit = (uint16_t)(uintptr_t)drive_kbit;
  node.nmt_control = CO_NMT_ERR_ON_ERR_REG | CO_ERR_REG_GENERIC_ERR;
}

static bool open_storage(void) {
  uint8_t damaged = 0;
  node.co = CO_new(NULL, NULL);
  if (node.co == NULL) return false;
  return co_storage_open(&storage, node.co->CANmodule, OD_ENTRY_H1010, OD_ENTRY_H1011, groups,
                         sizeof groups / sizeof *groups, &damaged) == CO_ERROR_NO;
}

int main(void) {
  uint32_t info = 0;
  set_up();
  if (!open_storage()) {
    semihost_print("no memory for CANopenNode\n");
    return 1;
  }
  SCB_SHPR3_PENDSV = LEAST_URGENT;
  board_systick_start(TICK_US);
  board_irq_enable(BOARD_IRQ_CAN0, CAN_PRIORITY);
  const CO_ReturnError_t result = co_node_run(&node, &info);
  semihost_printf("CANopenNode: %d, %04x\n", (int)result, (unsigned)info);
  if (result == CO_ERROR_NO) SCB_AIRCR = AIRCR_RESET; /* NMT: reset node */
  return 1;
}

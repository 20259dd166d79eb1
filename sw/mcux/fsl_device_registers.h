/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The device header that NXP's SDK includes, for a board with VeriCAN (docs/software.md): that of a
 * part with classical FlexCAN, -DMCUX_PART=MK64F12 (16 buffers) or MIMXRT1052 (64), with the
 * address and the interrupt of the board.
 */
#ifndef VERICAN_FSL_DEVICE_REGISTERS_H
#define VERICAN_FSL_DEVICE_REGISTERS_H

#define MCUX_TEXT_OF(name) #name
#define MCUX_TEXT(name) MCUX_TEXT_OF(name)
#define MCUX_JOINED(part, tail) part##tail
#define MCUX_JOIN(part, tail) MCUX_JOINED(part, tail)
/* clang-format off */
#include MCUX_TEXT(MCUX_PART.h)
#include MCUX_TEXT(MCUX_JOIN(MCUX_PART, _features).h)
/* clang-format on */

/* One core. There is one line, irq_o, so all kinds of interrupts have the same number. */
#ifndef BOARD_CAN_ADDRESS
#define BOARD_CAN_ADDRESS 0x40050000u
#endif
#ifndef BOARD_CAN_IRQ
#define BOARD_CAN_IRQ 31
#endif
#undef CAN0
#undef CAN1
#undef CAN2
#undef CAN_BASE_PTRS
#define CAN0 ((CAN_Type *)BOARD_CAN_ADDRESS)
#define CAN_BASE_PTRS \
  { CAN0 }
#undef CAN_Rx_Warning_IRQS
#undef CAN_Tx_Warning_IRQS
#undef CAN_Wake_Up_IRQS
#undef CAN_Error_IRQS
#undef CAN_Bus_Off_IRQS
#undef CAN_ORed_Message_buffer_IRQS
#define CAN_Rx_Warning_IRQS \
  { (IRQn_Type) BOARD_CAN_IRQ }
#define CAN_Tx_Warning_IRQS \
  { (IRQn_Type) BOARD_CAN_IRQ }
#define CAN_Wake_Up_IRQS \
  { (IRQn_Type) BOARD_CAN_IRQ }
#define CAN_Error_IRQS \
  { (IRQn_Type) BOARD_CAN_IRQ }
#define CAN_Bus_Off_IRQS \
  { (IRQn_Type) BOARD_CAN_IRQ }
#define CAN_ORed_Message_buffer_IRQS \
  { (IRQn_Type) BOARD_CAN_IRQ }

#endif /* VERICAN_FSL_DEVICE_REGISTERS_H */

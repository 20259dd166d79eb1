/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Register map of the CAN 2.0 controller with FlexCAN registers.
 * Written by tools/registers.py from sw/registers.yaml; edits are lost.
 *
 * VERICAN_<REG>_OFFSET            byte offset from the base of the controller
 * VERICAN_<REG>_RESET             value after the hard reset
 * VERICAN_<REG>_<FIELD>_MASK      the field's bits in the word
 * VERICAN_<REG>_<FIELD>_SHIFT     number of its lowest bit
 * VERICAN_<REG>_<FIELD>_GET(word) the field's value in a word; of fields of several bits
 * VERICAN_<REG>_<FIELD>_SET(value) a value, cut to the field's width, at its place in a word
 * VERICAN_<REG>_<FIELD>_<NAME>    a value of the field, not shifted
 *
 * Registers of an array take the index: VERICAN_MB_CS_OFFSET(n), VERICAN_RXIMR_OFFSET(n).
 * Whether bits of IMASK, IFLAG, MB and RXIMR exist depends on XCONFIG.NUM_MB.
 */
#ifndef VERICAN_REGS_H
#define VERICAN_REGS_H

#include <stdint.h>

/* clang-format off */

/* MCR: Module configuration. */
#define VERICAN_MCR_OFFSET                      0x000u
#define VERICAN_MCR_RESET                       0xD890000Fu
/* MDIS: Requests disable mode; LPM_ACK tells that it is reached. */
#define VERICAN_MCR_MDIS_MASK                   0x80000000u
#define VERICAN_MCR_MDIS_SHIFT                  31u
/* FRZ: Allows freeze mode, which HALT then requests. */
#define VERICAN_MCR_FRZ_MASK                    0x40000000u
#define VERICAN_MCR_FRZ_SHIFT                   30u
/* FEN: Receive FIFO in place of the first buffers. A change empties the FIFO and clears
   IFLAG1[7:5]. Only with Fifo. */
#define VERICAN_MCR_FEN_MASK                    0x20000000u
#define VERICAN_MCR_FEN_SHIFT                   29u
/* HALT: With FRZ, requests freeze mode; FRZ_ACK tells that it is reached. */
#define VERICAN_MCR_HALT_MASK                   0x10000000u
#define VERICAN_MCR_HALT_SHIFT                  28u
/* NOT_RDY: The controller does not take part in the bus (disable or freeze mode, stopped). */
#define VERICAN_MCR_NOT_RDY_MASK                0x08000000u
#define VERICAN_MCR_NOT_RDY_SHIFT               27u
/* WAK_MSK: Lets ESR1.WAK_INT interrupt. Only with Wake. */
#define VERICAN_MCR_WAK_MSK_MASK                0x04000000u
#define VERICAN_MCR_WAK_MSK_SHIFT               26u
/* SOFT_RST: Requests a soft reset; reads 1 until it is done, then the controller is in freeze
   mode. Wins over the mode bits written along with it. Ignored in disable and stop mode, where
   the mode bits of such a write count. */
#define VERICAN_MCR_SOFT_RST_MASK               0x02000000u
#define VERICAN_MCR_SOFT_RST_SHIFT              25u
/* FRZ_ACK: Freeze mode is reached; the engine stands, configuration can be written. */
#define VERICAN_MCR_FRZ_ACK_MASK                0x01000000u
#define VERICAN_MCR_FRZ_ACK_SHIFT               24u
/* SUPV: Registers for privileged accesses only; others then read 0 and write nothing. Stored,
   without effect, in a core built with CheckHprot = 0. */
#define VERICAN_MCR_SUPV_MASK                   0x00800000u
#define VERICAN_MCR_SUPV_SHIFT                  23u
/* SLF_WAK: Wakes the controller from stop mode by itself when the bus turns dominant. Cannot be
   written in stop mode. Only with Wake. */
#define VERICAN_MCR_SLF_WAK_MASK                0x00400000u
#define VERICAN_MCR_SLF_WAK_SHIFT               22u
/* WRN_EN: Lets ESR1.TWRN_INT and RWRN_INT be set. While 0 they read 0, and so do their masks in
   CTRL1, which keep what was written before. */
#define VERICAN_MCR_WRN_EN_MASK                 0x00200000u
#define VERICAN_MCR_WRN_EN_SHIFT                21u
/* LPM_ACK: A low-power mode (disable, stop) is reached. */
#define VERICAN_MCR_LPM_ACK_MASK                0x00100000u
#define VERICAN_MCR_LPM_ACK_SHIFT               20u
/* WAK_SRC: Wake-up looks at the filtered receive line, not at the pin. Only with Wake. */
#define VERICAN_MCR_WAK_SRC_MASK                0x00080000u
#define VERICAN_MCR_WAK_SRC_SHIFT               19u
/* DOZE: Doze mode allowed; stored, without effect. */
#define VERICAN_MCR_DOZE_MASK                   0x00040000u
#define VERICAN_MCR_DOZE_SHIFT                  18u
/* SRX_DIS: The node's own frames are not received into its own buffers; 0, as after reset,
   receives them like any other. */
#define VERICAN_MCR_SRX_DIS_MASK                0x00020000u
#define VERICAN_MCR_SRX_DIS_SHIFT               17u
/* BCC: Individual masks (RXIMR) and the queue of several matching buffers; 0 is the older way
   with the global masks (also called IRMQ). Only with OwnMasks. */
#define VERICAN_MCR_BCC_MASK                    0x00010000u
#define VERICAN_MCR_BCC_SHIFT                   16u
/* LPRIO_EN: The PRIO field of the ID word takes part in the choice of the next frame to send.
   Only with Extras. */
#define VERICAN_MCR_LPRIO_EN_MASK               0x00002000u
#define VERICAN_MCR_LPRIO_EN_SHIFT              13u
/* AEN: Buffers that send can be aborted with code 1001. The C/S word of a frame on its way can
   then not be overwritten, and once it has ended no word of its buffer can be written until its
   IFLAG is cleared. Only with Abort. */
#define VERICAN_MCR_AEN_MASK                    0x00001000u
#define VERICAN_MCR_AEN_SHIFT                   12u
/* IDAM: Format of the filters of the receive FIFO. Only with Fifo. */
#define VERICAN_MCR_IDAM_MASK                   0x00000300u
#define VERICAN_MCR_IDAM_SHIFT                  8u
#define VERICAN_MCR_IDAM_GET(word)              (((uint32_t)(word) >> 8) & 0x3u)
#define VERICAN_MCR_IDAM_SET(value)             (((uint32_t)(value) & 0x3u) << 8)
#define VERICAN_MCR_IDAM_FORMAT_A               0x0u /* one whole identifier a word */
#define VERICAN_MCR_IDAM_FORMAT_B               0x1u /* two identifiers of at most 14 bits a word */
#define VERICAN_MCR_IDAM_FORMAT_C               0x2u /* four identifiers of 8 bits a word */
#define VERICAN_MCR_IDAM_REJECT                 0x3u /* no frame passes */
/* MAXMB: Last buffer that takes part in sending and receiving; 15 after reset, however many
   there are. Only with Extras. */
#define VERICAN_MCR_MAXMB_MASK                  0x0000007Fu
#define VERICAN_MCR_MAXMB_SHIFT                 0u
#define VERICAN_MCR_MAXMB_GET(word)             (((uint32_t)(word) >> 0) & 0x7Fu)
#define VERICAN_MCR_MAXMB_SET(value)            (((uint32_t)(value) & 0x7Fu) << 0)

/* CTRL1: Bit timing, interrupt masks and bus behaviour. */
#define VERICAN_CTRL1_OFFSET                    0x004u
#define VERICAN_CTRL1_RESET                     0x00000000u
/* PRESDIV: Clocks a time quantum, minus one. */
#define VERICAN_CTRL1_PRESDIV_MASK              0xFF000000u
#define VERICAN_CTRL1_PRESDIV_SHIFT             24u
#define VERICAN_CTRL1_PRESDIV_GET(word)         (((uint32_t)(word) >> 24) & 0xFFu)
#define VERICAN_CTRL1_PRESDIV_SET(value)        (((uint32_t)(value) & 0xFFu) << 24)
/* RJW: Synchronisation jump width in time quanta, minus one. */
#define VERICAN_CTRL1_RJW_MASK                  0x00C00000u
#define VERICAN_CTRL1_RJW_SHIFT                 22u
#define VERICAN_CTRL1_RJW_GET(word)             (((uint32_t)(word) >> 22) & 0x3u)
#define VERICAN_CTRL1_RJW_SET(value)            (((uint32_t)(value) & 0x3u) << 22)
/* PSEG1: Phase segment 1 in time quanta, minus one. */
#define VERICAN_CTRL1_PSEG1_MASK                0x00380000u
#define VERICAN_CTRL1_PSEG1_SHIFT               19u
#define VERICAN_CTRL1_PSEG1_GET(word)           (((uint32_t)(word) >> 19) & 0x7u)
#define VERICAN_CTRL1_PSEG1_SET(value)          (((uint32_t)(value) & 0x7u) << 19)
/* PSEG2: Phase segment 2 in time quanta, minus one; at least 1. */
#define VERICAN_CTRL1_PSEG2_MASK                0x00070000u
#define VERICAN_CTRL1_PSEG2_SHIFT               16u
#define VERICAN_CTRL1_PSEG2_GET(word)           (((uint32_t)(word) >> 16) & 0x7u)
#define VERICAN_CTRL1_PSEG2_SET(value)          (((uint32_t)(value) & 0x7u) << 16)
/* BOFF_MSK: Lets ESR1.BOFF_INT interrupt. */
#define VERICAN_CTRL1_BOFF_MSK_MASK             0x00008000u
#define VERICAN_CTRL1_BOFF_MSK_SHIFT            15u
/* ERR_MSK: Lets ESR1.ERR_INT interrupt. */
#define VERICAN_CTRL1_ERR_MSK_MASK              0x00004000u
#define VERICAN_CTRL1_ERR_MSK_SHIFT             14u
/* CLK_SRC: Clock of the engine; stored, without effect, there is one clock. */
#define VERICAN_CTRL1_CLK_SRC_MASK              0x00002000u
#define VERICAN_CTRL1_CLK_SRC_SHIFT             13u
/* LPB: Loop-back inside the controller; the bus sees recessive and is not seen. */
#define VERICAN_CTRL1_LPB_MASK                  0x00001000u
#define VERICAN_CTRL1_LPB_SHIFT                 12u
/* TWRN_MSK: Lets ESR1.TWRN_INT interrupt. */
#define VERICAN_CTRL1_TWRN_MSK_MASK             0x00000800u
#define VERICAN_CTRL1_TWRN_MSK_SHIFT            11u
/* RWRN_MSK: Lets ESR1.RWRN_INT interrupt. */
#define VERICAN_CTRL1_RWRN_MSK_MASK             0x00000400u
#define VERICAN_CTRL1_RWRN_MSK_SHIFT            10u
/* SMP: Takes the majority of three samples a bit. */
#define VERICAN_CTRL1_SMP_MASK                  0x00000080u
#define VERICAN_CTRL1_SMP_SHIFT                 7u
/* BOFF_REC: 0 recovers from bus-off by itself; 1 stays in bus-off until it is cleared. */
#define VERICAN_CTRL1_BOFF_REC_MASK             0x00000040u
#define VERICAN_CTRL1_BOFF_REC_SHIFT            6u
/* TSYN: A frame stored in the first mailbox clears TIMER. Only with Extras. */
#define VERICAN_CTRL1_TSYN_MASK                 0x00000020u
#define VERICAN_CTRL1_TSYN_SHIFT                5u
/* LBUF: 1 sends the lowest-numbered buffer first; 0 the one that wins arbitration. Only with
   Extras. */
#define VERICAN_CTRL1_LBUF_MASK                 0x00000010u
#define VERICAN_CTRL1_LBUF_SHIFT                4u
/* LOM: Listen-only; nothing dominant is ever sent. */
#define VERICAN_CTRL1_LOM_MASK                  0x00000008u
#define VERICAN_CTRL1_LOM_SHIFT                 3u
/* PROPSEG: Propagation segment in time quanta, minus one. */
#define VERICAN_CTRL1_PROPSEG_MASK              0x00000007u
#define VERICAN_CTRL1_PROPSEG_SHIFT             0u
#define VERICAN_CTRL1_PROPSEG_GET(word)         (((uint32_t)(word) >> 0) & 0x7u)
#define VERICAN_CTRL1_PROPSEG_SET(value)        (((uint32_t)(value) & 0x7u) << 0)

/* TIMER: Free-running timer. */
#define VERICAN_TIMER_OFFSET                    0x008u
#define VERICAN_TIMER_RESET                     0x00000000u
/* TIMER: Counts bit times; the time stamps of frames come from here. */
#define VERICAN_TIMER_TIMER_MASK                0x0000FFFFu
#define VERICAN_TIMER_TIMER_SHIFT               0u
#define VERICAN_TIMER_TIMER_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFu)
#define VERICAN_TIMER_TIMER_SET(value)          (((uint32_t)(value) & 0xFFFFu) << 0)

/* RXGMASK: Receive mask of all buffers but 14 and 15. */
#define VERICAN_RXGMASK_OFFSET                  0x010u
#define VERICAN_RXGMASK_RESET                   0xFFFFFFFFu
/* MG: Used with MCR.BCC = 0; a 1 compares the bit of the ID word, and with CTRL2.EACEN 31 is
   RTR, 30 is IDE. As after reset: a buffer takes exactly the identifier that it holds. */
#define VERICAN_RXGMASK_MG_MASK                 0xFFFFFFFFu
#define VERICAN_RXGMASK_MG_SHIFT                0u
#define VERICAN_RXGMASK_MG_GET(word)            (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_RXGMASK_MG_SET(value)           (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* RX14MASK: Receive mask of buffer 14. */
#define VERICAN_RX14MASK_OFFSET                 0x014u
#define VERICAN_RX14MASK_RESET                  0xFFFFFFFFu
/* RX14M: As RXGMASK. */
#define VERICAN_RX14MASK_RX14M_MASK             0xFFFFFFFFu
#define VERICAN_RX14MASK_RX14M_SHIFT            0u
#define VERICAN_RX14MASK_RX14M_GET(word)        (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_RX14MASK_RX14M_SET(value)       (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* RX15MASK: Receive mask of buffer 15. */
#define VERICAN_RX15MASK_OFFSET                 0x018u
#define VERICAN_RX15MASK_RESET                  0xFFFFFFFFu
/* RX15M: As RXGMASK. */
#define VERICAN_RX15MASK_RX15M_MASK             0xFFFFFFFFu
#define VERICAN_RX15MASK_RX15M_SHIFT            0u
#define VERICAN_RX15MASK_RX15M_GET(word)        (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_RX15MASK_RX15M_SET(value)       (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* ECR: Error counters. */
#define VERICAN_ECR_OFFSET                      0x01Cu
#define VERICAN_ECR_RESET                       0x00000000u
/* RXERR: Receive error counter, REC. */
#define VERICAN_ECR_RXERR_MASK                  0x0000FF00u
#define VERICAN_ECR_RXERR_SHIFT                 8u
#define VERICAN_ECR_RXERR_GET(word)             (((uint32_t)(word) >> 8) & 0xFFu)
#define VERICAN_ECR_RXERR_SET(value)            (((uint32_t)(value) & 0xFFu) << 8)
/* TXERR: Transmit error counter, TEC; in bus-off the sequences of 11 recessive bits so far,
   which are not written. */
#define VERICAN_ECR_TXERR_MASK                  0x000000FFu
#define VERICAN_ECR_TXERR_SHIFT                 0u
#define VERICAN_ECR_TXERR_GET(word)             (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_ECR_TXERR_SET(value)            (((uint32_t)(value) & 0xFFu) << 0)

/* ESR1: Errors and status. */
#define VERICAN_ESR1_OFFSET                     0x020u
#define VERICAN_ESR1_RESET                      0x00000000u
/* SYNCH: The node has integrated and can take part in the bus. */
#define VERICAN_ESR1_SYNCH_MASK                 0x00040000u
#define VERICAN_ESR1_SYNCH_SHIFT                18u
/* TWRN_INT: The transmit error counter reached 96; only with MCR.WRN_EN. */
#define VERICAN_ESR1_TWRN_INT_MASK              0x00020000u
#define VERICAN_ESR1_TWRN_INT_SHIFT             17u
/* RWRN_INT: The receive error counter reached 96; only with MCR.WRN_EN. */
#define VERICAN_ESR1_RWRN_INT_MASK              0x00010000u
#define VERICAN_ESR1_RWRN_INT_SHIFT             16u
/* BIT1_ERR: Sent recessive, saw dominant. */
#define VERICAN_ESR1_BIT1_ERR_MASK              0x00008000u
#define VERICAN_ESR1_BIT1_ERR_SHIFT             15u
/* BIT0_ERR: Sent dominant, saw recessive. */
#define VERICAN_ESR1_BIT0_ERR_MASK              0x00004000u
#define VERICAN_ESR1_BIT0_ERR_SHIFT             14u
/* ACK_ERR: Nobody acknowledged a frame that was sent. */
#define VERICAN_ESR1_ACK_ERR_MASK               0x00002000u
#define VERICAN_ESR1_ACK_ERR_SHIFT              13u
/* CRC_ERR: The CRC of a received frame was wrong. */
#define VERICAN_ESR1_CRC_ERR_MASK               0x00001000u
#define VERICAN_ESR1_CRC_ERR_SHIFT              12u
/* FRM_ERR: A bit of fixed form was wrong. */
#define VERICAN_ESR1_FRM_ERR_MASK               0x00000800u
#define VERICAN_ESR1_FRM_ERR_SHIFT              11u
/* STF_ERR: Six equal bits where a stuff bit belongs. */
#define VERICAN_ESR1_STF_ERR_MASK               0x00000400u
#define VERICAN_ESR1_STF_ERR_SHIFT              10u
/* TX_WRN: The transmit error counter is 96 or more. */
#define VERICAN_ESR1_TX_WRN_MASK                0x00000200u
#define VERICAN_ESR1_TX_WRN_SHIFT               9u
/* RX_WRN: The receive error counter is 96 or more. */
#define VERICAN_ESR1_RX_WRN_MASK                0x00000100u
#define VERICAN_ESR1_RX_WRN_SHIFT               8u
/* IDLE: The bus is idle. */
#define VERICAN_ESR1_IDLE_MASK                  0x00000080u
#define VERICAN_ESR1_IDLE_SHIFT                 7u
/* TX: The node is sending. */
#define VERICAN_ESR1_TX_MASK                    0x00000040u
#define VERICAN_ESR1_TX_SHIFT                   6u
/* FLT_CONF: Error state; listen-only reads as passive. */
#define VERICAN_ESR1_FLT_CONF_MASK              0x00000030u
#define VERICAN_ESR1_FLT_CONF_SHIFT             4u
#define VERICAN_ESR1_FLT_CONF_GET(word)         (((uint32_t)(word) >> 4) & 0x3u)
#define VERICAN_ESR1_FLT_CONF_SET(value)        (((uint32_t)(value) & 0x3u) << 4)
#define VERICAN_ESR1_FLT_CONF_ACTIVE            0x0u /* error active */
#define VERICAN_ESR1_FLT_CONF_PASSIVE           0x1u /* error passive */
#define VERICAN_ESR1_FLT_CONF_BUS_OFF           0x2u /* bus-off; so is 3 */
/* RX: The node is receiving. */
#define VERICAN_ESR1_RX_MASK                    0x00000008u
#define VERICAN_ESR1_RX_SHIFT                   3u
/* BOFF_INT: The node went bus-off. */
#define VERICAN_ESR1_BOFF_INT_MASK              0x00000004u
#define VERICAN_ESR1_BOFF_INT_SHIFT             2u
/* ERR_INT: An error was detected; bits 15 to 10 tell which. */
#define VERICAN_ESR1_ERR_INT_MASK               0x00000002u
#define VERICAN_ESR1_ERR_INT_SHIFT              1u
/* WAK_INT: The bus turned dominant in stop mode with MCR.SLF_WAK. Only with Wake. */
#define VERICAN_ESR1_WAK_INT_MASK               0x00000001u
#define VERICAN_ESR1_WAK_INT_SHIFT              0u

/* IMASK2: Interrupt masks of buffers 32 to 63. Only if NumMb > 32. */
#define VERICAN_IMASK2_OFFSET                   0x024u
#define VERICAN_IMASK2_RESET                    0x00000000u
/* BUFM: Lets the flag of buffer 32 + n interrupt. */
#define VERICAN_IMASK2_BUFM_MASK                0xFFFFFFFFu
#define VERICAN_IMASK2_BUFM_SHIFT               0u
#define VERICAN_IMASK2_BUFM_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_IMASK2_BUFM_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* IMASK1: Interrupt masks of buffers 0 to 31. */
#define VERICAN_IMASK1_OFFSET                   0x028u
#define VERICAN_IMASK1_RESET                    0x00000000u
/* BUFM: Lets the flag of buffer n interrupt. */
#define VERICAN_IMASK1_BUFM_MASK                0xFFFFFFFFu
#define VERICAN_IMASK1_BUFM_SHIFT               0u
#define VERICAN_IMASK1_BUFM_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_IMASK1_BUFM_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* IFLAG2: Interrupt flags of buffers 32 to 63. Only if NumMb > 32. */
#define VERICAN_IFLAG2_OFFSET                   0x02Cu
#define VERICAN_IFLAG2_RESET                    0x00000000u
/* BUFI: Buffer 32 + n has sent, received or aborted. */
#define VERICAN_IFLAG2_BUFI_MASK                0xFFFFFFFFu
#define VERICAN_IFLAG2_BUFI_SHIFT               0u
#define VERICAN_IFLAG2_BUFI_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_IFLAG2_BUFI_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* IFLAG1: Interrupt flags of buffers 0 to 31. */
#define VERICAN_IFLAG1_OFFSET                   0x030u
#define VERICAN_IFLAG1_RESET                    0x00000000u
/* BUFI: Buffer n has sent, received or aborted. With MCR.FEN the low bits belong to the FIFO: 4
   to 0 read 0 and 7 to 5 are as follows. */
#define VERICAN_IFLAG1_BUFI_MASK                0xFFFFFFFFu
#define VERICAN_IFLAG1_BUFI_SHIFT               0u
#define VERICAN_IFLAG1_BUFI_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_IFLAG1_BUFI_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)
/* FIFO_OVERFLOW: A frame for the FIFO was lost, it was full. */
#define VERICAN_IFLAG1_FIFO_OVERFLOW_MASK       0x00000080u
#define VERICAN_IFLAG1_FIFO_OVERFLOW_SHIFT      7u
/* FIFO_WARNING: The FIFO has come to five frames. */
#define VERICAN_IFLAG1_FIFO_WARNING_MASK        0x00000040u
#define VERICAN_IFLAG1_FIFO_WARNING_SHIFT       6u
/* FIFO_AVAILABLE: A frame is at the output of the FIFO; writing 1 takes it out. */
#define VERICAN_IFLAG1_FIFO_AVAILABLE_MASK      0x00000020u
#define VERICAN_IFLAG1_FIFO_AVAILABLE_SHIFT     5u

/* CTRL2: Control 2. */
#define VERICAN_CTRL2_OFFSET                    0x034u
#define VERICAN_CTRL2_RESET                     0x00B00000u
/* WRMFRZ: Stored, without effect; all memory can be written in freeze mode. */
#define VERICAN_CTRL2_WRMFRZ_MASK               0x10000000u
#define VERICAN_CTRL2_WRMFRZ_SHIFT              28u
/* RFFN: The receive FIFO has 8 * (RFFN + 1) filter words; the first mailbox is 8 + 2 * RFFN.
   Only with Fifo. */
#define VERICAN_CTRL2_RFFN_MASK                 0x0F000000u
#define VERICAN_CTRL2_RFFN_SHIFT                24u
#define VERICAN_CTRL2_RFFN_GET(word)            (((uint32_t)(word) >> 24) & 0xFu)
#define VERICAN_CTRL2_RFFN_SET(value)           (((uint32_t)(value) & 0xFu) << 24)
/* TASD: Delay of the transmit arbitration; stored, without effect. */
#define VERICAN_CTRL2_TASD_MASK                 0x00F80000u
#define VERICAN_CTRL2_TASD_SHIFT                19u
#define VERICAN_CTRL2_TASD_GET(word)            (((uint32_t)(word) >> 19) & 0x1Fu)
#define VERICAN_CTRL2_TASD_SET(value)           (((uint32_t)(value) & 0x1Fu) << 19)
/* MRP: Looks for a receiver among the mailboxes first, then in the FIFO. Only with Fifo. */
#define VERICAN_CTRL2_MRP_MASK                  0x00040000u
#define VERICAN_CTRL2_MRP_SHIFT                 18u
/* RRS: Remote frames are stored like data frames; 0, as after reset, stores none in a mailbox
   and lets buffers with code 1010 answer them. Only with Extras. */
#define VERICAN_CTRL2_RRS_MASK                  0x00020000u
#define VERICAN_CTRL2_RRS_SHIFT                 17u
/* EACEN: Mailboxes compare IDE and RTR as bits 30 and 31 of the mask say; 0, as after reset,
   always compares IDE, whatever the mask, and never RTR: a buffer takes base or extended frames. */
#define VERICAN_CTRL2_EACEN_MASK                0x00010000u
#define VERICAN_CTRL2_EACEN_SHIFT               16u

/* ESR2: State of the transmit arbitration. Only with Status. */
#define VERICAN_ESR2_OFFSET                     0x038u
#define VERICAN_ESR2_RESET                      0x00000000u
/* LPTM: Lowest inactive buffer (IMB = 1) or the one of lowest priority. */
#define VERICAN_ESR2_LPTM_MASK                  0x007F0000u
#define VERICAN_ESR2_LPTM_SHIFT                 16u
#define VERICAN_ESR2_LPTM_GET(word)             (((uint32_t)(word) >> 16) & 0x7Fu)
#define VERICAN_ESR2_LPTM_SET(value)            (((uint32_t)(value) & 0x7Fu) << 16)
/* VPS: IMB and LPTM are up to date. */
#define VERICAN_ESR2_VPS_MASK                   0x00004000u
#define VERICAN_ESR2_VPS_SHIFT                  14u
/* IMB: There is an inactive buffer. */
#define VERICAN_ESR2_IMB_MASK                   0x00002000u
#define VERICAN_ESR2_IMB_SHIFT                  13u

/* CRCR: CRC of the last frame sent. Only with Status. */
#define VERICAN_CRCR_OFFSET                     0x044u
#define VERICAN_CRCR_RESET                      0x00000000u
/* MBCRC: Its buffer. */
#define VERICAN_CRCR_MBCRC_MASK                 0x007F0000u
#define VERICAN_CRCR_MBCRC_SHIFT                16u
#define VERICAN_CRCR_MBCRC_GET(word)            (((uint32_t)(word) >> 16) & 0x7Fu)
#define VERICAN_CRCR_MBCRC_SET(value)           (((uint32_t)(value) & 0x7Fu) << 16)
/* TXCRC: Its CRC sequence. */
#define VERICAN_CRCR_TXCRC_MASK                 0x00007FFFu
#define VERICAN_CRCR_TXCRC_SHIFT                0u
#define VERICAN_CRCR_TXCRC_GET(word)            (((uint32_t)(word) >> 0) & 0x7FFFu)
#define VERICAN_CRCR_TXCRC_SET(value)           (((uint32_t)(value) & 0x7FFFu) << 0)

/* RXFGMASK: Mask of FIFO filters without a mask of their own. Only with Fifo. */
#define VERICAN_RXFGMASK_OFFSET                 0x048u
#define VERICAN_RXFGMASK_RESET                  0xFFFFFFFFu
/* FGM: A 1 compares the bit of the filter word. */
#define VERICAN_RXFGMASK_FGM_MASK               0xFFFFFFFFu
#define VERICAN_RXFGMASK_FGM_SHIFT              0u
#define VERICAN_RXFGMASK_FGM_GET(word)          (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_RXFGMASK_FGM_SET(value)         (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* RXFIR: Filter of the frame at the FIFO's output. Only with Fifo. */
#define VERICAN_RXFIR_OFFSET                    0x04Cu
#define VERICAN_RXFIR_RESET                     0x00000000u
/* IDHIT: Number of the filter that let it in. */
#define VERICAN_RXFIR_IDHIT_MASK                0x000001FFu
#define VERICAN_RXFIR_IDHIT_SHIFT               0u
#define VERICAN_RXFIR_IDHIT_GET(word)           (((uint32_t)(word) >> 0) & 0x1FFu)
#define VERICAN_RXFIR_IDHIT_SET(value)          (((uint32_t)(value) & 0x1FFu) << 0)

/* RXIMR: Receive mask of buffer n, or of FIFO filter word n. Only with OwnMasks. */
#define VERICAN_RXIMR_OFFSET(n)                 (0x880u + 4u * (uint32_t)(n))
#define VERICAN_RXIMR_RESET                     0x00000000u
/* MI: Used with MCR.BCC = 1; a 1 compares the bit of the ID word or filter word. */
#define VERICAN_RXIMR_MI_MASK                   0xFFFFFFFFu
#define VERICAN_RXIMR_MI_SHIFT                  0u
#define VERICAN_RXIMR_MI_GET(word)              (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_RXIMR_MI_SET(value)             (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* XID: Extension: identification. */
#define VERICAN_XID_OFFSET                      0x1000u
#define VERICAN_XID_RESET                       0x5643414Eu
/* XID: The letters VCAN; tells a VeriCAN from a FlexCAN. */
#define VERICAN_XID_XID_MASK                    0xFFFFFFFFu
#define VERICAN_XID_XID_SHIFT                   0u
#define VERICAN_XID_XID_GET(word)               (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_XID_XID_SET(value)              (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* XVERSION: Extension: version of the extension page. */
#define VERICAN_XVERSION_OFFSET                 0x1004u
#define VERICAN_XVERSION_RESET                  0x00010003u
/* MAJOR: Changes when software must. */
#define VERICAN_XVERSION_MAJOR_MASK             0xFFFF0000u
#define VERICAN_XVERSION_MAJOR_SHIFT            16u
#define VERICAN_XVERSION_MAJOR_GET(word)        (((uint32_t)(word) >> 16) & 0xFFFFu)
#define VERICAN_XVERSION_MAJOR_SET(value)       (((uint32_t)(value) & 0xFFFFu) << 16)
/* MINOR: Rises with additions. Below 2, XCONFIG[31:20] is 0 although the features are there. */
#define VERICAN_XVERSION_MINOR_MASK             0x0000FFFFu
#define VERICAN_XVERSION_MINOR_SHIFT            0u
#define VERICAN_XVERSION_MINOR_GET(word)        (((uint32_t)(word) >> 0) & 0xFFFFu)
#define VERICAN_XVERSION_MINOR_SET(value)       (((uint32_t)(value) & 0xFFFFu) << 0)

/* XCONFIG: Extension: what this core has. */
#define VERICAN_XCONFIG_OFFSET                  0x1008u
/* CLEARRAM: The hard reset clears the RAM of the buffers; without, software must. Only with
   ClearRam. */
#define VERICAN_XCONFIG_CLEARRAM_MASK           0x02000000u
#define VERICAN_XCONFIG_CLEARRAM_SHIFT          25u
/* EXTRAS: Local priority, one-shot, tolerance of CAN FD frames, MAXMB, LBUF, remote answers and
   TSYN. Only with Extras. */
#define VERICAN_XCONFIG_EXTRAS_MASK             0x01000000u
#define VERICAN_XCONFIG_EXTRAS_SHIFT            24u
/* WAKE: Stop mode and waking from it. Only with Wake. */
#define VERICAN_XCONFIG_WAKE_MASK               0x00800000u
#define VERICAN_XCONFIG_WAKE_SHIFT              23u
/* STATUS: ESR2 and CRCR. Only with Status. */
#define VERICAN_XCONFIG_STATUS_MASK             0x00400000u
#define VERICAN_XCONFIG_STATUS_SHIFT            22u
/* OWNMASKS: A mask for each buffer, and the queue of several matching buffers. Only with
   OwnMasks. */
#define VERICAN_XCONFIG_OWNMASKS_MASK           0x00200000u
#define VERICAN_XCONFIG_OWNMASKS_SHIFT          21u
/* ABORT: MCR.AEN. Only with Abort. */
#define VERICAN_XCONFIG_ABORT_MASK              0x00100000u
#define VERICAN_XCONFIG_ABORT_SHIFT             20u
/* TIMESYNC: Follower of the time unit. Only with TimeSync. */
#define VERICAN_XCONFIG_TIMESYNC_MASK           0x00002000u
#define VERICAN_XCONFIG_TIMESYNC_SHIFT          13u
/* TIME: Time unit. Only with TimeUnit. */
#define VERICAN_XCONFIG_TIME_MASK               0x00001000u
#define VERICAN_XCONFIG_TIME_SHIFT              12u
/* RXFIFO: Receive FIFO. Only with Fifo. */
#define VERICAN_XCONFIG_RXFIFO_MASK             0x00000800u
#define VERICAN_XCONFIG_RXFIFO_SHIFT            11u
/* OSMB: One-shot for single buffers. Only with Extras. */
#define VERICAN_XCONFIG_OSMB_MASK               0x00000400u
#define VERICAN_XCONFIG_OSMB_SHIFT              10u
/* ONESHOT: One-shot for all buffers. Only with Extras. */
#define VERICAN_XCONFIG_ONESHOT_MASK            0x00000200u
#define VERICAN_XCONFIG_ONESHOT_SHIFT           9u
/* FDTOL: Tolerance of CAN FD frames. Only with Extras. */
#define VERICAN_XCONFIG_FDTOL_MASK              0x00000100u
#define VERICAN_XCONFIG_FDTOL_SHIFT             8u
/* NUM_MB: Number of buffers. */
#define VERICAN_XCONFIG_NUM_MB_MASK             0x000000FFu
#define VERICAN_XCONFIG_NUM_MB_SHIFT            0u
#define VERICAN_XCONFIG_NUM_MB_GET(word)        (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_XCONFIG_NUM_MB_SET(value)       (((uint32_t)(value) & 0xFFu) << 0)

/* XCTRL: Extension: control. */
#define VERICAN_XCTRL_OFFSET                    0x100Cu
#define VERICAN_XCTRL_RESET                     0x00000000u
/* OSMB: Bit 28 of the C/S word of a buffer that sends asks for one-shot. Only with Extras. */
#define VERICAN_XCTRL_OSMB_MASK                 0x00000004u
#define VERICAN_XCTRL_OSMB_SHIFT                2u
/* ONESHOT: Every frame is started once; if it fails, its buffer gets code 1001. Only with
   Extras. */
#define VERICAN_XCTRL_ONESHOT_MASK              0x00000002u
#define VERICAN_XCTRL_ONESHOT_SHIFT             1u
/* FDTOL: Sits out CAN FD frames instead of destroying them. Only with Extras. */
#define VERICAN_XCTRL_FDTOL_MASK                0x00000001u
#define VERICAN_XCTRL_FDTOL_SHIFT               0u

/* TCAP: Time: latencies of the stamps, in half clocks. Only with TimeUnit. */
#define VERICAN_TCAP_OFFSET                     0x1100u
#define VERICAN_TCAP_RESET                      0x00020003u
/* SPLAT: From the clock of a sample point to the stamp. */
#define VERICAN_TCAP_SPLAT_MASK                 0x00FF0000u
#define VERICAN_TCAP_SPLAT_SHIFT                16u
#define VERICAN_TCAP_SPLAT_GET(word)            (((uint32_t)(word) >> 16) & 0xFFu)
#define VERICAN_TCAP_SPLAT_SET(value)           (((uint32_t)(value) & 0xFFu) << 16)
/* TXLAT: From the edge of the transmit flip-flop. */
#define VERICAN_TCAP_TXLAT_MASK                 0x0000FF00u
#define VERICAN_TCAP_TXLAT_SHIFT                8u
#define VERICAN_TCAP_TXLAT_GET(word)            (((uint32_t)(word) >> 8) & 0xFFu)
#define VERICAN_TCAP_TXLAT_SET(value)           (((uint32_t)(value) & 0xFFu) << 8)
/* RXLAT: From an edge at the receive pin or external pin, on average. */
#define VERICAN_TCAP_RXLAT_MASK                 0x000000FFu
#define VERICAN_TCAP_RXLAT_SHIFT                0u
#define VERICAN_TCAP_RXLAT_GET(word)            (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_TCAP_RXLAT_SET(value)           (((uint32_t)(value) & 0xFFu) << 0)

/* TCTRL: Time: control. Only with TimeUnit. */
#define VERICAN_TCTRL_OFFSET                    0x1104u
#define VERICAN_TCTRL_RESET                     0x00000031u
/* SYNCIE: Interrupt with TSTAT.SYNC. */
#define VERICAN_TCTRL_SYNCIE_MASK               0x00100000u
#define VERICAN_TCTRL_SYNCIE_SHIFT              20u
/* TXIE: Interrupt with TSTAT.TXREL. */
#define VERICAN_TCTRL_TXIE_MASK                 0x00080000u
#define VERICAN_TCTRL_TXIE_SHIFT                19u
/* SLEWIE: Interrupt with TSTAT.SLEWD. */
#define VERICAN_TCTRL_SLEWIE_MASK               0x00040000u
#define VERICAN_TCTRL_SLEWIE_SHIFT              18u
/* CMPIE: Interrupt with TSTAT.CMP. */
#define VERICAN_TCTRL_CMPIE_MASK                0x00020000u
#define VERICAN_TCTRL_CMPIE_SHIFT               17u
/* EXTIE: Interrupt with TSTAT.EXT. */
#define VERICAN_TCTRL_EXTIE_MASK                0x00010000u
#define VERICAN_TCTRL_EXTIE_SHIFT               16u
/* CMPEN: A write of TCMP arms the compare unit; 0 disarms it. */
#define VERICAN_TCTRL_CMPEN_MASK                0x00002000u
#define VERICAN_TCTRL_CMPEN_SHIFT               13u
/* OUTEN: The output pin shows OUT; else it is 0. */
#define VERICAN_TCTRL_OUTEN_MASK                0x00001000u
#define VERICAN_TCTRL_OUTEN_SHIFT               12u
/* EXTF: Falling edges of the external pin count. */
#define VERICAN_TCTRL_EXTF_MASK                 0x00000200u
#define VERICAN_TCTRL_EXTF_SHIFT                9u
/* EXTR: Rising edges of the external pin count. */
#define VERICAN_TCTRL_EXTR_MASK                 0x00000100u
#define VERICAN_TCTRL_EXTR_SHIFT                8u
/* SLEWR: Slew 1 ns in 8192 ns (0), 4096, 2048 or 1024 ns (3). */
#define VERICAN_TCTRL_SLEWR_MASK                0x00000030u
#define VERICAN_TCTRL_SLEWR_SHIFT               4u
#define VERICAN_TCTRL_SLEWR_GET(word)           (((uint32_t)(word) >> 4) & 0x3u)
#define VERICAN_TCTRL_SLEWR_SET(value)          (((uint32_t)(value) & 0x3u) << 4)
/* TXPIN: Own frames are stamped at the own receive pin, as foreign ones are. */
#define VERICAN_TCTRL_TXPIN_MASK                0x00000004u
#define VERICAN_TCTRL_TXPIN_SHIFT               2u
/* POINT: Where a frame is stamped. Change it in freeze mode; a change holds from the next frame
   on. */
#define VERICAN_TCTRL_POINT_MASK                0x00000003u
#define VERICAN_TCTRL_POINT_SHIFT               0u
#define VERICAN_TCTRL_POINT_GET(word)           (((uint32_t)(word) >> 0) & 0x3u)
#define VERICAN_TCTRL_POINT_SET(value)          (((uint32_t)(value) & 0x3u) << 0)
#define VERICAN_TCTRL_POINT_SOF                 0x0u /* start of frame */
#define VERICAN_TCTRL_POINT_EDGE                0x1u /* reference edge */
#define VERICAN_TCTRL_POINT_EOF                 0x2u /* sample point of EOF6 */

/* TSTAT: Time: status. Only with TimeUnit. */
#define VERICAN_TSTAT_OFFSET                    0x1108u
#define VERICAN_TSTAT_RESET                     0x00000000u
/* CMPON: The compare unit is armed. */
#define VERICAN_TSTAT_CMPON_MASK                0x00080000u
#define VERICAN_TSTAT_CMPON_SHIFT               19u
/* OUT: Output of the compare unit. */
#define VERICAN_TSTAT_OUT_MASK                  0x00040000u
#define VERICAN_TSTAT_OUT_SHIFT                 18u
/* HELD: A buffer is held. */
#define VERICAN_TSTAT_HELD_MASK                 0x00020000u
#define VERICAN_TSTAT_HELD_SHIFT                17u
/* SLEWING: A slew is under way, TSLEW is not yet worked off. */
#define VERICAN_TSTAT_SLEWING_MASK              0x00010000u
#define VERICAN_TSTAT_SLEWING_SHIFT             16u
/* SYNC: The follower has changed its state. */
#define VERICAN_TSTAT_SYNC_MASK                 0x00000020u
#define VERICAN_TSTAT_SYNC_SHIFT                5u
/* TXREL: The launch time has come. */
#define VERICAN_TSTAT_TXREL_MASK                0x00000010u
#define VERICAN_TSTAT_TXREL_SHIFT               4u
/* SLEWD: TSLEW is worked off. */
#define VERICAN_TSTAT_SLEWD_MASK                0x00000008u
#define VERICAN_TSTAT_SLEWD_SHIFT               3u
/* CMP: The time in TCMP has come. */
#define VERICAN_TSTAT_CMP_MASK                  0x00000004u
#define VERICAN_TSTAT_CMP_SHIFT                 2u
/* EXTOVR: An external event came while EXT was 1. */
#define VERICAN_TSTAT_EXTOVR_MASK               0x00000002u
#define VERICAN_TSTAT_EXTOVR_SHIFT              1u
/* EXT: There was an external event; its time is in TEXTLO and TEXTHI. */
#define VERICAN_TSTAT_EXT_MASK                  0x00000001u
#define VERICAN_TSTAT_EXT_SHIFT                 0u

/* TIMELO: Time: clock, lower half. Only with TimeUnit. */
#define VERICAN_TIMELO_OFFSET                   0x1110u
#define VERICAN_TIMELO_RESET                    0x00000000u
/* TIMELO: A read takes all 64 bits of one clock, ns. A write waits for TIMEHI. */
#define VERICAN_TIMELO_TIMELO_MASK              0xFFFFFFFFu
#define VERICAN_TIMELO_TIMELO_SHIFT             0u
#define VERICAN_TIMELO_TIMELO_GET(word)         (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TIMELO_TIMELO_SET(value)        (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TIMEHI: Time: clock, upper half. Only with TimeUnit. */
#define VERICAN_TIMEHI_OFFSET                   0x1114u
#define VERICAN_TIMEHI_RESET                    0x00000000u
/* TIMEHI: Of the reading of TIMELO. A write sets the clock, the fraction to 0. */
#define VERICAN_TIMEHI_TIMEHI_MASK              0xFFFFFFFFu
#define VERICAN_TIMEHI_TIMEHI_SHIFT             0u
#define VERICAN_TIMEHI_TIMEHI_GET(word)         (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TIMEHI_TIMEHI_SET(value)        (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TINCN: Time: increment, whole ns. Only with TimeUnit. */
#define VERICAN_TINCN_OFFSET                    0x1118u
#define VERICAN_TINCN_RESET                     0x00000000u
/* TINCN: ns a clock; a write waits for TINCF. Reset: parameter TimeInc. */
#define VERICAN_TINCN_TINCN_MASK                0x000000FFu
#define VERICAN_TINCN_TINCN_SHIFT               0u
#define VERICAN_TINCN_TINCN_GET(word)           (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_TINCN_TINCN_SET(value)          (((uint32_t)(value) & 0xFFu) << 0)

/* TINCF: Time: increment, fraction. Only with TimeUnit. */
#define VERICAN_TINCF_OFFSET                    0x111Cu
#define VERICAN_TINCF_RESET                     0x00000000u
/* TINCF: 2^-32 ns a clock; a write sets both. Reset: parameter TimeInc. */
#define VERICAN_TINCF_TINCF_MASK                0xFFFFFFFFu
#define VERICAN_TINCF_TINCF_SHIFT               0u
#define VERICAN_TINCF_TINCF_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TINCF_TINCF_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TSHLO: Time: offset, lower half. Only with TimeUnit. */
#define VERICAN_TSHLO_OFFSET                    0x1120u
#define VERICAN_TSHLO_RESET                     0x00000000u
/* TSHLO: A write waits for TSHHI. */
#define VERICAN_TSHLO_TSHLO_MASK                0xFFFFFFFFu
#define VERICAN_TSHLO_TSHLO_SHIFT               0u
#define VERICAN_TSHLO_TSHLO_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TSHLO_TSHLO_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TSHHI: Time: offset, upper half. Only with TimeUnit. */
#define VERICAN_TSHHI_OFFSET                    0x1124u
#define VERICAN_TSHHI_RESET                     0x00000000u
/* TSHHI: A write adds the offset, signed ns, to the clock. */
#define VERICAN_TSHHI_TSHHI_MASK                0xFFFFFFFFu
#define VERICAN_TSHHI_TSHHI_SHIFT               0u
#define VERICAN_TSHHI_TSHHI_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TSHHI_TSHHI_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TSLEW: Time: offset that is worked off. Only with TimeUnit. */
#define VERICAN_TSLEW_OFFSET                    0x1128u
#define VERICAN_TSLEW_RESET                     0x00000000u
/* TSLEW: Signed ns, in steps of 1 ns; reads what is left. Needs TINCN of 2 at least. */
#define VERICAN_TSLEW_TSLEW_MASK                0xFFFFFFFFu
#define VERICAN_TSLEW_TSLEW_SHIFT               0u
#define VERICAN_TSLEW_TSLEW_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TSLEW_TSLEW_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TCMP: Time: next event. Only with TimeUnit. */
#define VERICAN_TCMP_OFFSET                     0x1130u
#define VERICAN_TCMP_RESET                      0x00000000u
/* TCMP: Lower half of its time, ns; with CMPEN a write arms, and clears OUT. */
#define VERICAN_TCMP_TCMP_MASK                  0xFFFFFFFFu
#define VERICAN_TCMP_TCMP_SHIFT                 0u
#define VERICAN_TCMP_TCMP_GET(word)             (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TCMP_TCMP_SET(value)            (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TCMPH: Time: period of events. Only with TimeUnit. */
#define VERICAN_TCMPH_OFFSET                    0x1134u
#define VERICAN_TCMPH_RESET                     0x00000000u
/* TCMPH: ns between events, 16 clocks at least; 0: once. */
#define VERICAN_TCMPH_TCMPH_MASK                0x7FFFFFFFu
#define VERICAN_TCMPH_TCMPH_SHIFT               0u
#define VERICAN_TCMPH_TCMPH_GET(word)           (((uint32_t)(word) >> 0) & 0x7FFFFFFFu)
#define VERICAN_TCMPH_TCMPH_SET(value)          (((uint32_t)(value) & 0x7FFFFFFFu) << 0)

/* TTX: Time: launch time. Only with TimeUnit. */
#define VERICAN_TTX_OFFSET                      0x1140u
#define VERICAN_TTX_RESET                       0x00000000u
/* TTX: Lower half, ns: at most 2^31 ns ahead. */
#define VERICAN_TTX_TTX_MASK                    0xFFFFFFFFu
#define VERICAN_TTX_TTX_SHIFT                   0u
#define VERICAN_TTX_TTX_GET(word)               (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TTX_TTX_SET(value)              (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TTXMB: Time: buffer with a launch time. Only with TimeUnit. */
#define VERICAN_TTXMB_OFFSET                    0x1144u
#define VERICAN_TTXMB_RESET                     0x00000000u
/* HOLD: The buffer gives way to all others and is not started before TTX; then HOLD clears. */
#define VERICAN_TTXMB_HOLD_MASK                 0x80000000u
#define VERICAN_TTXMB_HOLD_SHIFT                31u
/* MB: Number of the buffer. */
#define VERICAN_TTXMB_MB_MASK                   0x0000003Fu
#define VERICAN_TTXMB_MB_SHIFT                  0u
#define VERICAN_TTXMB_MB_GET(word)              (((uint32_t)(word) >> 0) & 0x3Fu)
#define VERICAN_TTXMB_MB_SET(value)             (((uint32_t)(value) & 0x3Fu) << 0)

/* TEXTLO: Time: external event, lower half. Only with TimeUnit. */
#define VERICAN_TEXTLO_OFFSET                   0x1150u
#define VERICAN_TEXTLO_RESET                    0x00000000u
/* TEXTLO: ns. */
#define VERICAN_TEXTLO_TEXTLO_MASK              0xFFFFFFFFu
#define VERICAN_TEXTLO_TEXTLO_SHIFT             0u
#define VERICAN_TEXTLO_TEXTLO_GET(word)         (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TEXTLO_TEXTLO_SET(value)        (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TEXTHI: Time: external event, upper half. Only with TimeUnit. */
#define VERICAN_TEXTHI_OFFSET                   0x1154u
#define VERICAN_TEXTHI_RESET                    0x00000000u
/* TEXTHI: Of the event whose lower half is in TEXTLO. */
#define VERICAN_TEXTHI_TEXTHI_MASK              0xFFFFFFFFu
#define VERICAN_TEXTHI_TEXTHI_SHIFT             0u
#define VERICAN_TEXTHI_TEXTHI_GET(word)         (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TEXTHI_TEXTHI_SET(value)        (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* TSCTRL: Follower: control. Only with TimeSync. */
#define VERICAN_TSCTRL_OFFSET                   0x1180u
#define VERICAN_TSCTRL_RESET                    0x00000000u
/* TMO: Without a pair for 2^TMO ns it is in holdover; above 37: never. */
#define VERICAN_TSCTRL_TMO_MASK                 0x3F000000u
#define VERICAN_TSCTRL_TMO_SHIFT                24u
#define VERICAN_TSCTRL_TMO_GET(word)            (((uint32_t)(word) >> 24) & 0x3Fu)
#define VERICAN_TSCTRL_TMO_SET(value)           (((uint32_t)(value) & 0x3Fu) << 24)
/* KD: While locked, the rate gets 2^-KD of what a pair says; at most KI. */
#define VERICAN_TSCTRL_KD_MASK                  0x00600000u
#define VERICAN_TSCTRL_KD_SHIFT                 21u
#define VERICAN_TSCTRL_KD_GET(word)             (((uint32_t)(word) >> 21) & 0x3u)
#define VERICAN_TSCTRL_KD_SET(value)            (((uint32_t)(value) & 0x3u) << 21)
/* KI: Weight of an offset in the increment: 2^KI times 2^-32 ns a clock for 1 ns. */
#define VERICAN_TSCTRL_KI_MASK                  0x001F0000u
#define VERICAN_TSCTRL_KI_SHIFT                 16u
#define VERICAN_TSCTRL_KI_GET(word)             (((uint32_t)(word) >> 16) & 0x1Fu)
#define VERICAN_TSCTRL_KI_SET(value)            (((uint32_t)(value) & 0x1Fu) << 16)
/* PPS: A step of the clock arms the compare unit with a whole second; TCMPH and CMPEN are set
   before EN. */
#define VERICAN_TSCTRL_PPS_MASK                 0x00000200u
#define VERICAN_TSCTRL_PPS_SHIFT                9u
/* PHALF: While locked, half of the offset is corrected. */
#define VERICAN_TSCTRL_PHALF_MASK               0x00000100u
#define VERICAN_TSCTRL_PHALF_SHIFT              8u
/* DOMAIN: Time domain of the messages. */
#define VERICAN_TSCTRL_DOMAIN_MASK              0x000000F0u
#define VERICAN_TSCTRL_DOMAIN_SHIFT             4u
#define VERICAN_TSCTRL_DOMAIN_GET(word)         (((uint32_t)(word) >> 4) & 0xFu)
#define VERICAN_TSCTRL_DOMAIN_SET(value)        (((uint32_t)(value) & 0xFu) << 4)
/* EN: The follower steers the clock; else it leaves it alone, unsynchronised. The reset value of
   this register is parameter SyncCtrl. */
#define VERICAN_TSCTRL_EN_MASK                  0x00000001u
#define VERICAN_TSCTRL_EN_SHIFT                 0u

/* TSID: Follower: identifier of SYNC and FUP. Only with TimeSync. */
#define VERICAN_TSID_OFFSET                     0x1184u
#define VERICAN_TSID_RESET                      0x00000000u
/* IDE: Extended. */
#define VERICAN_TSID_IDE_MASK                   0x80000000u
#define VERICAN_TSID_IDE_SHIFT                  31u
/* ID: As in an ID word: a base identifier is in 28:18, 17:0 are 0. Reset: parameter SyncId. */
#define VERICAN_TSID_ID_MASK                    0x1FFFFFFFu
#define VERICAN_TSID_ID_SHIFT                   0u
#define VERICAN_TSID_ID_GET(word)               (((uint32_t)(word) >> 0) & 0x1FFFFFFFu)
#define VERICAN_TSID_ID_SET(value)              (((uint32_t)(value) & 0x1FFFFFFFu) << 0)

/* TSDLY: Follower: delay. Only with TimeSync. */
#define VERICAN_TSDLY_OFFSET                    0x1188u
#define VERICAN_TSDLY_RESET                     0x00000000u
/* TSDLY: Signed ns from the master's event to the stamp: path and latency. Reset: parameter
   SyncDelay. */
#define VERICAN_TSDLY_TSDLY_MASK                0x00FFFFFFu
#define VERICAN_TSDLY_TSDLY_SHIFT               0u
#define VERICAN_TSDLY_TSDLY_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFu)
#define VERICAN_TSDLY_TSDLY_SET(value)          (((uint32_t)(value) & 0xFFFFFFu) << 0)

/* TSSTAT: Follower: status. Only with TimeSync. */
#define VERICAN_TSSTAT_OFFSET                   0x118Cu
#define VERICAN_TSSTAT_RESET                    0x00000000u
/* PAIRS: Pairs since the last step or holdover; stays at 255. */
#define VERICAN_TSSTAT_PAIRS_MASK               0x0000FF00u
#define VERICAN_TSSTAT_PAIRS_SHIFT              8u
#define VERICAN_TSSTAT_PAIRS_GET(word)          (((uint32_t)(word) >> 8) & 0xFFu)
#define VERICAN_TSSTAT_PAIRS_SET(value)         (((uint32_t)(value) & 0xFFu) << 8)
/* SC: Sequence counter of the last SYNC. */
#define VERICAN_TSSTAT_SC_MASK                  0x000000F0u
#define VERICAN_TSSTAT_SC_SHIFT                 4u
#define VERICAN_TSSTAT_SC_GET(word)             (((uint32_t)(word) >> 4) & 0xFu)
#define VERICAN_TSSTAT_SC_SET(value)            (((uint32_t)(value) & 0xFu) << 4)
/* STATE: State. */
#define VERICAN_TSSTAT_STATE_MASK               0x00000003u
#define VERICAN_TSSTAT_STATE_SHIFT              0u
#define VERICAN_TSSTAT_STATE_GET(word)          (((uint32_t)(word) >> 0) & 0x3u)
#define VERICAN_TSSTAT_STATE_SET(value)         (((uint32_t)(value) & 0x3u) << 0)
#define VERICAN_TSSTAT_STATE_UNSYNCHRONISED     0x0u /* no pair yet, or none of a rate set anew */
#define VERICAN_TSSTAT_STATE_ACQUIRING          0x1u /* fewer than twelve pairs */
#define VERICAN_TSSTAT_STATE_LOCKED             0x2u /* locked */
#define VERICAN_TSSTAT_STATE_HOLDOVER           0x3u /* no pair for too long */

/* TSOFS: Follower: last offset. Only with TimeSync. */
#define VERICAN_TSOFS_OFFSET                    0x1190u
#define VERICAN_TSOFS_RESET                     0x00000000u
/* TSOFS: Own time less the master's, signed ns, before it was corrected; stays at either end.
   Moves for 512 clocks behind a FUP. */
#define VERICAN_TSOFS_TSOFS_MASK                0xFFFFFFFFu
#define VERICAN_TSOFS_TSOFS_SHIFT               0u
#define VERICAN_TSOFS_TSOFS_GET(word)           (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_TSOFS_TSOFS_SET(value)          (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* STAMPLO: Time: stamp of buffer n, lower half. Only with TimeUnit. */
#define VERICAN_STAMPLO_OFFSET(n)               (0x1400u + 8u * (uint32_t)(n))
#define VERICAN_STAMPLO_RESET                   0x00000000u
/* STAMPLO: ns; of the frame that the buffer has received or sent last; n = 0 with MCR.FEN: at
   the FIFO's output. */
#define VERICAN_STAMPLO_STAMPLO_MASK            0xFFFFFFFFu
#define VERICAN_STAMPLO_STAMPLO_SHIFT           0u
#define VERICAN_STAMPLO_STAMPLO_GET(word)       (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_STAMPLO_STAMPLO_SET(value)      (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* STAMPHI: Time: stamp of buffer n, upper half. Only with TimeUnit. */
#define VERICAN_STAMPHI_OFFSET(n)               (0x1404u + 8u * (uint32_t)(n))
#define VERICAN_STAMPHI_RESET                   0x00000000u
/* STAMPHI: Of the stamp whose lower half is in STAMPLO. */
#define VERICAN_STAMPHI_STAMPHI_MASK            0xFFFFFFFFu
#define VERICAN_STAMPHI_STAMPHI_SHIFT           0u
#define VERICAN_STAMPHI_STAMPHI_GET(word)       (((uint32_t)(word) >> 0) & 0xFFFFFFFFu)
#define VERICAN_STAMPHI_STAMPHI_SET(value)      (((uint32_t)(value) & 0xFFFFFFFFu) << 0)

/* MB: Message buffer n, words CS, ID, DATA0 and DATA1. */
#define VERICAN_MB_OFFSET(n)                    (0x080u + 16u * (uint32_t)(n))
#define VERICAN_MB_STRIDE                       16u

/* CS: Code, status, length and time stamp. */
#define VERICAN_MB_CS_OFFSET(n)                 (0x080u + 16u * (uint32_t)(n))
#define VERICAN_MB_CS_RESET                     0x00000000u
/* OS: With XCTRL.OSMB, written together with code 1100, asks for one-shot. Reads 0. Only with
   Extras. */
#define VERICAN_MB_CS_OS_MASK                   0x10000000u
#define VERICAN_MB_CS_OS_SHIFT                  28u
/* CODE: What the buffer is for and what became of it. With bit 0 set a receive code is busy. */
#define VERICAN_MB_CS_CODE_MASK                 0x0F000000u
#define VERICAN_MB_CS_CODE_SHIFT                24u
#define VERICAN_MB_CS_CODE_GET(word)            (((uint32_t)(word) >> 24) & 0xFu)
#define VERICAN_MB_CS_CODE_SET(value)           (((uint32_t)(value) & 0xFu) << 24)
#define VERICAN_MB_CS_CODE_RX_INACTIVE          0x0u /* takes no part */
#define VERICAN_MB_CS_CODE_RX_FULL              0x2u /* holds a frame */
#define VERICAN_MB_CS_CODE_RX_EMPTY             0x4u /* waits for a frame, also for an answer */
#define VERICAN_MB_CS_CODE_RX_OVERRUN           0x6u /* holds a frame that replaced an unread one */
#define VERICAN_MB_CS_CODE_TX_INACTIVE          0x8u /* takes no part, as after a sent data frame */
#define VERICAN_MB_CS_CODE_TX_ABORT             0x9u /* abort; the frame was not sent */
#define VERICAN_MB_CS_CODE_TX_ANSWER            0xAu /* waits for its remote frame */
#define VERICAN_MB_CS_CODE_TX_DATA              0xCu /* send; a remote frame if RTR is set */
#define VERICAN_MB_CS_CODE_TX_ANSWERING         0xEu /* a remote frame came, the answer is sent */
/* SRR: Substitute remote request; write 1 with IDE. Reads 1 in a received base frame. */
#define VERICAN_MB_CS_SRR_MASK                  0x00400000u
#define VERICAN_MB_CS_SRR_SHIFT                 22u
/* IDE: Extended frame. */
#define VERICAN_MB_CS_IDE_MASK                  0x00200000u
#define VERICAN_MB_CS_IDE_SHIFT                 21u
/* RTR: Remote frame. */
#define VERICAN_MB_CS_RTR_MASK                  0x00100000u
#define VERICAN_MB_CS_RTR_SHIFT                 20u
/* DLC: Data length code; 9 to 15 stand for 8 bytes. */
#define VERICAN_MB_CS_DLC_MASK                  0x000F0000u
#define VERICAN_MB_CS_DLC_SHIFT                 16u
#define VERICAN_MB_CS_DLC_GET(word)             (((uint32_t)(word) >> 16) & 0xFu)
#define VERICAN_MB_CS_DLC_SET(value)            (((uint32_t)(value) & 0xFu) << 16)
/* TIME_STAMP: TIMER at the beginning of the identifier. */
#define VERICAN_MB_CS_TIME_STAMP_MASK           0x0000FFFFu
#define VERICAN_MB_CS_TIME_STAMP_SHIFT          0u
#define VERICAN_MB_CS_TIME_STAMP_GET(word)      (((uint32_t)(word) >> 0) & 0xFFFFu)
#define VERICAN_MB_CS_TIME_STAMP_SET(value)     (((uint32_t)(value) & 0xFFFFu) << 0)

/* ID: Identifier. */
#define VERICAN_MB_ID_OFFSET(n)                 (0x084u + 16u * (uint32_t)(n))
#define VERICAN_MB_ID_RESET                     0x00000000u
/* PRIO: With MCR.LPRIO_EN, the priority among the buffers that send; 0 goes first. */
#define VERICAN_MB_ID_PRIO_MASK                 0xE0000000u
#define VERICAN_MB_ID_PRIO_SHIFT                29u
#define VERICAN_MB_ID_PRIO_GET(word)            (((uint32_t)(word) >> 29) & 0x7u)
#define VERICAN_MB_ID_PRIO_SET(value)           (((uint32_t)(value) & 0x7u) << 29)
/* EXT: Identifier of an extended frame. */
#define VERICAN_MB_ID_EXT_MASK                  0x1FFFFFFFu
#define VERICAN_MB_ID_EXT_SHIFT                 0u
#define VERICAN_MB_ID_EXT_GET(word)             (((uint32_t)(word) >> 0) & 0x1FFFFFFFu)
#define VERICAN_MB_ID_EXT_SET(value)            (((uint32_t)(value) & 0x1FFFFFFFu) << 0)
/* STD: Identifier of a standard frame. */
#define VERICAN_MB_ID_STD_MASK                  0x1FFC0000u
#define VERICAN_MB_ID_STD_SHIFT                 18u
#define VERICAN_MB_ID_STD_GET(word)             (((uint32_t)(word) >> 18) & 0x7FFu)
#define VERICAN_MB_ID_STD_SET(value)            (((uint32_t)(value) & 0x7FFu) << 18)

/* DATA0: Data bytes 0 to 3. */
#define VERICAN_MB_DATA0_OFFSET(n)              (0x088u + 16u * (uint32_t)(n))
#define VERICAN_MB_DATA0_RESET                  0x00000000u
/* BYTE0: First byte of the word on the bus. */
#define VERICAN_MB_DATA0_BYTE0_MASK             0xFF000000u
#define VERICAN_MB_DATA0_BYTE0_SHIFT            24u
#define VERICAN_MB_DATA0_BYTE0_GET(word)        (((uint32_t)(word) >> 24) & 0xFFu)
#define VERICAN_MB_DATA0_BYTE0_SET(value)       (((uint32_t)(value) & 0xFFu) << 24)
/* BYTE1: Second byte. */
#define VERICAN_MB_DATA0_BYTE1_MASK             0x00FF0000u
#define VERICAN_MB_DATA0_BYTE1_SHIFT            16u
#define VERICAN_MB_DATA0_BYTE1_GET(word)        (((uint32_t)(word) >> 16) & 0xFFu)
#define VERICAN_MB_DATA0_BYTE1_SET(value)       (((uint32_t)(value) & 0xFFu) << 16)
/* BYTE2: Third byte. */
#define VERICAN_MB_DATA0_BYTE2_MASK             0x0000FF00u
#define VERICAN_MB_DATA0_BYTE2_SHIFT            8u
#define VERICAN_MB_DATA0_BYTE2_GET(word)        (((uint32_t)(word) >> 8) & 0xFFu)
#define VERICAN_MB_DATA0_BYTE2_SET(value)       (((uint32_t)(value) & 0xFFu) << 8)
/* BYTE3: Fourth byte. */
#define VERICAN_MB_DATA0_BYTE3_MASK             0x000000FFu
#define VERICAN_MB_DATA0_BYTE3_SHIFT            0u
#define VERICAN_MB_DATA0_BYTE3_GET(word)        (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_MB_DATA0_BYTE3_SET(value)       (((uint32_t)(value) & 0xFFu) << 0)

/* DATA1: Data bytes 4 to 7. */
#define VERICAN_MB_DATA1_OFFSET(n)              (0x08Cu + 16u * (uint32_t)(n))
#define VERICAN_MB_DATA1_RESET                  0x00000000u
/* BYTE0: First byte of the word on the bus. */
#define VERICAN_MB_DATA1_BYTE0_MASK             0xFF000000u
#define VERICAN_MB_DATA1_BYTE0_SHIFT            24u
#define VERICAN_MB_DATA1_BYTE0_GET(word)        (((uint32_t)(word) >> 24) & 0xFFu)
#define VERICAN_MB_DATA1_BYTE0_SET(value)       (((uint32_t)(value) & 0xFFu) << 24)
/* BYTE1: Second byte. */
#define VERICAN_MB_DATA1_BYTE1_MASK             0x00FF0000u
#define VERICAN_MB_DATA1_BYTE1_SHIFT            16u
#define VERICAN_MB_DATA1_BYTE1_GET(word)        (((uint32_t)(word) >> 16) & 0xFFu)
#define VERICAN_MB_DATA1_BYTE1_SET(value)       (((uint32_t)(value) & 0xFFu) << 16)
/* BYTE2: Third byte. */
#define VERICAN_MB_DATA1_BYTE2_MASK             0x0000FF00u
#define VERICAN_MB_DATA1_BYTE2_SHIFT            8u
#define VERICAN_MB_DATA1_BYTE2_GET(word)        (((uint32_t)(word) >> 8) & 0xFFu)
#define VERICAN_MB_DATA1_BYTE2_SET(value)       (((uint32_t)(value) & 0xFFu) << 8)
/* BYTE3: Fourth byte. */
#define VERICAN_MB_DATA1_BYTE3_MASK             0x000000FFu
#define VERICAN_MB_DATA1_BYTE3_SHIFT            0u
#define VERICAN_MB_DATA1_BYTE3_GET(word)        (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_MB_DATA1_BYTE3_SET(value)       (((uint32_t)(value) & 0xFFu) << 0)

/* Receive FIFO (MCR.FEN): filter word n, frames that fit. */
#define VERICAN_FIFO_FILTER_OFFSET(n)           (0x0E0u + 4u * (uint32_t)(n))
#define VERICAN_FIFO_DEPTH                      6u

/* FILTER_A: One whole identifier. */
/* REM: Remote frame. */
#define VERICAN_FIFO_FILTER_A_REM_MASK          0x80000000u
#define VERICAN_FIFO_FILTER_A_REM_SHIFT         31u
/* EXT: Extended frame. */
#define VERICAN_FIFO_FILTER_A_EXT_MASK          0x40000000u
#define VERICAN_FIFO_FILTER_A_EXT_SHIFT         30u
/* EXT_ID: Identifier of extended frames. */
#define VERICAN_FIFO_FILTER_A_EXT_ID_MASK       0x3FFFFFFEu
#define VERICAN_FIFO_FILTER_A_EXT_ID_SHIFT      1u
#define VERICAN_FIFO_FILTER_A_EXT_ID_GET(word)  (((uint32_t)(word) >> 1) & 0x1FFFFFFFu)
#define VERICAN_FIFO_FILTER_A_EXT_ID_SET(value) (((uint32_t)(value) & 0x1FFFFFFFu) << 1)
/* STD_ID: Identifier of standard frames. */
#define VERICAN_FIFO_FILTER_A_STD_ID_MASK       0x3FF80000u
#define VERICAN_FIFO_FILTER_A_STD_ID_SHIFT      19u
#define VERICAN_FIFO_FILTER_A_STD_ID_GET(word)  (((uint32_t)(word) >> 19) & 0x7FFu)
#define VERICAN_FIFO_FILTER_A_STD_ID_SET(value) (((uint32_t)(value) & 0x7FFu) << 19)

/* FILTER_B: Two identifiers. */
/* REM0: Remote frame. */
#define VERICAN_FIFO_FILTER_B_REM0_MASK         0x80000000u
#define VERICAN_FIFO_FILTER_B_REM0_SHIFT        31u
/* EXT0: Extended frame. */
#define VERICAN_FIFO_FILTER_B_EXT0_MASK         0x40000000u
#define VERICAN_FIFO_FILTER_B_EXT0_SHIFT        30u
/* EXT_ID0: The upper 14 bits of an extended identifier. */
#define VERICAN_FIFO_FILTER_B_EXT_ID0_MASK      0x3FFF0000u
#define VERICAN_FIFO_FILTER_B_EXT_ID0_SHIFT     16u
#define VERICAN_FIFO_FILTER_B_EXT_ID0_GET(word) (((uint32_t)(word) >> 16) & 0x3FFFu)
#define VERICAN_FIFO_FILTER_B_EXT_ID0_SET(value) (((uint32_t)(value) & 0x3FFFu) << 16)
/* REM1: Remote frame. */
#define VERICAN_FIFO_FILTER_B_REM1_MASK         0x00008000u
#define VERICAN_FIFO_FILTER_B_REM1_SHIFT        15u
/* EXT1: Extended frame. */
#define VERICAN_FIFO_FILTER_B_EXT1_MASK         0x00004000u
#define VERICAN_FIFO_FILTER_B_EXT1_SHIFT        14u
/* EXT_ID1: The upper 14 bits of an extended identifier. */
#define VERICAN_FIFO_FILTER_B_EXT_ID1_MASK      0x00003FFFu
#define VERICAN_FIFO_FILTER_B_EXT_ID1_SHIFT     0u
#define VERICAN_FIFO_FILTER_B_EXT_ID1_GET(word) (((uint32_t)(word) >> 0) & 0x3FFFu)
#define VERICAN_FIFO_FILTER_B_EXT_ID1_SET(value) (((uint32_t)(value) & 0x3FFFu) << 0)
/* STD_ID0: Standard identifier. */
#define VERICAN_FIFO_FILTER_B_STD_ID0_MASK      0x3FF80000u
#define VERICAN_FIFO_FILTER_B_STD_ID0_SHIFT     19u
#define VERICAN_FIFO_FILTER_B_STD_ID0_GET(word) (((uint32_t)(word) >> 19) & 0x7FFu)
#define VERICAN_FIFO_FILTER_B_STD_ID0_SET(value) (((uint32_t)(value) & 0x7FFu) << 19)
/* STD_ID1: Standard identifier. */
#define VERICAN_FIFO_FILTER_B_STD_ID1_MASK      0x00003FF8u
#define VERICAN_FIFO_FILTER_B_STD_ID1_SHIFT     3u
#define VERICAN_FIFO_FILTER_B_STD_ID1_GET(word) (((uint32_t)(word) >> 3) & 0x7FFu)
#define VERICAN_FIFO_FILTER_B_STD_ID1_SET(value) (((uint32_t)(value) & 0x7FFu) << 3)

/* FILTER_C: Four parts of identifiers. */
/* ID0: The upper 8 bits of an identifier. */
#define VERICAN_FIFO_FILTER_C_ID0_MASK          0xFF000000u
#define VERICAN_FIFO_FILTER_C_ID0_SHIFT         24u
#define VERICAN_FIFO_FILTER_C_ID0_GET(word)     (((uint32_t)(word) >> 24) & 0xFFu)
#define VERICAN_FIFO_FILTER_C_ID0_SET(value)    (((uint32_t)(value) & 0xFFu) << 24)
/* ID1: The upper 8 bits of an identifier. */
#define VERICAN_FIFO_FILTER_C_ID1_MASK          0x00FF0000u
#define VERICAN_FIFO_FILTER_C_ID1_SHIFT         16u
#define VERICAN_FIFO_FILTER_C_ID1_GET(word)     (((uint32_t)(word) >> 16) & 0xFFu)
#define VERICAN_FIFO_FILTER_C_ID1_SET(value)    (((uint32_t)(value) & 0xFFu) << 16)
/* ID2: The upper 8 bits of an identifier. */
#define VERICAN_FIFO_FILTER_C_ID2_MASK          0x0000FF00u
#define VERICAN_FIFO_FILTER_C_ID2_SHIFT         8u
#define VERICAN_FIFO_FILTER_C_ID2_GET(word)     (((uint32_t)(word) >> 8) & 0xFFu)
#define VERICAN_FIFO_FILTER_C_ID2_SET(value)    (((uint32_t)(value) & 0xFFu) << 8)
/* ID3: The upper 8 bits of an identifier. */
#define VERICAN_FIFO_FILTER_C_ID3_MASK          0x000000FFu
#define VERICAN_FIFO_FILTER_C_ID3_SHIFT         0u
#define VERICAN_FIFO_FILTER_C_ID3_GET(word)     (((uint32_t)(word) >> 0) & 0xFFu)
#define VERICAN_FIFO_FILTER_C_ID3_SET(value)    (((uint32_t)(value) & 0xFFu) << 0)

/* clang-format on */

#endif /* VERICAN_REGS_H */

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Offsets and bits of the register map, with the names that the simulator has for them.
#pragma once

#include <cstdint>

#include "bus/range.hpp"

#include "verican/verican_regs.h"

namespace vericansim::reg {

inline constexpr std::uint32_t kMcr = VERICAN_MCR_OFFSET;
inline constexpr std::uint32_t kCtrl = VERICAN_CTRL1_OFFSET;
inline constexpr std::uint32_t kTimer = VERICAN_TIMER_OFFSET;
inline constexpr std::uint32_t kRxgmask = VERICAN_RXGMASK_OFFSET;
inline constexpr std::uint32_t kRx14mask = VERICAN_RX14MASK_OFFSET;
inline constexpr std::uint32_t kRx15mask = VERICAN_RX15MASK_OFFSET;
inline constexpr std::uint32_t kEcr = VERICAN_ECR_OFFSET;
inline constexpr std::uint32_t kEsr = VERICAN_ESR1_OFFSET;
inline constexpr std::uint32_t kImask2 = VERICAN_IMASK2_OFFSET;
inline constexpr std::uint32_t kImask1 = VERICAN_IMASK1_OFFSET;
inline constexpr std::uint32_t kIflag2 = VERICAN_IFLAG2_OFFSET;
inline constexpr std::uint32_t kIflag1 = VERICAN_IFLAG1_OFFSET;
inline constexpr std::uint32_t kCtrl2 = VERICAN_CTRL2_OFFSET;
inline constexpr std::uint32_t kRxfgmask = VERICAN_RXFGMASK_OFFSET;
inline constexpr std::uint32_t kRxfir = VERICAN_RXFIR_OFFSET;
inline constexpr std::uint32_t kExtControl = VERICAN_XCTRL_OFFSET;

// These throw std::invalid_argument if a number is out of range.

/// Word 0..3 (C/S, ID, data, data) of message buffer n, 0..63; mb(64) is the end of the buffers.
constexpr std::uint32_t mb(unsigned n, unsigned word = 0) {
  require_range("message buffer", n, 0, word == 0 ? 64 : 63);
  require_range("word of a message buffer", word, 0, 3);
  return VERICAN_MB_OFFSET(n) + 4 * word;
}
/// Mask of buffer n, 0..63; rximr(64) is their end.
constexpr std::uint32_t rximr(unsigned n) {
  require_range("mask register RXIMR", n, 0, 64);
  return VERICAN_RXIMR_OFFSET(n);
}

inline constexpr std::uint32_t kMcrMdis = VERICAN_MCR_MDIS_MASK;
inline constexpr std::uint32_t kMcrFrz = VERICAN_MCR_FRZ_MASK;
inline constexpr std::uint32_t kMcrFen = VERICAN_MCR_FEN_MASK;
inline constexpr std::uint32_t kMcrHalt = VERICAN_MCR_HALT_MASK;
inline constexpr std::uint32_t kMcrSoftRst = VERICAN_MCR_SOFT_RST_MASK;
inline constexpr std::uint32_t kMcrFrzAck = VERICAN_MCR_FRZ_ACK_MASK;
inline constexpr std::uint32_t kMcrSupv = VERICAN_MCR_SUPV_MASK;
inline constexpr std::uint32_t kMcrWrnEn = VERICAN_MCR_WRN_EN_MASK;
inline constexpr std::uint32_t kMcrLpmAck = VERICAN_MCR_LPM_ACK_MASK;
inline constexpr std::uint32_t kMcrSrxDis = VERICAN_MCR_SRX_DIS_MASK;
inline constexpr std::uint32_t kMcrBcc = VERICAN_MCR_BCC_MASK;

/// MCR.IDAM: format of the filter table, 0 A to 3 D.
constexpr std::uint32_t mcr_idam(unsigned format) {
  require_range("MCR.IDAM", format, 0, 3);
  return VERICAN_MCR_IDAM_SET(format);
}

inline constexpr std::uint32_t kCtrlBoffMsk = VERICAN_CTRL1_BOFF_MSK_MASK;
inline constexpr std::uint32_t kCtrlErrMsk = VERICAN_CTRL1_ERR_MSK_MASK;
inline constexpr std::uint32_t kCtrlLpb = VERICAN_CTRL1_LPB_MASK;
inline constexpr std::uint32_t kCtrlSmp = VERICAN_CTRL1_SMP_MASK;
inline constexpr std::uint32_t kCtrlBoffRec = VERICAN_CTRL1_BOFF_REC_MASK;
inline constexpr std::uint32_t kCtrlLbuf = VERICAN_CTRL1_LBUF_MASK;
inline constexpr std::uint32_t kCtrlLom = VERICAN_CTRL1_LOM_MASK;

inline constexpr std::uint32_t kCtrl2Eacen = VERICAN_CTRL2_EACEN_MASK;
inline constexpr std::uint32_t kCtrl2Rrs = VERICAN_CTRL2_RRS_MASK;

inline constexpr std::uint32_t kCtrl2Mrp = VERICAN_CTRL2_MRP_MASK;
/// CTRL2.RFFN, 0..15: 8 x (n + 1) words of filter table.
constexpr std::uint32_t ctrl2_rffn(unsigned n) {
  require_range("CTRL2.RFFN", n, 0, 15);
  return VERICAN_CTRL2_RFFN_SET(n);
}
/// Word n, 0..127, of the filter table of the Rx FIFO.
constexpr std::uint32_t filter(unsigned n) {
  require_range("word of the filter table", n, 0, 127);
  return VERICAN_FIFO_FILTER_OFFSET(n);
}

inline constexpr std::uint32_t kIflagFifo =
    VERICAN_IFLAG1_FIFO_AVAILABLE_MASK;  ///< a frame is at the output
inline constexpr std::uint32_t kIflagFifoWarn = VERICAN_IFLAG1_FIFO_WARNING_MASK;  ///< 5 frames
inline constexpr std::uint32_t kIflagFifoOvf =
    VERICAN_IFLAG1_FIFO_OVERFLOW_MASK;  ///< a frame was lost

inline constexpr std::uint32_t kEsrBoffInt = VERICAN_ESR1_BOFF_INT_MASK;
inline constexpr std::uint32_t kEsrErrInt = VERICAN_ESR1_ERR_INT_MASK;
inline constexpr std::uint32_t kEsrInterrupts = 0x00030006;  ///< the W1C bits

inline constexpr std::uint32_t kCsIde = VERICAN_MB_CS_IDE_MASK;
inline constexpr std::uint32_t kCsRtr = VERICAN_MB_CS_RTR_MASK;
inline constexpr std::uint32_t kCsSrr = VERICAN_MB_CS_SRR_MASK;
inline constexpr std::uint32_t kCodeRxEmpty = VERICAN_MB_CS_CODE_SET(VERICAN_MB_CS_CODE_RX_EMPTY);
inline constexpr std::uint32_t kCodeRxBusy = VERICAN_MB_CS_CODE_SET(1);  ///< with a receive code
inline constexpr std::uint32_t kCodeRxOverrun =
    VERICAN_MB_CS_CODE_SET(VERICAN_MB_CS_CODE_RX_OVERRUN);
inline constexpr std::uint32_t kCodeTxInactive =
    VERICAN_MB_CS_CODE_SET(VERICAN_MB_CS_CODE_TX_INACTIVE);
inline constexpr std::uint32_t kCodeTxData = VERICAN_MB_CS_CODE_SET(VERICAN_MB_CS_CODE_TX_DATA);
inline constexpr std::uint32_t kCodeMask = VERICAN_MB_CS_CODE_MASK;

}  // namespace vericansim::reg

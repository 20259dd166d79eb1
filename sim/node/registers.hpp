// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Offsets and bits of the register map that Host uses (flexcan.md section 1).
#pragma once

#include <cstdint>

namespace vericansim::reg {

inline constexpr std::uint32_t kMcr = 0x000;
inline constexpr std::uint32_t kCtrl = 0x004;
inline constexpr std::uint32_t kTimer = 0x008;
inline constexpr std::uint32_t kRxgmask = 0x010;
inline constexpr std::uint32_t kRx14mask = 0x014;
inline constexpr std::uint32_t kRx15mask = 0x018;
inline constexpr std::uint32_t kEcr = 0x01C;
inline constexpr std::uint32_t kEsr = 0x020;
inline constexpr std::uint32_t kImask2 = 0x024;
inline constexpr std::uint32_t kImask1 = 0x028;
inline constexpr std::uint32_t kIflag2 = 0x02C;
inline constexpr std::uint32_t kIflag1 = 0x030;
inline constexpr std::uint32_t kCtrl2 = 0x034;
inline constexpr std::uint32_t kRxfgmask = 0x048;
inline constexpr std::uint32_t kRxfir = 0x04C;
inline constexpr std::uint32_t kExtControl = 0x100C;

/// Word 0..3 (C/S, ID, data, data) of message buffer n.
constexpr std::uint32_t mb(unsigned n, unsigned word = 0) { return 0x080 + 16 * n + 4 * word; }
constexpr std::uint32_t rximr(unsigned n) { return 0x880 + 4 * n; }

inline constexpr std::uint32_t kMcrMdis = 1u << 31;
inline constexpr std::uint32_t kMcrFrz = 1u << 30;
inline constexpr std::uint32_t kMcrFen = 1u << 29;
inline constexpr std::uint32_t kMcrHalt = 1u << 28;
inline constexpr std::uint32_t kMcrSoftRst = 1u << 25;
inline constexpr std::uint32_t kMcrFrzAck = 1u << 24;
inline constexpr std::uint32_t kMcrSupv = 1u << 23;
inline constexpr std::uint32_t kMcrWrnEn = 1u << 21;
inline constexpr std::uint32_t kMcrLpmAck = 1u << 20;
inline constexpr std::uint32_t kMcrSrxDis = 1u << 17;
inline constexpr std::uint32_t kMcrBcc = 1u << 16;

/// MCR.IDAM: format of the filter table, 0 A to 3 D.
constexpr std::uint32_t mcr_idam(unsigned format) { return format << 8; }

inline constexpr std::uint32_t kCtrlBoffMsk = 1u << 15;
inline constexpr std::uint32_t kCtrlErrMsk = 1u << 14;
inline constexpr std::uint32_t kCtrlLpb = 1u << 12;
inline constexpr std::uint32_t kCtrlSmp = 1u << 7;
inline constexpr std::uint32_t kCtrlBoffRec = 1u << 6;
inline constexpr std::uint32_t kCtrlLbuf = 1u << 4;
inline constexpr std::uint32_t kCtrlLom = 1u << 3;

inline constexpr std::uint32_t kCtrl2Eacen = 1u << 16;
inline constexpr std::uint32_t kCtrl2Rrs = 1u << 17;

inline constexpr std::uint32_t kCtrl2Mrp = 1u << 18;
/// CTRL2.RFFN: 8 x (n + 1) words of filter table.
constexpr std::uint32_t ctrl2_rffn(unsigned n) { return n << 24; }
/// Word n of the filter table of the Rx FIFO.
constexpr std::uint32_t filter(unsigned n) { return 0x0E0 + 4 * n; }

inline constexpr std::uint32_t kIflagFifo = 1u << 5;      ///< a frame is at the output
inline constexpr std::uint32_t kIflagFifoWarn = 1u << 6;  ///< 5 frames
inline constexpr std::uint32_t kIflagFifoOvf = 1u << 7;   ///< a frame was lost

inline constexpr std::uint32_t kEsrBoffInt = 1u << 2;
inline constexpr std::uint32_t kEsrErrInt = 1u << 1;
inline constexpr std::uint32_t kEsrInterrupts = 0x00030006;  ///< the W1C bits

inline constexpr std::uint32_t kCsIde = 1u << 21;
inline constexpr std::uint32_t kCsRtr = 1u << 20;
inline constexpr std::uint32_t kCsSrr = 1u << 22;
inline constexpr std::uint32_t kCodeRxEmpty = 0x4u << 24;
inline constexpr std::uint32_t kCodeRxBusy = 0x1u << 24;
inline constexpr std::uint32_t kCodeRxOverrun = 0x6u << 24;
inline constexpr std::uint32_t kCodeTxInactive = 0x8u << 24;
inline constexpr std::uint32_t kCodeTxData = 0xCu << 24;
inline constexpr std::uint32_t kCodeMask = 0xFu << 24;

}  // namespace vericansim::reg

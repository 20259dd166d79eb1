// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What SoftDriver makes of the buffers and registers.
#pragma once

#include <cstdint>

#include "model/registers.hpp"

namespace vericansim::driver_map {

inline constexpr unsigned kBuffers = 64;
inline constexpr unsigned kFilters = 8;   ///< elements of the filter table: buffers 6 and 7
inline constexpr unsigned kFirstRx = 8;   ///< mailboxes for base frames
inline constexpr unsigned kFirstTx = 40;  ///< transmit buffers
inline constexpr unsigned kEndTx = 48;    ///< from here on: unused

/// MCR while all is well, with FRZ: FIFO, queue, AEN, warnings, no own frames.
inline constexpr std::uint32_t kMode =
    reg::kMcrSupv | reg::kMcrWrnEn | reg::kMcrFen | reg::kMcrBcc | reg::kMcrSrxDis |
    VERICAN_MCR_AEN_MASK | VERICAN_MCR_IDAM_SET(VERICAN_MCR_IDAM_FORMAT_A) | (kBuffers - 1);
/// CTRL1 beside the bit timing: all interrupts, recovery by itself.
inline constexpr std::uint32_t kCtrlBits = reg::kCtrlBoffMsk | reg::kCtrlErrMsk |
                                           VERICAN_CTRL1_TWRN_MSK_MASK |
                                           VERICAN_CTRL1_RWRN_MSK_MASK;
inline constexpr std::uint32_t kCtrl2 = reg::kCtrl2Eacen | reg::kCtrl2Rrs;
/// Filter element and its mask: any frame that is extended.
inline constexpr std::uint32_t kFilterExtended = 1u << 30;
/// Mask of a mailbox: any base frame, data or remote.
inline constexpr std::uint32_t kMaskFormat = 1u << 30;
/// Whether the core has the time unit: the clock makes pulses, and some frames have a launch time.
#ifdef SOFTERROR_TIME
inline constexpr bool kTimeUnit = true;
#else
inline constexpr bool kTimeUnit = false;
#endif
inline constexpr unsigned kLaunchEvery = 3;        ///< frames
inline constexpr std::uint32_t kLaunchIn = 8'000;  ///< ns: 400 clocks
/// TCTRL: reference edge, slowest slew, compare unit and its output.
inline constexpr std::uint32_t kTctrl = VERICAN_TCTRL_POINT_SET(VERICAN_TCTRL_POINT_EDGE) |
                                        VERICAN_TCTRL_SLEWR_SET(3) | VERICAN_TCTRL_OUTEN_MASK |
                                        VERICAN_TCTRL_CMPEN_MASK;
inline constexpr std::uint32_t kPulse = 100'000;  ///< ns
inline constexpr std::uint32_t kCodeAbort = VERICAN_MB_CS_CODE_SET(0x9);

}  // namespace vericansim::driver_map

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What fits where: acceptance of a frame by mailboxes and by the FIFO filter, and the order of
// buffers that want to send, as tables of the register specification (flexcan.md 3.3, 3.5, 4).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/frame.hpp"

namespace vericansim {

/// The configuration that the buffers depend on; everything is written in freeze mode.
struct BufferConfig {
  unsigned num_mb = 64;   ///< 16, 32 or 64
  unsigned maxmb = 63;    ///< MCR.MAXMB, 0..127
  bool bcc = true;        ///< MCR.BCC: individual masks and reception queue
  bool srx_dis = true;    ///< MCR.SRX_DIS: own frames are not received
  bool aen = false;       ///< MCR.AEN
  bool lprio_en = false;  ///< MCR.LPRIO_EN
  bool fen = false;       ///< MCR.FEN: receive FIFO
  unsigned idam = 0;      ///< MCR.IDAM: 0..3 = format A..D
  bool lbuf = false;      ///< CTRL1.LBUF
  bool eacen = false;     ///< CTRL2.EACEN
  bool rrs = false;       ///< CTRL2.RRS
  bool mrp = false;       ///< CTRL2.MRP
  unsigned rffn = 0;      ///< CTRL2.RFFN: 0..15
  bool one_shot = false;  ///< XCTRL.ONESHOT: for all buffers
  bool osmb = false;      ///< XCTRL.OSMB: C/S bit 28 asks for one-shot

  /// Throws std::invalid_argument if a number is out of range.
  void validate() const;
  /// First buffer that is a mailbox.
  [[nodiscard]] unsigned first_mailbox() const { return fen ? 8 + 2 * rffn : 0; }
  [[nodiscard]] unsigned filter_elements() const { return 8 * (rffn + 1); }
  /// Whether buffer `mb` takes part in matching and arbitration.
  [[nodiscard]] bool takes_part(unsigned mb) const { return mb >= first_mailbox() && mb <= maxmb; }
};

/// The mask registers.
struct BufferMasks {
  std::uint32_t global = 0xFFFFFFFF;                                       ///< RXGMASK
  std::uint32_t mb14 = 0xFFFFFFFF;                                         ///< RX14MASK
  std::uint32_t mb15 = 0xFFFFFFFF;                                         ///< RX15MASK
  std::uint32_t fifo = 0xFFFFFFFF;                                         ///< RXFGMASK
  std::vector<std::uint32_t> individual = std::vector<std::uint32_t>(64);  ///< RXIMR

  [[nodiscard]] std::uint32_t of_mailbox(unsigned mb, bool bcc) const;
  [[nodiscard]] std::uint32_t of_element(unsigned element, const BufferConfig &config) const;
};

/// C/S fields.
inline constexpr std::uint32_t kCsStored = 0x0F7FFFFF;  ///< bits that exist (31:28 and 23 read 0)
constexpr unsigned cs_code(std::uint32_t cs) { return (cs >> 24) & 0xF; }
constexpr bool cs_ide(std::uint32_t cs) { return ((cs >> 21) & 1) != 0; }
constexpr bool cs_rtr(std::uint32_t cs) { return ((cs >> 20) & 1) != 0; }

/// Codes (3.2).
enum BufferCode : unsigned {
  kRxFull = 0b0010,
  kRxEmpty = 0b0100,
  kRxOverrun = 0b0110,
  kTxInactive = 0b1000,
  kTxAbort = 0b1001,
  kTxAnswerWaits = 0b1010,
  kTxActive = 0b1100,
  kTxAnswer = 0b1110,
};
constexpr bool code_receives(unsigned code) {
  return code == kRxFull || code == kRxEmpty || code == kRxOverrun;
}
constexpr bool code_sends(unsigned code) { return code == kTxActive || code == kTxAnswer; }

// These throw as Frame::validate() does for a frame that cannot be.

/// A row of the table in 3.5: does the mailbox accept the frame for storing?
[[nodiscard]] bool mailbox_accepts(const Frame &frame, std::uint32_t cs, std::uint32_t id,
                                   std::uint32_t mask, const BufferConfig &config);
/// Does the waiting answer (1010) belong to this remote frame?
[[nodiscard]] bool answer_fits(const Frame &frame, std::uint32_t cs, std::uint32_t id,
                               const BufferConfig &config);
/// The filter that accepts the frame, as IDHIT numbers it (format A: element, B: half, C: byte).
/// `table` holds filter_elements() words.
[[nodiscard]] std::optional<unsigned> fifo_accepts(const Frame &frame,
                                                   std::span<const std::uint32_t> table,
                                                   const BufferMasks &masks,
                                                   const BufferConfig &config);

/// What a transmit buffer holds.
[[nodiscard]] Frame buffer_frame(std::span<const std::uint32_t, 4> words);
/// Order among buffers that want to send: the smaller value goes first (3.3).
[[nodiscard]] std::uint64_t arbitration_value(unsigned mb, std::uint32_t cs, std::uint32_t id,
                                              const BufferConfig &config);

}  // namespace vericansim

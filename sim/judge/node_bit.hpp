// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeBit: one bit of one node as the judges look at it.
#pragma once

#include "bus/trace.hpp"

namespace vericansim {

/// One bit of one node: what it sent and saw at its sample point, and what followed from that.
struct NodeBit {
  Level tx = Level::kRecessive;          ///< level at the TX pin
  Level sent_level = Level::kRecessive;  ///< the same before listen-only and loop-back gate it
  Level rx = Level::kRecessive;          ///< level as sampled
  Field field = Field::kInteg;
  unsigned left = 0;  ///< bits of the field that follow
  bool stuff = false;
  bool transmitter = false;  ///< role in that bit
  std::uint8_t errors = 0;   ///< TraceError bits raised by this bit
  bool started = false;      ///< the next bit is ID28 or the node's own SOF
  bool delivered = false;    ///< rx_valid: VA-01 (own frames too)
  bool sent = false;         ///< tx_ok: VA-02
  bool failed = false;       ///< tx_fail
  unsigned tec = 0;          ///< after this bit; recovery sequences in bus-off
  unsigned rec = 0;
  bool passive = false;
  bool bus_off = false;
};

/// The bit of a record; `pin` is the level of the TX pin at the sample point.
[[nodiscard]] inline NodeBit node_bit(const BitRecord &record, Level pin) {
  const Trace &at = record.at;
  const Trace &after = record.after;
  return {.tx = pin,
          .sent_level = at.tx,
          .rx = at.rx,
          .field = at.field,
          .left = at.left,
          .stuff = at.stuff,
          .transmitter = at.transmitter,
          .errors = after.errors,
          .started = after.start,
          .delivered = after.rx_valid,
          .sent = after.tx_ok,
          .failed = after.tx_fail,
          .tec = after.tec,
          .rec = after.rec,
          .passive = after.passive,
          .bus_off = after.bus_off};
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TxRig: see tx_rig.hpp.
#include "mailbox/tx_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kOccupier = 20;  // its buffers: this one and the next in turn

}  // namespace

TxRig::TxRig(unsigned nodes, const RigConfig &config) : MailboxRig{nodes} {
  for (unsigned n = 0; n < nodes; ++n) configure(n, n == 0 ? config : RigConfig{});
  for (unsigned n = 1; n < nodes; ++n) {
    write(n, reg::kCtrl2, reg::kCtrl2Eacen | reg::kCtrl2Rrs);
    put_rx(n, 1, {.id = 0}, 0);
  }
}

void TxRig::join() {
  for (unsigned n = node_count(); n-- > 0;) go(n);
}

void TxRig::count() {
  const Trace trace = decode_trace(node(0).trace());
  starts_ += trace.start && trace.transmitter;
  sent_ += trace.tx_ok;
  failed_ += trace.tx_fail;
  if (occupied_) occupy_next();
}

// The next frame is there before this one ends: between frames there are three bits.
void TxRig::occupy_next() {
  const Trace trace = decode_trace(node(1).trace());
  const bool sending = trace.transmitter && trace.field == Field::kData;
  if (!sending || next_armed_) {
    next_armed_ = sending;
    return;
  }
  next_armed_ = true;
  next_ ^= 1;
  node(1).master().submit({.address = reg::mb(kOccupier + next_),
                           .write = true,
                           .data = reg::kCodeTxData | (8u << 16)});
}

void TxRig::watch(unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) {
    run(1);
    count();
  }
}

void TxRig::write_watched(std::uint32_t address, std::uint32_t data) {
  const auto ticket = node(0).master().submit(
      {.address = address, .write = true, .size = AhbSize::kWord, .data = data});
  while (!node(0).master().done(ticket)) watch(1);
}

bool TxRig::watch_flag(unsigned mb, unsigned clocks) {
  for (unsigned i = 0; i < clocks; i += 2) {
    const auto ticket = node(0).master().submit({.address = mb < 32 ? reg::kIflag1 : reg::kIflag2});
    while (!node(0).master().done(ticket)) watch(1);
    if (((node(0).master().result(ticket).data >> (mb % 32)) & 1) != 0) return true;
  }
  return false;
}

unsigned TxRig::code(unsigned mb) {
  const auto ticket = node(0).master().submit({.address = reg::mb(mb)});
  while (!node(0).master().done(ticket)) watch(1);
  return (node(0).master().result(ticket).data >> 24) & 0xF;
}

void TxRig::occupy(bool on) {
  occupied_ = on;
  if (on) {
    next_armed_ = false;
    next_ = 0;
    for (const unsigned word : {1u, 2u, 3u}) write(1, reg::mb(kOccupier + 1, word), 0);
    put_tx(1, kOccupier, {.id = 0, .dlc = 8});
  } else if (next_armed_) {
    write(1, reg::mb(kOccupier + next_), 8u << 24);
  }
}

MbWords TxRig::received() {
  const MbWords words = get(1, 1);
  write(1, reg::mb(1), 0);
  write(1, reg::mb(1), reg::kCodeRxEmpty);
  clear_flag(1, 1);
  return words;
}

}  // namespace vericansim

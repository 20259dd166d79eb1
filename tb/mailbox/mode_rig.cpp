// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ModeRig: see mode_rig.hpp.
#include "mailbox/mode_rig.hpp"

#include <algorithm>

namespace vericansim {

std::string to_string(Leave how) {
  switch (how) {
    case Leave::kFreeze: return "Freeze";
    case Leave::kDisable: return "Disable";
    case Leave::kSoftReset: return "SoftReset";
    default: return "Stop";
  }
}

ModeRig::ModeRig(std::uint32_t subject_ctrl) : rig_{3, 16} {
  for (unsigned n = 0; n < 3; ++n) {
    rig_.configure(n, {.ctrl = n == kSubject ? subject_ctrl : kTiming8});
    rig_.put_rx(n, kRxMb, {.id = 0x100}, 0);
  }
  for (unsigned n = 0; n < 3; ++n) rig_.go(n);
}

void ModeRig::run(unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) {
    rig_.run(1);
    for (unsigned n = 0; n < 3; ++n)
      valid_[n] += decode_trace(rig_.node(n).trace() & kTraceEvents).rx_valid;
    dominant_ += rig_.node(kSubject).tx() == Level::kDominant;
    ++since_ask_;
  }
}

bool ModeRig::run_until(const std::function<bool()> &done, unsigned clocks) {
  for (unsigned i = 0; i < clocks && !done(); ++i) run(1);
  return done();
}

void ModeRig::ask(Leave how) {
  since_ask_ = 0;
  const auto mcr = [this](std::uint32_t value) {
    rig_.node(kSubject).master().submit({.address = reg::kMcr, .write = true, .data = value});
  };
  switch (how) {
    case Leave::kFreeze: mcr(kRunMcr | reg::kMcrFrz | reg::kMcrHalt); break;
    case Leave::kDisable: mcr(kRunMcr | reg::kMcrMdis); break;
    case Leave::kSoftReset: mcr(reg::kMcrSoftRst); break;
    case Leave::kStop: rig_.node(kSubject).request_stop(true); break;
  }
}

unsigned ModeRig::left(Leave how, unsigned limit) {
  const bool frozen = how == Leave::kFreeze || how == Leave::kSoftReset;
  const std::uint32_t want = frozen ? reg::kMcrFrzAck : reg::kMcrLpmAck;
  constexpr std::uint32_t kMask = reg::kMcrFrzAck | reg::kMcrLpmAck | reg::kMcrSoftRst;
  while (since_ask_ < limit)
    if ((read(reg::kMcr) & kMask) == want) return since_ask_;
  return limit;
}

void ModeRig::come_back(Leave how) {
  if (how == Leave::kStop) {
    rig_.node(kSubject).request_stop(false);
  } else {
    access({.address = reg::kMcr, .write = true, .data = kRunMcr});
  }
}

bool ModeRig::quiet(unsigned limit) {
  unsigned idle = 0;
  for (unsigned i = 0; i < limit && idle < 12 * kBit; ++i) {
    run(1);
    bool all = true;
    for (unsigned n = 0; n < 3; ++n) all &= rig_.field(n) == Field::kIdle;
    idle = all ? idle + 1 : 0;
  }
  return idle >= 12 * kBit;
}

std::uint32_t ModeRig::access(const AhbTransfer &transfer) {
  const BusMaster::Ticket ticket = rig_.node(kSubject).master().submit(transfer);
  while (!rig_.node(kSubject).master().done(ticket)) run(1);
  return rig_.node(kSubject).master().result(ticket).data;
}

void ModeRig::clear_counts() {
  std::fill(std::begin(valid_), std::end(valid_), 0u);
  dominant_ = 0;
}

}  // namespace vericansim

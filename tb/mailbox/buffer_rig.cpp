// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferRig: see buffer_rig.hpp. Its clock-by-clock part is in buffer_rig_step.cpp.
#include "mailbox/buffer_rig.hpp"

#include <algorithm>
#include <stdexcept>

namespace vericansim {

std::uint32_t mcr_of(const BufferConfig &config) {
  std::uint32_t mcr = reg::kMcrWrnEn | (config.idam << 8) | config.maxmb;
  if (config.bcc) mcr |= reg::kMcrBcc;
  if (config.srx_dis) mcr |= reg::kMcrSrxDis;
  if (config.aen) mcr |= reg::kMcrAen;
  if (config.lprio_en) mcr |= reg::kMcrLprioEn;
  if (config.fen) mcr |= reg::kMcrFen;
  return mcr;
}

std::uint32_t ctrl_of(const BufferConfig &config) {
  return kTiming8 | (config.lbuf ? reg::kCtrlLbuf : 0);
}

std::uint32_t ctrl2_of(const BufferConfig &config) {
  std::uint32_t ctrl2 = 0x00B00000 | (config.rffn << 24);
  if (config.eacen) ctrl2 |= reg::kCtrl2Eacen;
  if (config.rrs) ctrl2 |= reg::kCtrl2Rrs;
  if (config.mrp) ctrl2 |= 1u << 18;
  return ctrl2;
}

std::uint32_t xctrl_of(const BufferConfig &config) {
  return (config.one_shot ? reg::kXctrlOneShot : 0) | (config.osmb ? reg::kXctrlOsmb : 0);
}

BufferRig::BufferRig(const BufferConfig &config, const CoreBuild &listed,
                     const BufferWindows &windows)
    : BufferRig{config, windows, build_of_test(listed)} {}

BufferRig::BufferRig(const BufferConfig &config, const BufferWindows &windows,
                     const CoreBuild &build)
    : model{config, windows},
      node_{make_node("core", build)},
      wave_{std::vector<const Node *>{node_.get()}} {
  peer_.preset_idle();
  run(300);  // until the buffer RAM is cleared
  write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt);
  if (!run_until([&] { return (read(reg::kMcr) & reg::kMcrFrzAck) != 0; }, 1000))
    throw std::runtime_error("no freeze mode after reset");
  configure(config);
  for (unsigned mb = 0; mb < config.num_mb; ++mb) write(reg::rximr(mb), 0xFFFFFFFF);
  if (build.features.clear_ram) return;
  for (unsigned mb = 0; mb < config.num_mb; ++mb) put(mb, {});
  for (std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask, reg::kRxfgmask})
    write(mask, 0xFFFFFFFF);
}

std::uint32_t BufferRig::read(std::uint32_t address) { return access({.address = address}).data; }

void BufferRig::write(std::uint32_t address, std::uint32_t data) {
  access({.address = address, .write = true, .data = data});
}

void BufferRig::write(std::uint32_t address, AhbSize size, std::uint32_t data) {
  access({.address = address, .write = true, .size = size, .data = data});
}

AhbResult BufferRig::access(const AhbTransfer &transfer) {
  const BusMaster::Ticket ticket = node_->master().submit(transfer);
  under_way_.emplace_back(ticket, transfer);
  while (!node_->master().done(ticket)) step();
  return node_->master().result(ticket);
}

std::uint32_t BufferRig::read_cs(unsigned mb) {
  const std::uint64_t limit = clock_ + 200;  // a code that the CPU wrote may look like BUSY
  for (;;) {
    const std::uint32_t cs = read(reg::mb(mb));
    if (((cs >> 24) & 9) != 1 || clock_ > limit) return cs;
  }
}

void BufferRig::put(unsigned mb, const MbWords &words) {
  write(reg::mb(mb, 2), words.low);
  write(reg::mb(mb, 3), words.high);
  write(reg::mb(mb, 1), words.id);
  write(reg::mb(mb, 0), words.cs);
}

void BufferRig::put_rx(unsigned mb, const Frame &like, unsigned code) {
  MbWords words = mb_words(like, code);
  words.cs &= reg::kCodeMask | reg::kCsIde | reg::kCsRtr;
  write(reg::mb(mb, 1), words.id);
  write(reg::mb(mb, 0), words.cs);
}

void BufferRig::configure(const BufferConfig &config) {
  const bool frozen = (read(reg::kMcr) & reg::kMcrFrzAck) != 0;
  if (!frozen && !freeze()) throw std::runtime_error("no freeze mode");
  write(reg::kMcr, mcr_of(config) | reg::kMcrFrz | reg::kMcrHalt);
  write(reg::kCtrl, ctrl_of(config));
  write(reg::kCtrl2, ctrl2_of(config));
  write(reg::kExtControl, xctrl_of(config));
  tell_model(true);
  model.configure(config);
  if (!frozen) go();
}

void BufferRig::go() {
  write(reg::kMcr, mcr_of(config()));
  const auto integrated = [&] {
    const Trace trace = decode_trace(node_->trace());
    return trace.running && trace.field != Field::kInteg;
  };
  if (!run_until(integrated, 4000)) throw std::runtime_error("the core does not integrate");
}

bool BufferRig::freeze(unsigned clocks) {
  write(reg::kMcr, mcr_of(config()) | reg::kMcrFrz | reg::kMcrHalt);
  return run_until([&] { return (read(reg::kMcr) & reg::kMcrFrzAck) != 0; }, clocks);
}

void BufferRig::soft_reset() {
  write(reg::kMcr, reg::kMcrSoftRst);
  const auto over = [&] { return (read(reg::kMcr) & reg::kMcrSoftRst) == 0; };
  ASSERT_TRUE(run_until(over, 2000));
  tell_model(true);
  timer_ = 0;
  model.soft_reset(clock_);
}

void BufferRig::receive(const Frame &frame) {
  peer_sends(frame);
  run_bits(2);
  quiet();
}

void BufferRig::run(unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) step();
}

bool BufferRig::run_until(const std::function<bool()> &done, unsigned clocks) {
  const std::uint64_t end = clock_ + clocks;
  while (!done()) {
    if (clock_ >= end) return false;
    step();
  }
  return true;
}

void BufferRig::quiet() {
  const std::uint64_t begin = clock_;
  const auto over = [&] {
    if (clock_ < begin + 120) return false;
    return planned_.empty() && peer_queue_.empty() && !peer_.pending() &&
           (field() == Field::kIdle || field() == Field::kBusOff) && clock_ > idle_since_ + 120;
  };
  if (!run_until(over, 400000)) ADD_FAILURE() << "the bus does not become quiet";
}

void BufferRig::disturb(unsigned bit, unsigned times) { disturbance_ = {bit, times}; }

void BufferRig::compare_quietly() {
  const BufferConfig &c = config();
  read(reg::kIflag1);
  if (c.num_mb > 32) read(reg::kIflag2);
  for (unsigned n = 0; n < c.num_mb; ++n)
    for (unsigned word = 1; word < 4; ++word) read(reg::mb(n, word));
  tell_model(true);
}

void BufferRig::compare() {
  compare_quietly();
  for (unsigned n = 0; n < config().num_mb; ++n) read_cs(n);
  read(reg::kTimer);
  if (config().fen) read(reg::kRxfir);
  tell_model(true);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RegisterBench: what well-behaved software does with the core before and after cases.
#include <fmt/format.h>

#include <algorithm>

#include "fuzz/register_bench.hpp"
#include "model/registers.hpp"

namespace vericansim::fuzz {
namespace {

constexpr std::uint32_t kTiming8 = (2U << 19U) | (1U << 16U) | 1U;
constexpr std::uint32_t kSynch = 1U << 18U;
constexpr std::uint32_t kFrozen = reg::kMcrFrz | reg::kMcrHalt;
constexpr unsigned kClocksPerBit = 8;
// Buffers behind the Rx FIFO and its filter table (RFFN = 0 takes 0 to 7).
constexpr unsigned kTxMb = 9, kRxMb = 10;
// An acknowledge waits for a frame at most: 160 bits with all stuff bits, an error frame, rests.
constexpr unsigned kFrameBits = 250;
// BO-02: 128 times 11 recessive bits; and frames meanwhile.
constexpr unsigned kRecoveryBits = 128 * 11 + kFrameBits;
// Clocks of the core itself: buffers are cleared after a hard reset, moves end.
constexpr unsigned kOwnClocks = 800;

bool same(const Frame &a, const Frame &b) { return a == b; }

std::uint32_t id_word(const Frame &frame) { return frame.extended ? frame.id : frame.id << 18U; }

}  // namespace

std::uint32_t RegisterBench::access(const AhbTransfer &transfer) {
  const AhbMaster::Ticket ticket = core_->ahb().submit(transfer);
  for (unsigned i = 0; !core_->ahb().done(ticket); ++i) {
    if (i == 64 || !fault_.empty()) {
      break_rule("HREADYOUT is low: " + to_text(transfer));
      return 0;
    }
    clock();
  }
  return core_->ahb().result(ticket).data;
}

void RegisterBench::wait(unsigned clocks) {
  for (unsigned i = 0; i < clocks; ++i) clock();
}

void RegisterBench::await(std::uint32_t address, std::uint32_t mask, bool set, const char *what) {
  const std::uint64_t start = clocks_;
  const bool recovers = address == reg::kEsr && decode_trace(core_->trace()).bus_off;
  const std::uint64_t bits = recovers ? kRecoveryBits : kFrameBits;
  const std::uint64_t most = bits * clocks_per_bit() + kOwnClocks;
  while (fault_.empty() && ((read(address) & mask) != 0) != set) {
    if (clocks_ - start > most) break_rule(fmt::format("{} clocks without {}", most, what));
    wait(4);
  }
  if (!recovers && clocks_per_bit() == kClocksPerBit)
    longest_acknowledge_ = std::max(longest_acknowledge_, clocks_ - start);
}

void RegisterBench::configure(std::uint32_t ctrl, bool fifo) {
  const std::uint32_t mcr = kFrozen | reg::kMcrWrnEn | reg::kMcrBcc | reg::kMcrSrxDis |
                            (fifo ? reg::kMcrFen : 0) | max_mb();
  write(reg::kMcr, mcr);
  write(reg::kCtrl, kTiming8 | ctrl);
  write(reg::kCtrl2, reg::kCtrl2Eacen | reg::kCtrl2Rrs);
  write(reg::kExtControl, 0);
  write(reg::kEcr, 0);
  for (unsigned mb = fifo ? 8 : 0; mb <= max_mb(); ++mb) write(reg::mb(mb), 0);
  for (unsigned mb = 0; mb <= max_mb(); ++mb) write(reg::rximr(mb), 0xFFFFFFFF);
  write(reg::kRxfgmask, 0xFFFFFFFF);
  write(reg::kIflag1, 0xFFFFFFFF);
  write(reg::kIflag2, 0xFFFFFFFF);
  write(reg::kEsr, 0xFFFFFFFF);
  write(reg::kImask1, static_cast<std::uint32_t>(random_()));
  static_cast<void>(read(reg::kTimer));  // unlocks
}

void RegisterBench::go() {
  write(reg::kMcr, read(reg::kMcr) & ~kFrozen);
  await(reg::kMcr, reg::kMcrFrzAck, false, "the end of freeze mode");
}

void RegisterBench::into_bus_off() {
  write(reg::kEcr, 0xF8);  // TEC: one error is enough
  write(reg::mb(kTxMb, 1), 0x7FFU << 18U);
  judge_.excuse();
  deaf_ = true;
  go();
  write(reg::mb(kTxMb), reg::kCodeTxData);
  for (unsigned i = 0; i < 4000 && !decode_trace(core_->trace()).bus_off; ++i) {
    judge_.excuse();
    clock();
  }
  if (!decode_trace(core_->trace()).bus_off) break_rule("does not go bus-off with TEC = 248");
  deaf_ = false;
}

void RegisterBench::enter(CoreMode mode, bool fifo) {
  wait(300);
  write(reg::kMcr, kFrozen);
  await(reg::kMcr, reg::kMcrFrzAck, true, "MCR.FRZ_ACK");
  std::uint32_t ctrl = chance(random_, 50) ? reg::kCtrlLbuf : 0;
  if (chance(random_, 30)) ctrl |= reg::kCtrlBoffRec;
  if (mode == CoreMode::kListenOnly) ctrl |= reg::kCtrlLom;
  if (mode == CoreMode::kLoopBack) ctrl |= reg::kCtrlLpb;
  configure(ctrl, fifo);
  for (unsigned mb = kRxMb; mb <= max_mb(); mb += 2) {
    write(reg::rximr(mb), static_cast<std::uint32_t>(random_() & random_() & random_()));
    write(reg::mb(mb), reg::kCodeRxEmpty | (chance(random_, 50) ? reg::kCsIde : 0));
  }
  if (mode == CoreMode::kBusOff) return into_bus_off();
  if (mode == CoreMode::kFreeze) return;
  go();
  wait(static_cast<unsigned>(draw(random_, 2000)));
  if (mode == CoreMode::kDisable) {
    write(reg::kMcr, read(reg::kMcr) | reg::kMcrMdis);
    await(reg::kMcr, reg::kMcrLpmAck, true, "MCR.LPM_ACK in disable mode");
  } else if (mode == CoreMode::kStop) {
    core_->request_stop(true);
    if (chance(random_, 50)) await(reg::kMcr, reg::kMcrLpmAck, true, "MCR.LPM_ACK in stop mode");
  }
}

void RegisterBench::recover(Recovery way) {
  core_->request_stop(false);
  if (way == Recovery::kHardReset) {
    const bool on_bus = decode_trace(core_->trace()).running;
    core_->reset();
    if (on_bus) judge_.left(true);
    wait(300);
  }
  // A soft reset that a case asked for sets MCR when it ends.
  await(reg::kMcr, reg::kMcrSoftRst, false, "the end of a soft reset");
  write(reg::kMcr, kFrozen);
  await(reg::kMcr, reg::kMcrFrzAck, true, "MCR.FRZ_ACK");
  if (way == Recovery::kSoftReset) {
    write(reg::kMcr, kFrozen | reg::kMcrSoftRst);
    await(reg::kMcr, reg::kMcrSoftRst, false, "the end of a soft reset");
    write(reg::kMcr, kFrozen);
    await(reg::kMcr, reg::kMcrFrzAck, true, "MCR.FRZ_ACK after a soft reset");
  }
  configure(0, false);
  restart_peers();
  go();
  await(reg::kEsr, kSynch, true, "ESR1.SYNCH");
  send_one();
  receive_one();
  if (chance(random_, 50)) talking_ = true;
}

// What was excused may have left them passive or bus-off, which is not the subject.
void RegisterBench::restart_peers() {
  talking_ = false;
  for (unsigned i = 0; i < 4000 && (peers_[0]->pending() || peers_[1]->pending()); ++i) clock();
  judge_.excuse();
  for (const auto &peer : peers_) {
    peer->reset();
    peer->start();
  }
  wait(20 * kClocksPerBit);
}

void RegisterBench::send_one() {
  const Frame frame = draw_frame(0x100);
  write(reg::mb(kTxMb, 1), id_word(frame));
  write(reg::mb(kTxMb, 2), frame.data_word(0));
  write(reg::mb(kTxMb, 3), frame.data_word(4));
  for (const auto &peer : peers_) peer->received().clear();
  write(reg::mb(kTxMb), reg::kCodeTxData | std::uint32_t{frame.dlc} << 16U |
                            (frame.extended ? reg::kCsIde | reg::kCsSrr : 0));
  await(reg::kIflag1, 1U << kTxMb, true, "the end of a transmission");
  wait(2 * kClocksPerBit);
  for (const auto &peer : peers_)
    if (fault_.empty() && (peer->received().size() != 1 || !same(peer->received()[0], frame)))
      break_rule("after recovery: a frame sent was not received as it was");
  ++frames_of_core_;
}

void RegisterBench::receive_one() {
  const Frame frame = draw_frame(0x200);
  write(reg::mb(kRxMb, 1), id_word(frame));
  write(reg::mb(kRxMb), reg::kCodeRxEmpty | (frame.extended ? reg::kCsIde : 0));
  peers_[0]->request(frame);
  await(reg::kIflag1, 1U << kRxMb, true, "the reception of a frame");
  const std::uint32_t cs = read(reg::mb(kRxMb));
  const std::uint32_t id = read(reg::mb(kRxMb, 1));
  const std::uint32_t data[] = {read(reg::mb(kRxMb, 2)), read(reg::mb(kRxMb, 3))};
  static_cast<void>(read(reg::kTimer));
  bool right = (cs >> 16U & 0xFU) == frame.dlc && id == id_word(frame) &&
               ((cs & reg::kCsIde) != 0) == frame.extended;
  for (unsigned i = 0; i < frame.dlc; ++i)
    right = right && (data[i / 4] >> (24 - 8 * (i % 4)) & 0xFFU) == frame.data[i];
  if (fault_.empty() && !right) break_rule("after recovery: a frame was received wrongly");
}

void RegisterBench::check_peers() {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto &sent = peers_[i]->sent();
    const auto &received = peers_[1 - i]->received();
    std::size_t at = 0;
    for (const Frame &frame : sent) {
      while (at < received.size() && !same(received[at], frame)) ++at;
      if (at++ == received.size()) return break_rule("a peer has lost a frame of the other");
    }
  }
}

}  // namespace vericansim::fuzz

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Replay of the Linux driver's accesses: see linux_access_log.hpp.
#include "system/linux_access_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace vericansim {
namespace {

constexpr unsigned k250us = 2000;                 // clocks of 8 MHz: the driver's patience
constexpr unsigned kFrameClocks = 200000;         // more than any wait for the bus in these logs
constexpr unsigned kOtherMb = 5;                  // the other node receives everything there
constexpr std::uint32_t kEsrState = 0x000400C8;   // SYNCH, IDLE, TX, RX
constexpr std::uint32_t kEsrErrors = 0x0000FC00;  // BIT1 to STF
constexpr std::uint32_t kEsrFltConf = 0x30;
constexpr std::uint32_t kCtrlWarningMasks = 0x0C00;

bool in_buffers(std::uint32_t offset) { return offset >= 0x080 && offset < 0x480; }
bool is_cs(std::uint32_t offset) { return in_buffers(offset) && offset % 16 == 0; }

/// Bits of the data word `word` (0, 1) that a frame of `dlc` bytes fills.
std::uint32_t data_mask(unsigned word, unsigned dlc) {
  const unsigned bytes = std::clamp(static_cast<int>(dlc) - static_cast<int>(4 * word), 0, 4);
  return bytes == 0 ? 0 : 0xFFFFFFFFu << (32 - 8 * bytes);
}

}  // namespace

/// What a run of accesses with the interrupt line high tells about the bus before it.
struct AccessLogReplay::Burst {
  std::vector<MbWords> received;
  std::uint32_t flags[2] = {0, 0};  ///< IFLAG1, IFLAG2
  std::uint32_t esr = 0;            ///< of the first read, 0 if none
};

std::vector<LoggedAccess> read_access_log(const std::string &path) {
  std::ifstream file{path};
  std::vector<LoggedAccess> log;
  unsigned number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::istringstream words{line};
    std::string time, op, offset, value, irq;
    words >> time >> op >> offset >> value >> irq;
    if ((op != "R" && op != "W") || irq.rfind("irq=", 0) != 0) continue;
    log.push_back({op == "W", static_cast<std::uint32_t>(std::stoul(offset, nullptr, 16)),
                   static_cast<std::uint32_t>(std::stoul(value, nullptr, 16)), irq == "irq=1",
                   number});
  }
  return log;
}

AccessLogReplay::AccessLogReplay(std::vector<LoggedAccess> log, unsigned num_mb)
    : log_{std::move(log)}, rig_{2, num_mb} {
  rig_.bus().add(deaf_);
  rig_.run(300);
}

void AccessLogReplay::run() {
  for (at_ = 0; at_ < log_.size(); ++at_) {
    const LoggedAccess &access = log_[at_];
    SCOPED_TRACE("line " + std::to_string(access.line));
    if (access.irq && (at_ == 0 || !log_[at_ - 1].irq)) prepare_burst(at_);
    access.write ? write(access) : read(access);
    rig_.run(4);
    EXPECT_EQ(rig_.node(0).irq(), access.irq) << "interrupt line";
    if (::testing::Test::HasFatalFailure()) return;
  }
}

void AccessLogReplay::write(const LoggedAccess &access) {
  if (is_cs(access.offset) && (access.value & reg::kCodeMask) == reg::kCodeTxData)
    prepare_transmission(at_, access.value);
  rig_.write(0, access.offset, access.value);
  if (access.offset == reg::kMcr) {
    if ((access.value & reg::kMcrSoftRst) != 0) deaf_.on = false;  // the cable is mended
    mcr_ = access.value;
  }
  if (access.offset == reg::kCtrl) ctrl_ = access.value;
  if (access.offset == reg::kCtrl2) ctrl2_ = access.value;
}

// The other node takes part if the log says that the frame was sent; otherwise nobody acknowledges.
void AccessLogReplay::prepare_transmission(std::size_t index, std::uint32_t cs) {
  if (loop_back()) return;
  tune_other_node();
  std::size_t first = index;
  while (first < log_.size() && !log_[first].irq) ++first;
  const Burst burst = look_ahead(first);
  const std::uint32_t offset = log_[index].offset, mb = (offset - 0x080) / 16;
  if (((burst.flags[mb / 32] >> (mb % 32)) & 1) == 0) {
    rig_.write(1, reg::kMcr, rig_.read(1, reg::kMcr) | reg::kMcrMdis);
    return;
  }
  on_bus_.push_back(mb_frame({.cs = cs,
                              .id = rig_.read(0, offset + 4),
                              .low = rig_.read(0, offset + 8),
                              .high = rig_.read(0, offset + 12)}));
}

void AccessLogReplay::check_transmission() {
  for (const Frame &frame : on_bus_) {
    ASSERT_TRUE(rig_.wait_flag(1, kOtherMb, kFrameClocks));
    EXPECT_EQ(mb_frame(rig_.get(1, kOtherMb)), frame);
    rig_.clear_flag(1, kOtherMb);
    rig_.read(1, reg::kTimer);
    ++sent;
  }
  on_bus_.clear();
}

// The other node has the bit timing of the first, and receives all frames.
void AccessLogReplay::tune_other_node() {
  const std::uint32_t timing = ctrl_ & 0xFFFF0007;
  const bool down = (rig_.read(1, reg::kMcr) & (reg::kMcrMdis | reg::kMcrFrzAck)) != 0;
  if (timing == other_ctrl_ && !down) return;
  rig_.node(1).reset();
  rig_.run(300);
  rig_.configure(1, {.ctrl = timing});
  rig_.put_rx(1, kOtherMb, {.extended = false}, 0);
  rig_.put_rx(1, kOtherMb + 1, {.extended = true}, 0);
  rig_.write(1, reg::kCtrl2, reg::kCtrl2Eacen | reg::kCtrl2Rrs);
  rig_.go(1);
  other_ctrl_ = timing;
}

AccessLogReplay::Burst AccessLogReplay::look_ahead(std::size_t first) const {
  Burst burst;
  for (std::size_t i = first; i < log_.size() && log_[i].irq; ++i) {
    const LoggedAccess &access = log_[i];
    if (access.write) continue;
    if (access.offset == reg::kIflag1) burst.flags[0] |= access.value;
    if (access.offset == reg::kIflag2) burst.flags[1] |= access.value;
    if (access.offset == reg::kEsr && burst.esr == 0) burst.esr = access.value;
    const unsigned code = (access.value >> 24) & 0xF;
    if (!is_cs(access.offset) || (code != 2 && code != 6 && !(fifo() && access.offset == 0x080)))
      continue;
    MbWords words{.cs = access.value};
    for (std::size_t j = i + 1; j < log_.size() && !log_[j].write; ++j) {
      if (log_[j].offset == access.offset + 4) words.id = log_[j].value;
      if (log_[j].offset == access.offset + 8) words.low = log_[j].value;
      if (log_[j].offset == access.offset + 12) words.high = log_[j].value;
    }
    burst.received.push_back(words);
  }
  return burst;
}

bool AccessLogReplay::refuses(const Frame &frame) const {
  return (frame.remote && (ctrl2_ & reg::kCtrl2Rrs) == 0) ||
         (frame.extended && (ctrl2_ & reg::kCtrl2Eacen) == 0);
}

void AccessLogReplay::prepare_burst(std::size_t first) {
  const Burst burst = look_ahead(first);
  ignored_flags_ = 0;
  for (const MbWords &words : burst.received) {
    const bool refused = !fifo() && refuses(mb_frame(words));
    if (refused) ignored_flags_ |= burst.flags[0];
    if (refused || loop_back()) continue;
    tune_other_node();
    rig_.put_tx(1, 0, mb_frame(words));
    ASSERT_TRUE(rig_.wait_flag(1, 0, kFrameClocks));
    rig_.clear_flag(1, 0);
  }
  deaf_.on = deaf_.on || (burst.esr & 0x20) != 0;  // only a cut cable leads to bus-off
  ASSERT_TRUE(rig_.run_until(
      [&] {
        const Trace state = decode_trace(rig_.node(0).trace());
        const std::uint32_t flt_conf = state.bus_off ? 0x20 : state.passive ? 0x10 : 0;
        return rig_.node(0).irq() && (burst.esr == 0 || flt_conf == (burst.esr & kEsrFltConf));
      },
      20 * kFrameClocks))
      << "the interrupt does not come";
  check_transmission();
}

void AccessLogReplay::read(const LoggedAccess &access) {
  std::uint32_t value = rig_.read(0, access.offset);
  if (access.offset == reg::kMcr) {
    // Acknowledges: the driver asks until they are there.
    const auto settled = [&] {
      ++polls;
      value = rig_.read(0, access.offset);
      return value == access.value;
    };
    if (value != access.value) rig_.run_until(settled, k250us);
  }
  compare(access, value, read_mask(access, value));
}

std::uint32_t AccessLogReplay::read_mask(const LoggedAccess &access, std::uint32_t value) {
  const std::uint32_t offset = access.offset;
  if (offset == reg::kTimer) return 0;
  if (offset == reg::kEsr) return ~(kEsrState | (kEsrErrors & ~access.value));
  if (offset == reg::kEcr) return decode_trace(rig_.node(0).trace()).bus_off ? 0 : 0xFFFFFFFF;
  if (offset == reg::kCtrl && (mcr_ & reg::kMcrWrnEn) == 0) return ~kCtrlWarningMasks;
  if (offset == reg::kIflag1) return ~ignored_flags_;
  if (!in_buffers(offset)) return 0xFFFFFFFF;
  if (offset % 16 == 0) {
    buffer_ = offset;
    dlc_ = (value >> 16) & 0xF;
    const bool refused = ignored_flags_ != 0 && offset < 0x280 &&
                         ((ignored_flags_ >> ((offset - 0x080) / 16)) & 1) != 0;
    if (refused) buffer_ = 0;
    const unsigned code = (access.value >> 24) & 0xF;
    if (!refused && (code < 8 && code != 4)) ++received;
    return refused ? 0 : (access.value & reg::kCsIde) != 0 ? 0x0F7F0000 : 0x0F3F0000;
  }
  if (buffer_ != offset - offset % 16) return 0;
  return offset % 16 == 4 ? 0xFFFFFFFF : data_mask(offset % 16 == 12, dlc_);
}

void AccessLogReplay::compare(const LoggedAccess &access, std::uint32_t value, std::uint32_t mask) {
  EXPECT_EQ(value & mask, access.value & mask)
      << "offset " << std::hex << access.offset << ", read " << value << ", in the log "
      << access.value << ", compared " << mask;
}

}  // namespace vericansim

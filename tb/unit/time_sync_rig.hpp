// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncRig: can_time_sync alone beside its model; frames as can_core hands them over.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "Vcan_time_sync.h"
#include "model/time_sync_model.hpp"
#include "time/tsyn_data.hpp"
#include "unit/leaf_model.hpp"

namespace vericansim {

/// Bits of cmd_i and cmd_o (rtl/can_pkg.sv).
namespace time_cmd {
inline constexpr unsigned kSet = 1 << 0, kShift = 1 << 1, kRate = 1 << 2, kSlew = 1 << 3,
                          kArm = 1 << 4;
}

/// Types of message and their fields, section 7.1 of the rules.
struct SyncMessage {
  static Frame make(const TimeSyncSetting &to, unsigned type, unsigned sc, unsigned byte3,
                    std::uint32_t word) {
    Frame frame{.id = to.id, .extended = to.extended, .dlc = 8};
    frame.data =
        TsynData{
            .type = type, .user = 0xA5, .domain = to.domain, .sc = sc, .byte3 = byte3, .word = word}
            .bytes();
    return frame;
  }
};

/// The module. Its increment follows its own commands.
class SyncRig {
 public:
  explicit SyncRig(const TimeSyncSetting &setting, std::uint64_t increment = 0x3E80000000)
      : increment_{increment} {
    configure(setting);
    rtl_.reset();
  }

  void configure(const TimeSyncSetting &setting) {
    setting_ = setting;
    rtl_->ctrl_i = setting.ctrl_word();
    rtl_->id_i = setting.id_word();
    rtl_->delay_i = setting.delay_word();
    rtl_->inc_i = increment_;
  }
  /// EN is 0 in `count` clocks, the first of which is `from` clocks from now.
  void disable(unsigned from, unsigned count) {
    off_from_ = clocks_ + from;
    off_until_ = off_from_ + count;
  }
  /// A hard reset; the settings stay.
  void reset() { rtl_.reset(); }
  [[nodiscard]] const TimeSyncSetting &setting() const { return setting_; }

  /// One clock with these commands of the CPU.
  void clock(unsigned cmd = 0) {
    rtl_->cmd_i = static_cast<std::uint16_t>(cmd);
    const bool off = clocks_ >= off_from_ && clocks_ < off_until_;
    rtl_->ctrl_i = off ? setting_.ctrl_word() & ~1u : setting_.ctrl_word();
    rtl_.settle();
    ++clocks_;
    changes_ += rtl_->changed_o;
    if (cmd != 0)
      foreign_ = rtl_->cmd_o == cmd && rtl_->own_o == 0;
    else
      take();
    rtl_.clock();
  }
  void clocks(unsigned count) {
    for (unsigned i = 0; i < count; ++i) clock();
  }

  /// The frame byte by byte, `gap` clocks apart; it ends without error only if `valid`.
  void frame(const Frame &frame, std::uint64_t stamp, bool valid = true, unsigned bytes = 8,
             unsigned gap = 24) {
    rtl_->rx_id_i = frame.extended ? frame.id : frame.id << 18;
    rtl_->rx_ide_i = frame.extended;
    rtl_->rx_rtr_i = frame.remote;
    rtl_->rx_hdr_i = 1;
    clock();
    rtl_->rx_hdr_i = 0;
    clocks(gap);
    rtl_->rx_dlc_i = frame.dlc;
    for (unsigned i = 0; i < frame.payload_size() && i < bytes; ++i) {
      rtl_->rx_byte_i = frame.data[i];
      rtl_->rx_byte_we_i = 1;
      clock();
      rtl_->rx_byte_we_i = 0;
      clocks(gap);
    }
    if (!valid) return;
    rtl_->rx_valid_i = 1;
    clock();
    rtl_->rx_valid_i = 0;
    valid_at_ = clocks_;
    clock();  // with POINT = 2 the stamp is good from the second clock on
    rtl_->stamp_i = stamp;
    clocks(6);
    rtl_->stamp_i = ~stamp;  // of another frame
  }
  void sync(unsigned sc, std::uint32_t seconds, std::uint64_t stamp, unsigned type = 0x10) {
    frame(SyncMessage::make(setting_, type, sc, 0x3C, seconds), stamp);
  }
  void fup(unsigned sc, unsigned ovs, std::uint32_t ns, unsigned type = 0x18) {
    frame(SyncMessage::make(setting_, type, sc, ovs, ns), 0x123456789);
  }
  /// What became of a pair: waits as long as it may take (TM-102).
  std::optional<TimeSyncAction> settle() {
    clocks(520);
    const auto action = action_;
    action_.reset();
    return action;
  }

  /// The compare unit wants to be armed anew, from now on.
  void upset(bool on) { rtl_->upset_i = on ? 1 : 0; }
  [[nodiscard]] unsigned state() { return rtl_->stat_o & 3; }
  [[nodiscard]] unsigned sc() { return rtl_->stat_o >> 4 & 15; }
  [[nodiscard]] unsigned pairs() { return rtl_->stat_o >> 8 & 255; }
  [[nodiscard]] std::int32_t offset() { return static_cast<std::int32_t>(rtl_->ofs_o); }
  [[nodiscard]] std::uint64_t increment() const { return increment_; }
  [[nodiscard]] std::uint64_t clock_count() const { return clocks_; }
  /// Clocks from the end of the last frame to the last command.
  [[nodiscard]] std::uint64_t latency() const { return command_at_ - valid_at_; }
  [[nodiscard]] std::uint64_t valid_at() const { return valid_at_; }
  /// Pulses of changed_o.
  [[nodiscard]] unsigned changes() const { return changes_; }
  /// The last command of the CPU went through, and nothing else with it.
  [[nodiscard]] bool foreign() const { return foreign_; }

 private:
  void take() {
    if (rtl_->cmd_o == 0) return;
    command_at_ = clocks_;
    if (!action_) action_.emplace().ends_slew = false;
    const std::uint64_t data = rtl_->data_o;
    if (rtl_->cmd_o == time_cmd::kShift) action_->shift = static_cast<std::int64_t>(data);
    if (rtl_->cmd_o == time_cmd::kSlew) action_->ends_slew = data >> 32 == 0;
    if (rtl_->cmd_o == time_cmd::kArm) action_->whole = data >> 32;
    if (rtl_->cmd_o == time_cmd::kRate) {
      increment_ = (data & 0xFF) << 32 | data >> 32;
      action_->increment = increment_;
      rtl_->inc_i = increment_;
    }
  }

  LeafModel<Vcan_time_sync> rtl_;
  TimeSyncSetting setting_;
  std::uint64_t increment_;
  std::uint64_t clocks_ = 0, valid_at_ = 0, command_at_ = 0, off_from_ = 0, off_until_ = 0;
  unsigned changes_ = 0;
  bool foreign_ = true;
  std::optional<TimeSyncAction> action_;
};

}  // namespace vericansim

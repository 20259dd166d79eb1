// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModel: its life from start to start, time, and the port of user logic.
#include "model/remote_model.hpp"

#include <algorithm>
#include <utility>

namespace vericansim {
namespace {

const RemoteConfig &checked(const RemoteConfig &config) {
  config.validate();
  return config;
}

}  // namespace

RemoteModel::RemoteModel(const RemoteConfig &config, unsigned node)
    : config_{checked(config)},
      memory_{config_, status_, node & config_.highest_number()},
      outbox_{config_.tx_depth, memory_},
      producers_{config_, memory_},
      maps_{config_, memory_},
      rate_{config_.rate_rows} {}

void RemoteModel::start(bool search) {
  if (status_.state != RemoteState::kInit) return;
  search_ = search && config_.auto_rate;
  begin();
}

// RN-60, RN-07: number and flags are those of the configuration from now on.
void RemoteModel::begin() {
  number_ = memory_[remote_map::kNode] & config_.highest_number();
  flags_ = memory_[remote_map::kFlags];
  status_.unlocked = selected_ = false;
  may_operate_ = true;
  outbox_.clear();
  under_way_.reset();
  transfer_ = {};
  producers_.clear_due();
  maps_.restart();
  if (search_) {
    rate_.restart();
    status_.state = RemoteState::kListen;
  } else {
    join();
  }
}

// On the bus: after the start, or again after bus-off.
void RemoteModel::join() {
  status_.state = RemoteState::kSafe;
  if (flag(remote_flags::kBoot) && has_number()) outbox_.status();
  operate_if_allowed();
}

void RemoteModel::operate_if_allowed() {
  if (status_.state != RemoteState::kSafe || off_bus_ || !may_operate_ ||
      !flag(remote_flags::kAutoOperate) || maps_.stale_leads_to_safe())
    return;
  status_.state = RemoteState::kOperate;
  status_.unlocked = false;
  fed();
}

void RemoteModel::leave_operate(bool for_good) {
  if (operating()) status_.state = RemoteState::kSafe;
  if (for_good) may_operate_ = false;
}

void RemoteModel::stopped() {
  if (!restarting_) return;
  restarting_ = false;
  status_.state = RemoteState::kInit;
  begin();
}

void RemoteModel::set_errors(unsigned tec, unsigned rec) {
  status_.tec = static_cast<std::uint8_t>(std::min(tec, 255U));
  status_.rec = static_cast<std::uint8_t>(std::min(rec, 255U));
}

// RN-72
void RemoteModel::went_bus_off() {
  if (off_bus_) return;
  off_bus_ = status_.bus_off = true;
  status_.count(RemoteCounter::kBusOff);
  outbox_.clear();
  under_way_.reset();
  producers_.clear_due();
  transfer_ = {};
  leave_operate(false);
  back_off_left_ = memory_[remote_map::kBackOff] << back_off_power_;
  if (back_off_left_ != 0) ++back_off_left_;  // the first tick may come at once
  back_off_power_ = std::min(back_off_power_ + 1, 7U);
}

void RemoteModel::recovered() {
  if (!off_bus_) return;
  off_bus_ = false;
  recovered_ms_ = 0;
  join();
}

void RemoteModel::tick_back_off() {
  if (off_bus_) {
    if (back_off_left_ != 0) --back_off_left_;
  } else if (recovered_ms_ < 10'000 && ++recovered_ms_ == 10'000) {
    back_off_power_ = 0;
  }
}

void RemoteModel::check_watchdog() {
  const unsigned limit = memory_.word(remote_map::kWatchdog);
  if (!operating() || ++idle_ms_ < limit || limit == 0) return;
  status_.watchdog = true;
  leave_operate(true);
}

// RN-66
void RemoteModel::check_maps() {
  maps_.tick();
  status_.stale = maps_.stale();
  if (maps_.stale_leads_to_safe())
    leave_operate(false);
  else
    operate_if_allowed();
}

void RemoteModel::tick() {
  const bool ten = ms_ == 0;
  ms_ = (ms_ + 1) % 10;
  tick_back_off();
  if (!on_bus()) return;
  check_watchdog();
  check_maps();
  for (unsigned n = ten ? outbox_.ten_ms() : 0; n != 0; --n) status_.count(RemoteCounter::kBusy);
  tick_block();
  producers_.tick(operating());
  fill_queue();
}

void RemoteModel::rate_error() {
  if (status_.state == RemoteState::kListen) rate_.error();
}

std::uint32_t RemoteModel::user_read(unsigned index) const {
  std::uint32_t word = 0;
  for (unsigned i = 0; i < 4; ++i) word |= std::uint32_t{memory_[4 * index + i]} << (8 * i);
  return word;
}

void RemoteModel::user_write(unsigned index, std::uint32_t data, unsigned lanes) {
  for (unsigned i = 0; i < 4; ++i)
    if ((lanes >> i & 1) != 0)
      memory_.user_write(4 * index + i, static_cast<std::uint8_t>(data >> (8 * i)));
}

void RemoteModel::hold(bool on) {
  held_ = on;
  hold_ignored_ = false;
  if (on) return;
  if (waiting_) {
    const Frame frame = *std::exchange(waiting_, std::nullopt);
    work(frame);
  }
  fill_queue();
}

// RN-52
void RemoteModel::hold_expired() {
  if (!held_ || hold_ignored_) return;
  hold_ignored_ = true;
  if (waiting_) {
    status_.count(RemoteCounter::kHold);
    const Frame frame = *std::exchange(waiting_, std::nullopt);
    work(frame);
  }
  fill_queue();
}

void RemoteModel::event(unsigned k) {
  producers_.event(k);
  if (on_bus()) fill_queue();
}

}  // namespace vericansim

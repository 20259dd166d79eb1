// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModel: system functions, data frames to name 0 (section 3.3), and SETUP.
#include "model/remote_model.hpp"

namespace vericansim {
namespace {

enum System : unsigned { kState, kTrigger, kSelect, kAssign, kSelectNew };

constexpr unsigned kOperateCommand = 0x01;
constexpr unsigned kSafeCommand = 0x02;
constexpr unsigned kRestartCommand = 0x81;

/// The DLCs that a system function has.
bool fits(unsigned function, unsigned dlc) {
  switch (function) {
    case kState: return dlc == 1 || dlc == 2;
    case kTrigger: return dlc <= 1;
    case kAssign: return dlc == 1;
    default: return dlc == 8;
  }
}

std::uint32_t key_of(const Frame &frame) {
  std::uint32_t key = 0;
  for (unsigned i = 0; i < 4; ++i) key |= std::uint32_t{frame.data[1 + i]} << (8 * i);
  return key;
}

}  // namespace

void RemoteModel::system_request(const Request &request) {
  const Frame &frame = request.frame;
  if (frame.remote || request.a > kSelectNew) return refuse(request, RemoteCode::kFunction);
  if (!fits(request.a, frame.dlc)) return refuse(request, RemoteCode::kValue);
  switch (request.a) {
    case kState: return change_state(request);
    case kTrigger:
      fed();
      return trigger(frame.dlc == 1 ? std::optional<unsigned>{frame.data[0]} : std::nullopt);
    case kAssign: return assign(request);
    default: return select(request);
  }
}

void RemoteModel::change_state(const Request &request) {
  const unsigned command = request.frame.data[0];
  const unsigned number = request.frame.dlc == 2 ? request.frame.data[1] : 0;
  if (number != 0 && (number != number_ || !has_number())) return;  // of another
  switch (command) {
    case kOperateCommand:
      status_.state = RemoteState::kOperate;
      status_.unlocked = false;  // RN-61
      may_operate_ = true;
      break;
    case kSafeCommand: leave_operate(true); break;
    case kRestartCommand: restarting_ = true; break;
    default: return refuse(request, RemoteCode::kValue);
  }
  accept(request);
}

// RN-46. `count`: none: one more.
void RemoteModel::trigger(std::optional<unsigned> count) {
  const auto next = static_cast<std::uint8_t>(status_.trigger + 1);
  if (count && *count != next) status_.count(RemoteCounter::kSequence);
  status_.trigger = count ? static_cast<std::uint8_t>(*count) : next;
  if (operating()) {
    memory_.apply_stage();
    done_.push_back({true, 0, 0});
  }
  producers_.trigger(operating());
  show();
}

// SELECT and SELECT NEW: the node is the only one that knows whether it was meant.
void RemoteModel::select(const Request &request) {
  selected_ = true;
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned serial = config_.serial >> (8 * i) & 0xFF;
    if (((serial ^ request.frame.data[2 * i]) & request.frame.data[2 * i + 1]) != 0)
      selected_ = false;
  }
  if (request.a == kSelectNew && has_number()) selected_ = false;
  fed();
  outbox_.here(selected_);
}

void RemoteModel::assign(const Request &request) {
  if (!selected_) return;
  if (operating()) return refuse(request, RemoteCode::kLocked);
  outbox_.clear();
  transfer_ = {};
  number_ = request.frame.data[0] & config_.highest_number();
  accept(request);
  if (has_number()) outbox_.status();
}

void RemoteModel::setup(const Request &request) {
  enum Op : unsigned { kUnlock = 1, kLock, kLockForGood, kClear };
  const unsigned op = request.frame.dlc == 0 ? 0 : request.frame.data[0];
  const unsigned length = op == kUnlock ? 5 : 1;
  if (op < kUnlock || op > kClear || request.frame.dlc != length)
    return refuse(request, RemoteCode::kValue);
  if (op == kUnlock) return unlock(request);
  if (op == kClear)
    status_.clear();
  else
    status_.unlocked = false;
  if (op == kLockForGood) locked_for_good_ = true;
  accept(request);
}

// RN-61
void RemoteModel::unlock(const Request &request) {
  if (operating() || locked_for_good_ || key_of(request.frame) != config_.serial)
    return refuse(request, RemoteCode::kLocked);
  status_.unlocked = true;
  accept(request);
}

}  // namespace vericansim

// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModel: frames from the bus and to it.
#include <utility>

#include "model/remote_model.hpp"

namespace vericansim {

void RemoteModel::announce(const Frame &header) {
  Frame longest = header;
  longest.dlc = 8;
  announced_ = on_bus() && !off_bus_ && !header.extended && concerns(longest);
}

void RemoteModel::released() {
  if (!std::exchange(announced_, false)) return;
  fill_queue();
}

void RemoteModel::receive(const Frame &frame) {
  frame.validate();
  announced_ = false;
  if (status_.state == RemoteState::kListen && rate_.frame()) {
    join();
    fill_queue();
    return;
  }
  if (!on_bus() || off_bus_ || restarting_) return;
  if (waiting_) hold_expired();
  after_int2_ = hold_ignored_ = false;
  if (frame.extended) return;  // RN-34
  if (held_ && concerns(frame)) {
    waiting_ = frame;
    return;
  }
  work(frame);
  fill_queue();
}

RemoteModel::Name RemoteModel::name_of(const Frame &frame) const {
  if ((frame.id & 0x400) != 0) return Name::kOther;
  const unsigned name = frame.id >> config_.address_bits();
  if (name == 0) return Name::kSystem;
  if (name == 1) return Name::kAll;
  return name == number_ && has_number() ? Name::kOwn : Name::kOther;
}

bool RemoteModel::says_my_name(const Frame &frame) const {
  return has_number() && !frame.remote &&
         frame.id >> config_.address_bits() == (1U << config_.name_bits | number_);
}

// Whether there is work to do, which user logic can delay.
bool RemoteModel::concerns(const Frame &frame) const {
  return name_of(frame) != Name::kOther || says_my_name(frame) ||
         (!frame.remote && maps_.find(frame));
}

void RemoteModel::work(const Frame &frame) {
  const unsigned a = frame.id & ((1U << config_.address_bits()) - 1);
  switch (name_of(frame)) {
    case Name::kSystem: return system_request({frame, a, true});
    case Name::kAll: return memory_request({frame, a, true});
    case Name::kOwn: return memory_request({frame, a, false});
    case Name::kOther: break;
  }
  if (!frame.remote) statement(frame);
}

// A data frame that is no request to this node: DUP (RN-11), map entries (RN-65).
void RemoteModel::statement(const Frame &frame) {
  if (says_my_name(frame)) {
    status_.duplicate = true;
    status_.count(RemoteCounter::kDuplicate);
  }
  const auto place = maps_.find(frame);
  if (!place) return;
  // A frame without bytes is checked like one with one.
  if (memory_.check_write(place->address, std::max(place->length, 1U), status_.unlocked) !=
      RemoteCode::kAccepted)
    return;
  if (place->length != 0) {
    memory_.bus_write(place->address, {frame.data.data(), place->length});
    done_.push_back({false, place->address, place->length});
  }
  maps_.taken(place->entry);
  status_.stale = maps_.stale();
  if (place->trigger) trigger(std::nullopt);
  show();
}

void RemoteModel::intermission() {
  after_int2_ = true;
  show();
}

// RN-45: nothing is shown before the SP of INT2.
void RemoteModel::show() {
  if (!after_int2_) return;
  pulses_.insert(pulses_.end(), done_.begin(), done_.end());
  done_.clear();
}

std::vector<RemotePulse> RemoteModel::take_pulses() { return std::exchange(pulses_, {}); }

// Room in the queue goes to answers of block transfers first. What nobody waits for, data of a
// block read and statements by producers, comes only into an empty queue: so an answer has one of
// them before it at most.
void RemoteModel::fill_queue() {
  if (announced_) return;
  if (held_ && !hold_ignored_) return;  // no snapshot is taken
  if (!on_bus() || off_bus_ || !has_number()) return;
  if (outbox_.empty()) {
    if (const auto data = next_block_frame()) outbox_.answer(*data);
  }
  if (transfer_.answer && !outbox_.full()) {
    outbox_.answer(*transfer_.answer);
    transfer_.answer.reset();
  }
  if (!outbox_.empty()) return;
  if (const auto statement = producers_.take(number_, operating())) outbox_.answer(*statement);
}

std::optional<Frame> RemoteModel::wants() const {
  if (!on_bus() || off_bus_ || restarting_) return std::nullopt;
  if (under_way_) return under_way_;
  Frame frame;
  switch (outbox_.chosen()) {
    case RemoteOutbox::Item::kNone: return std::nullopt;
    case RemoteOutbox::Item::kAnswer: return outbox_.front();
    case RemoteOutbox::Item::kHere: frame.id = 0x402; return frame;  // RN-12
    case RemoteOutbox::Item::kStatus: break;
  }
  frame.id = config_.id(number_, RemotePort::kStatus);
  frame.dlc = 8;
  frame.data = status_.row();
  return frame;
}

void RemoteModel::attempt() {
  under_way_ = wants();
  if (under_way_) outbox_.attempt();
}

void RemoteModel::sent() {
  under_way_.reset();
  outbox_.sent();
  fill_queue();
}

void RemoteModel::lost_arbitration() {
  under_way_.reset();
  outbox_.lost();
}

// RN-15
void RemoteModel::failed() {
  under_way_.reset();
  if (outbox_.failed()) status_.count(RemoteCounter::kBusy);
  fill_queue();
}

}  // namespace vericansim

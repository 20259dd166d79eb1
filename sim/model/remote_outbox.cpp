// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a node has to say and has not said yet.
#include "model/remote_outbox.hpp"

namespace vericansim {

void RemoteOutbox::read_limits() {
  next_life_ = memory_[remote_map::kLife];
  tries_ = memory_[remote_map::kRetry];
}

void RemoteOutbox::choose() {
  if (chosen_ != Item::kNone) return;
  if (here_)
    chosen_ = Item::kHere;
  else if (status_)
    chosen_ = Item::kStatus;
  else if (!answers_.empty())
    chosen_ = Item::kAnswer;
}

void RemoteOutbox::answer(const Frame &frame) {
  answers_.push_back({frame, next_life_});
  next_life_ = memory_[remote_map::kLife];
  choose();
}

void RemoteOutbox::status() {
  status_ = true;
  choose();
}

void RemoteOutbox::here(bool wanted) {
  here_ = wanted;
  if (!wanted && chosen_ == Item::kHere) {
    chosen_ = Item::kNone;
    read_limits();
  }
  choose();
}

void RemoteOutbox::clear() {
  answers_.clear();
  here_ = status_ = false;
  chosen_ = Item::kNone;
  under_way_ = false;
  read_limits();
}

void RemoteOutbox::drop_chosen() {
  if (chosen_ == Item::kHere) here_ = false;
  if (chosen_ == Item::kStatus) status_ = false;
  if (chosen_ == Item::kAnswer) answers_.pop_front();
  chosen_ = Item::kNone;
  under_way_ = false;
  read_limits();
  choose();
}

void RemoteOutbox::sent() {
  if (under_way_) drop_chosen();
}

void RemoteOutbox::lost() { under_way_ = false; }

bool RemoteOutbox::failed() {
  under_way_ = false;
  if (chosen_ == Item::kNone || tries_ == 0 || --tries_ != 0) return false;
  drop_chosen();
  return true;
}

unsigned RemoteOutbox::ten_ms() {
  unsigned dropped = 0;
  for (auto it = answers_.begin(); it != answers_.end();) {
    if (it->life == 1 && it == answers_.begin() && !under_way_) {
      it = answers_.erase(it);
      if (chosen_ == Item::kAnswer) {
        chosen_ = Item::kNone;
        read_limits();
      }
      ++dropped;
      continue;
    }
    if (it->life > 1) --it->life;
    ++it;
  }
  choose();
  return dropped;
}

}  // namespace vericansim

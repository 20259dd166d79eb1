// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a node has to say and has not said yet.
#include "model/remote_outbox.hpp"

namespace vericansim {

void RemoteOutbox::choose() {
  if (chosen_ != Item::kNone) return;
  failures_ = 0;
  if (here_age_)
    chosen_ = Item::kHere;
  else if (status_age_)
    chosen_ = Item::kStatus;
  else if (!answers_.empty())
    chosen_ = Item::kAnswer;
}

void RemoteOutbox::answer(const Frame &frame) {
  answers_.push_back({frame, 0});
  choose();
}

void RemoteOutbox::status() {
  status_age_ = 0;
  choose();
}

void RemoteOutbox::here(bool wanted) {
  if (wanted) {
    here_age_ = 0;
  } else {
    here_age_.reset();
    if (chosen_ == Item::kHere) chosen_ = Item::kNone;
  }
  choose();
}

void RemoteOutbox::clear() {
  answers_.clear();
  here_age_.reset();
  status_age_.reset();
  chosen_ = Item::kNone;
  under_way_ = false;
}

void RemoteOutbox::drop_chosen() {
  if (chosen_ == Item::kHere) here_age_.reset();
  if (chosen_ == Item::kStatus) status_age_.reset();
  if (chosen_ == Item::kAnswer) answers_.pop_front();
  chosen_ = Item::kNone;
  under_way_ = false;
  choose();
}

void RemoteOutbox::sent() {
  if (under_way_) drop_chosen();
}

void RemoteOutbox::lost() { under_way_ = false; }

bool RemoteOutbox::failed(unsigned retry) {
  under_way_ = false;
  if (chosen_ == Item::kNone || ++failures_ < retry || retry == 0) return false;
  drop_chosen();
  return true;
}

unsigned RemoteOutbox::tick(unsigned life) {
  const auto over = [&](unsigned &age) { return ++age >= life && life != 0; };
  unsigned dropped = 0;
  const auto drop_slot = [&](std::optional<unsigned> &age, Item item) {
    if (!age || !over(*age) || (under_way_ && chosen_ == item)) return;
    age.reset();
    if (chosen_ == item) chosen_ = Item::kNone;
    ++dropped;
  };
  drop_slot(here_age_, Item::kHere);
  drop_slot(status_age_, Item::kStatus);
  for (auto it = answers_.begin(); it != answers_.end();) {
    const bool first = it == answers_.begin();
    const bool chosen = first && chosen_ == Item::kAnswer;
    if (!over(it->age) || (chosen && under_way_)) {
      ++it;
      continue;
    }
    if (chosen) chosen_ = Item::kNone;
    it = answers_.erase(it);
    ++dropped;
  }
  choose();
  return dropped;
}

}  // namespace vericansim

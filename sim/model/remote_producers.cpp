// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Statements that a node makes by itself.
#include "model/remote_producers.hpp"

namespace vericansim {

RemoteProducers::RemoteProducers(const RemoteConfig &config, const RemoteMemory &memory)
    : config_{config}, memory_{memory}, timers_(config.num_prod) {}

RemoteProducers::Entry RemoteProducers::entry(unsigned k) const {
  const unsigned at = remote_map::kProducers + 8 * k;
  const unsigned mode = memory_[at + 1];
  Entry entry;
  entry.a = memory_[at];
  entry.length = mode & 0x0F;
  entry.by_trigger = (mode & 0x40) != 0;
  entry.on_change = (mode & 0x20) != 0;
  entry.cyclic = (mode & 0x10) != 0;
  entry.period = memory_.word(at + 2);
  entry.gap = memory_[at + 4];
  const unsigned status = config_.first_port() + static_cast<unsigned>(RemotePort::kStatus);
  entry.row = entry.a == status || entry.a == status + 1;
  entry.address = entry.row ? remote_map::kStatus + 8 * (entry.a - status) : entry.a;
  // RN-06: what is sent at A is what is there, so none reaches beyond the window.
  const bool place = entry.row || entry.a + entry.length <= config_.first_port();
  entry.off = (mode & 0x80) == 0;
  entry.on = !entry.off && entry.length >= 1 && entry.length <= 8 && place;
  return entry;
}

bool RemoteProducers::changed(const Entry &entry, const Timer &timer) const {
  for (unsigned i = 0; i < entry.length; ++i)
    if (memory_[entry.address + i] != timer.last[i]) return true;
  return false;
}

// A period that is over begins anew with its next tick; an entry that is off has none.
void RemoteProducers::step(const Entry &entry, Timer &timer, bool allowed) {
  if (!entry.on) timer.left = 0;
  if (!entry.on) return;
  if (timer.left == 0) timer.left = entry.period;
  if (timer.left != 0 && --timer.left == 0 && allowed) timer.due = true;
}

void RemoteProducers::tick(bool operate) {
  for (unsigned k = 0; k < timers_.size(); ++k) {
    const Entry one = entry(k);
    Timer &timer = timers_[k];
    if (timer.gap_left != 0) --timer.gap_left;
    const bool allowed = one.row || operate;
    if (one.off || (one.cyclic && !one.by_trigger)) step(one, timer, allowed);
    if (one.on && one.on_change && allowed && changed(one, timer)) timer.due = true;
  }
}

void RemoteProducers::trigger(bool operate) {
  for (unsigned k = 0; k < timers_.size(); ++k) {
    const Entry one = entry(k);
    if (one.cyclic && one.by_trigger) step(one, timers_[k], one.row || operate);
  }
}

void RemoteProducers::event(unsigned k) { timers_.at(k).due = true; }

void RemoteProducers::clear_due() {
  for (Timer &timer : timers_) timer.due = false;
}

std::optional<Frame> RemoteProducers::take(unsigned number, bool operate) {
  for (unsigned k = 0; k < timers_.size(); ++k) {
    const Entry one = entry(k);
    Timer &timer = timers_[k];
    if (!one.on || !(one.row || operate)) timer.due = false;
    if (!timer.due || timer.gap_left != 0) continue;
    timer.due = false;
    timer.gap_left = one.gap;
    Frame frame;
    frame.id = config_.id(1, number, one.a);
    frame.dlc = static_cast<std::uint8_t>(one.length);
    for (unsigned i = 0; i < one.length; ++i)
      frame.data[i] = timer.last[i] = memory_[one.address + i];
    return frame;
  }
  return std::nullopt;
}

}  // namespace vericansim

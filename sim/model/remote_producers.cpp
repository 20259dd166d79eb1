// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Statements that a node makes by itself.
#include "model/remote_producers.hpp"

#include <algorithm>

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
  entry.on = (mode & 0x80) != 0 && entry.length >= 1 && entry.length <= 8 && place;
  return entry;
}

bool RemoteProducers::changed(const Entry &entry, const Timer &timer) const {
  for (unsigned i = 0; i < entry.length; ++i)
    if (memory_[entry.address + i] != timer.last[i]) return true;
  return false;
}

void RemoteProducers::step(const Entry &entry, Timer &timer, bool allowed) {
  if (++timer.count < entry.period) return;
  timer.count = 0;
  if (entry.period != 0 && allowed) timer.due = true;
}

void RemoteProducers::tick(bool operate) {
  for (unsigned k = 0; k < timers_.size(); ++k) {
    const Entry one = entry(k);
    Timer &timer = timers_[k];
    timer.since = std::min(timer.since + 1, 0xFFFFU);
    if (!one.on) {
      timer.count = 0;
      continue;
    }
    const bool allowed = one.row || operate;
    if (one.cyclic && !one.by_trigger) step(one, timer, allowed);
    if (one.on_change && allowed && changed(one, timer)) timer.due = true;
  }
}

void RemoteProducers::trigger(bool operate) {
  for (unsigned k = 0; k < timers_.size(); ++k) {
    const Entry one = entry(k);
    if (one.on && one.cyclic && one.by_trigger) step(one, timers_[k], one.row || operate);
  }
}

void RemoteProducers::event(unsigned k, bool operate) {
  Timer &timer = timers_.at(k);
  const Entry one = entry(k);
  if (one.on && (one.row || operate)) timer.due = true;
}

void RemoteProducers::clear_due() {
  for (Timer &timer : timers_) timer.due = false;
}

void RemoteProducers::restart() { timers_.assign(timers_.size(), {}); }

std::optional<Frame> RemoteProducers::take(unsigned number, bool operate) {
  for (unsigned k = 0; k < timers_.size(); ++k) {
    const Entry one = entry(k);
    Timer &timer = timers_[k];
    if (!one.on || !(one.row || operate)) timer.due = false;
    if (!timer.due || timer.since < one.gap) continue;
    timer.due = false;
    timer.since = 0;
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
